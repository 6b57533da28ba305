// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/keys/key_value.hpp"

#include "formats/core/length.hpp"

#include <charconv>
#include <cstdlib>

namespace grseg::kinds {

double read_number(const std::string& key, const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  require(!text.empty() && *end == '\0', key, fmt::format("{}: '{}' is not a number", key, text));
  return number;
}

long read_whole_number(const std::string& key, const std::string& text)
{
  long number = 0;
  const auto* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  require(!text.empty() && error == std::errc() && end == last, key,
          fmt::format("{}: '{}' is not a whole number", key, text));
  return number;
}

double read_length(const std::string& key, const std::string& text, const Scene& scene)
{
  try {
    return parse_length(text, key, {scene.small_diameter, scene.small_diameter * scene.size_ratio});
  } catch (const UsageError& wrong) {
    throw SceneError(key, wrong.what());
  }
}

}  // namespace grseg::kinds
