// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/tool.hpp"

#include "git_hash.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numeric>

namespace grseg {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replace});
    }
  }
  return row[b.size()];
}

std::vector<std::string> names_of(const po::options_description& options)
{
  std::vector<std::string> names;
  for (const auto& option : options.options()) names.push_back("--" + option->long_name());
  return names;
}

/// What the preset sets of the options that are not given themselves: option and value.
std::vector<std::pair<std::string, std::string>> preset_values(const ToolInfo& info,
                                                               const po::variables_map& given)
{
  const auto name = preset_of(given);
  if (name == "none") return {};
  if (name != "paper" && name != "rigorous")
    throw UsageError(fmt::format("--preset: there is no '{}'; it is paper or rigorous", name));
  std::vector<std::pair<std::string, std::string>> values;
  for (const auto& [option, paper, rigorous] : info.presets) {
    const std::string value = name == "paper" ? paper : rigorous;
    if (!value.empty() && (!given.contains(option) || given[option].defaulted()))
      values.emplace_back(option, value);
  }
  return values;
}

/// Gives `values` what the preset sets, as defaults.
void take_preset(const ToolInfo& info, const po::options_description& options,
                 po::variables_map& values)
{
  const auto preset = preset_values(info, values);
  std::vector<std::string> words;
  words.reserve(preset.size());
  for (const auto& [option, value] : preset) words.push_back(fmt::format("--{}={}", option, value));
  po::store(po::command_line_parser(words).options(options).run(), values);
  po::notify(values);
  std::map<std::string, po::variable_value>& all = values;
  for (const auto& [option, value] : preset)
    all[option] = po::variable_value(all[option].value(), true);
}

std::string help_of(const std::span<const PresetOption> presets)
{
  std::string paper = "paper:", rigorous = "rigorous:";
  for (const auto& row : presets) {
    if (*row.paper != '\0') paper += fmt::format(" --{} {}", row.option, row.paper);
    if (*row.rigorous != '\0') rigorous += fmt::format(" --{} {}", row.option, row.rigorous);
  }
  return fmt::format("{}; {}; options that are given go before", paper, rigorous);
}

po::variables_map parse(int argc, char** argv, const ToolInfo& info,
                        const po::options_description& options)
{
  namespace style = po::command_line_style;
  po::options_description all;
  all.add(options);
  all.add_options()("input", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("input", -1);

  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(positional)
                  .style(style::unix_style & ~style::allow_guessing)
                  .run(),
              values);
    take_preset(info, all, values);
  } catch (const po::unknown_option& unknown) {
    const auto& option = unknown.get_option_name();
    const auto suggestion = nearest(option, names_of(options));
    throw UsageError(
        fmt::format("unknown option {}{}; --help lists all", option,
                    suggestion.empty() ? "" : fmt::format(", did you mean {}?", suggestion)));
  } catch (const po::error& wrong) {
    throw UsageError(fmt::format("{}; --help lists all options", wrong.what()));
  }
  return values;
}

void print_help(const ToolInfo& info, const po::options_description& options)
{
  std::cout << fmt::format("{}: {}\n\nUsage: {}\n\nExamples:\n{}\n", info.name, info.summary,
                           info.usage, info.examples)
            << options
            << "\nExit codes: 0 done; 1 trouble while running; 2 command line wrong or input "
               "missing;\n3 content of a file wrong; 4 a check or tolerance missed; 130/143 "
               "interrupted.\n";
}

}  // namespace

int run_tool(int argc, char** argv, const ToolInfo& info, const po::options_description& options,
             const std::function<void(const po::variables_map&)>& body)
{
  po::options_description all = options;
  const auto presets = help_of(info.presets);
  if (!info.presets.empty())
    all.add_options()("preset", po::value<std::string>()->value_name("NAME"), presets.c_str());
  all.add_options()("version", "print the version and stop")("help,h", "print this text and stop");
  try {
    const auto values = parse(argc, argv, info, all);
    if (values.count("help") > 0) {
      print_help(info, all);
    } else if (values.count("version") > 0) {
      std::cout << info.name << ' ' << version_with_hash() << '\n';
    } else {
      body(values);
    }
    std::cout.flush();
    if (!std::cout) throw RunError("cannot write to standard output");
    return exit_done;
  } catch (const ToolError& error) {
    std::cerr << info.name << ": " << error.what() << '\n';
    return error.code();
  } catch (const std::bad_alloc&) {
    std::cerr << info.name << ": out of memory; use fewer frames or a smaller scene\n";
  } catch (const std::exception& error) {
    std::cerr << info.name << ": " << error.what() << '\n';
  }
  return exit_trouble;
}

std::string preset_of(const po::variables_map& values)
{
  return values.contains("preset") ? values["preset"].as<std::string>() : "none";
}

std::string command_line(int argc, char** argv)
{
  std::string line = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--threads") ++k;
    if (word.starts_with("--threads")) continue;
    const bool plain = !word.empty() && word.find_first_of(" \t\n'\"\\$*") == std::string::npos;
    line += plain ? " " + word : " '" + word + "'";
  }
  return line;
}

std::string version()
{
  return GRSEG_VERSION;
}

std::string version_with_hash()
{
  return fmt::format("{} ({})", GRSEG_VERSION, GRSEG_GIT_HASH);
}

std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
  std::string best;
  std::size_t least = std::max<std::size_t>(3, word.size() / 2);
  for (const auto& candidate : known) {
    const auto distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

void bring_to_disk(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && fsync(file) == 0;
  const std::string why = std::strerror(errno);
  if (file >= 0) close(file);
  if (!on_disk) throw RunError(fmt::format("cannot bring {} to the disk: {}", path, why));
}

void publish_file(const std::string& beside, const std::string& path)
{
  bring_to_disk(beside);
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error)
    throw RunError(fmt::format("cannot rename {} to {}: {}", beside, path, error.message()));
}

void write_whole(const std::string& path, std::string_view text)
{
  if (path.empty() || path == "-") {
    std::cout << text;
    return;
  }
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status)) {
    // A device or a pipe is written to, never replaced.
    std::ofstream out(path, std::ios::binary);
    out << text << std::flush;
    if (!out) throw RunError(fmt::format("cannot write {}", path));
    return;
  }
  const std::string beside = fmt::format("{}.tmp.{}", path, getpid());
  const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const auto fail = [&](const char* what) {
    const std::string why = std::strerror(errno);
    if (file >= 0) {
      close(file);
      unlink(beside.c_str());
    }
    throw RunError(fmt::format("cannot {} {}: {}", what, path, why));
  };
  if (file < 0) fail("create");
  for (std::size_t done = 0; done < text.size();) {
    const auto count = write(file, text.data() + done, text.size() - done);
    if (count < 0) fail("write");
    done += static_cast<std::size_t>(count);
  }
  if (fsync(file) != 0) fail("write");
  if (rename(beside.c_str(), path.c_str()) != 0) fail("rename to");
  close(file);
}

std::string the_run(const po::variables_map& values, const char* remedy)
{
  if (values.count("input") == 0)
    throw UsageError("no run given; name a trajectory file, e.g. run.h5");
  const auto& inputs = values["input"].as<std::vector<std::string>>();
  if (inputs.size() != 1) throw UsageError(fmt::format("{} runs given; {}", inputs.size(), remedy));
  return inputs[0];
}

po::typed_value<double>* time_option(std::optional<double>& place)
{
  return po::value<double>()->value_name("s")->notifier([&place](double time) { place = time; });
}

void refuse_to_overwrite(const std::string& path, bool overwrite)
{
  if (std::filesystem::is_directory(path))
    throw UsageError(fmt::format("{} is a folder; name a file in it", path));
  if (!overwrite && std::filesystem::exists(path))
    throw UsageError(fmt::format(
        "{} is there already; choose another name, remove it, or say --overwrite", path));
}

void require_file(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UsageError(fmt::format("{}: there is no such file", path));
  if (std::filesystem::is_directory(path, error))
    throw UsageError(fmt::format("{}: is a folder, not a file", path));
  if (access(path.c_str(), R_OK) != 0)
    throw UsageError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
}

}  // namespace grseg
