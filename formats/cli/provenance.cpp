// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/provenance.hpp"

#include "formats/cli/bed.hpp"
#include "formats/cli/numbers.hpp"
#include "formats/core/text.hpp"
#include "formats/core/version.hpp"
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace grseg {

HeaderLine program_line(const ToolInfo& info)
{
  return {"program", fmt::format("{} {}", info.name, version())};
}

Header provenance(const ToolInfo& info, const std::string& preset, const TrajectoryReader& run,
                  const std::string& command)
{
  Header header{program_line(info)};
  if (!info.presets.empty()) header.emplace_back("preset", preset);
  std::istringstream history(run.parameters().text("history"));
  for (std::string line; std::getline(history, line);)
    header.emplace_back("history", printable(line));
  header.emplace_back("history", command);
  header.emplace_back("input", fmt::format("xxh3 {}", format_digest(run.digest())));
  header.emplace_back("bed", bed_of(run).text());
  return header;
}

std::vector<std::string> header_values(const Table& table, const std::string& key)
{
  std::vector<std::string> values;
  for (const auto& [known, value] : table.header)
    if (known == key) values.push_back(value);
  return values;
}

std::vector<std::string> header_values(const std::vector<Table>& tables, const std::string& key)
{
  std::vector<std::string> values;
  for (const auto& table : tables)
    for (const auto& value : header_values(table, key))
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  return values;
}

std::string header_or(const Table& table, const std::string& key, const std::string& otherwise)
{
  const auto values = header_values(table, key);
  return values.empty() ? otherwise : values.front();
}

Header settings_of(const Table& table)
{
  Header settings = table.header;
  std::erase_if(settings, [](const HeaderLine& line) {
    for (const char* key : {"program", "history", "input", "bed", "scene", "verified", "incomplete",
                            "undecided", "waived", "doubt"})
      if (line.first == key) return true;
    return false;
  });
  return settings;
}

// A difference of two times t in double precision is off by 2^-52 t: by less than this part of a window
// for t up to four million windows. Other settings are products of two or three numbers. What was set
// otherwise differs by a step of time or a digit that was typed, which is more.
constexpr double setting_round_off = 1e-9;

bool same_setting(const std::string& a, const std::string& b)
{
  if (a == b) return true;
  const auto blanks = [](std::string text) {
    std::replace(text.begin(), text.end(), ',', ' ');
    return std::istringstream(text);
  };
  auto words = blanks(a), others = blanks(b);
  std::string word, other;
  while (words >> word) {
    if (!(others >> other)) return false;
    const auto x = parse_number(word), y = parse_number(other);
    if (x && y ? std::abs(*x - *y) > setting_round_off * std::max(std::abs(*x), std::abs(*y))
               : word != other)
      return false;
  }
  return !(others >> other);
}

}  // namespace grseg
