// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/file_kind.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

namespace grseg {
namespace {

namespace po = boost::program_options;

/// The text of a file without a byte-order mark.
std::string text_of(const std::string& path)
{
  std::ifstream file(path);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  return text;
}

/// Place of the line that sets `key`, such as "file:12"; "file" if no line does.
std::string place_of(const std::string& path, const std::string& key)
{
  std::istringstream file(text_of(path));
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const auto begin = line.find_first_not_of(" \t");
    const auto end = line.find_first_of(" \t=", begin);
    if (begin != std::string::npos && line.substr(begin, end - begin) == key)
      return fmt::format("{}:{}", path, number);
  }
  return path;
}

/// Place of the first line with a NUL byte, such as "file:12"; "" if there is none.
std::string place_of_nul(const std::string& text, const std::string& name)
{
  const auto at = text.find('\0');
  if (at == std::string::npos) return "";
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
  return fmt::format("{}:{}", name, 1 + std::count(text.begin(), end, '\n'));
}

/// Place of the first line that is neither 'key = value' nor a comment, such as "file:12".
std::string place_of_bad_line(const std::string& text, const std::string& name)
{
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto words = line.substr(0, line.find('#'));
    if (words.find_first_not_of(" \t\r") != std::string::npos &&
        words.find('=') == std::string::npos)
      return fmt::format("{}:{}", name, number);
  }
  return name;
}

std::string without_dashes(std::string option)
{
  option.erase(0, option.find_first_not_of('-'));
  return option;
}

using ParsedKeys = po::parsed_options;

/// Stores the keys that `text` sets in `values`, after a call of `change`, which may edit them.
/// `place` returns the place of a key for messages.
void read_keys(const std::string& text, const std::string& name,
               const std::function<std::string(const std::string&)>& place,
               const std::function<void(ParsedKeys&)>& change, po::variables_map& values)
{
  if (const auto line = place_of_nul(text, name); !line.empty())
    throw FormatError(fmt::format(
        "{}: contains a NUL byte, which no text has; save the file as plain text (UTF-8)", line));
  if (const auto word = placeholder_in(text); !word.empty())
    throw FormatError(fmt::format("{}: no key and no value may contain {}", name, word));
  const auto keys = scene_options();
  std::istringstream in(text);
  try {
    auto parsed = po::parse_config_file(in, keys);
    change(parsed);
    po::store(parsed, values);
    po::notify(values);
  } catch (const po::unknown_option& unknown) {
    const auto key = without_dashes(unknown.get_option_name());
    std::vector<std::string> known;
    for (const auto& option : keys.options()) known.push_back(option->long_name());
    const auto absent = absent_effect(key), suggestion = nearest(key, known);
    throw FormatError(fmt::format("{}: unknown key '{}'{}", place(key), key,
                                  !absent.empty() ? ": " + absent
                                  : suggestion.empty()
                                      ? "; grseg-sim --help lists all"
                                      : fmt::format(", did you mean '{}'?", suggestion)));
  } catch (const po::invalid_config_file_syntax&) {
    throw FormatError(
        fmt::format("{}: lines are 'key = value' or '# comment'", place_of_bad_line(text, name)));
  } catch (const po::error_with_option_name& wrong) {
    throw FormatError(
        fmt::format("{}: {}", place(without_dashes(wrong.get_option_name())), wrong.what()));
  }
}

/// Appends the unit m to all lengths.
void add_units(ParsedKeys& parsed)
{
  for (auto& option : parsed.options)
    for (const auto& key : scene_keys())
      if (option.string_key == key.name && !option.value.empty())
        option.value[0] = key.with_unit(option.value[0]);
}

}  // namespace

std::string to_text(const Scene& scene)
{
  std::string text;
  for (const auto& key : scene_keys()) {
    if (key.role == KeyRole::machine) continue;
    const auto value = key.text(scene);
    if (!value.empty()) text += fmt::format("{} = {}\n", key.name, value);
  }
  return text;
}

Parameters to_parameters(const Scene& scene)
{
  Parameters parameters;
  for (const auto& key : scene_keys()) {
    const auto text = key.text(scene);
    if (key.stored == InParameters::no || text.empty()) continue;
    std::string name = key.name;
    std::replace(name.begin(), name.end(), '-', '_');
    if (key.value.number)
      parameters.numbers[name] = {key.value.number(scene)};
    else
      parameters.texts[name] = text;
  }
  const auto gravity = gravity_of<2>(scene).start;
  auto& numbers = parameters.numbers["gravity"] = {gravity.x(), gravity.y()};
  if (scene.dimension == 3) numbers.push_back(0);
  parameters.numbers["large_diameter"] = {scene.large_diameter};
  parameters.numbers["contact_margin"] = {law_parameters(scene).margin};
  parameters.texts["scene"] = to_text(scene);
  if (scene.geometry->describe) scene.geometry->describe(scene, parameters);
  return parameters;
}

Scene without_round_off(Scene now, const Scene& before)
{
  for (const auto& key : scene_keys()) {
    const auto text = key.text(before);
    if (key.text(now) != text && same_setting(key.text(now), text))
      key.value.read(key.name, key.with_unit(text), now);
  }
  return now;
}

std::string differing_key(const Scene& a, const Scene& b, KeyRole role)
{
  for (const auto& key : scene_keys())
    if (key.role == role && key.text(a) != key.text(b)) return key.name;
  return "";
}

void read_scene_file(const std::string& path, po::variables_map& values)
{
  require_file(path);
  if (const auto wrong = kind_of_file(path).instead_of("a scene file", ""); !wrong.empty())
    throw FormatError(fmt::format("{}: {}", path, wrong));
  read_keys(
      text_of(path), path, [&](const std::string& key) { return place_of(path, key); },
      [](ParsedKeys&) {}, values);
}

void read_scene_text(const std::string& text, const std::string& name,
                     const std::vector<std::string>& leave_out, po::variables_map& values)
{
  const auto change = [&](ParsedKeys& parsed) {
    std::erase_if(parsed.options, [&](const auto& option) {
      return std::find(leave_out.begin(), leave_out.end(), option.string_key) != leave_out.end();
    });
    add_units(parsed);
  };
  read_keys(
      text, name, [&](const std::string&) { return name; }, change, values);
}

Scene resolve_scene(const std::string& path, const po::variables_map& given)
{
  auto values = given;
  read_scene_file(path, values);
  try {
    return resolve_scene(values);
  } catch (const SceneError& wrong) {
    const bool from_command_line = given.count(wrong.key) > 0 && !given[wrong.key].defaulted();
    const auto place = place_of(path, wrong.key);
    if (from_command_line || place == path) throw;
    throw FormatError(fmt::format("{}: {}", place, wrong.what()));
  }
}

}  // namespace grseg
