// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/provenance.hpp"

#include "formats/cli/bed.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"
#include "formats/core/version.hpp"
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace grseg {
namespace {

/// Adds a header line `key` for each line of the text `parameter` of the run.
void add_lines(Header& header, const char* key, const TrajectoryReader& run, const char* parameter)
{
  std::istringstream lines(run.parameters().text(parameter));
  for (std::string line; std::getline(lines, line);) header.emplace_back(key, printable(line));
}

}  // namespace

HeaderLine program_line(const ToolInfo& info)
{
  return {"program", fmt::format("{} {}", info.name, version())};
}

Header provenance(const ToolInfo& info, const std::string& preset, const TrajectoryReader& run,
                  const std::string& command)
{
  Header header{program_line(info)};
  if (!info.presets.empty()) header.emplace_back("preset", preset);
  add_lines(header, "history", run, "history");
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

// Largest relative difference of settings that count as equal. A window computed as the difference
// of two times t has a round-off error of 2^-52 t, which is below this limit up to t = four million
// windows. Other settings are products of two or three numbers. Settings that really differ do so
// by a time step or a typed digit, which is more.
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
    const bool near =
        x && y && std::abs(*x - *y) <= setting_round_off * std::max(std::abs(*x), std::abs(*y));
    if (!near && word != other) return false;
  }
  return !(others >> other);
}

std::vector<Table> read_tables(const po::variables_map& values, const WantedTables& wanted)
{
  if (!wanted.greedy.empty() && !values.contains("input") &&
      values.contains(wanted.greedy.substr(2)))
    throw UsageError(fmt::format(
        "no table given, because {} takes all files behind it; put {} and its files last",
        wanted.greedy, wanted.greedy));
  if (!values.contains("input")) throw UsageError("no table given; " + wanted.remedy);
  std::vector<Table> tables;
  const auto& paths = values["input"].as<std::vector<std::string>>();
  if (std::count(paths.begin(), paths.end(), "-") > 1)
    throw UsageError("standard input, -, can be read only once");
  tables.reserve(paths.size());
  for (const auto& path : paths) tables.push_back(Table::read(path, &wanted));
  return tables;
}

Header trust_of(const std::vector<Table>& tables)
{
  Header lines;
  auto verified = header_values(tables, "verified");
  if (verified.size() > 1) std::erase(verified, "all");
  for (auto& value : verified) lines.emplace_back("verified", std::move(value));
  for (const char* key : {"incomplete", "undecided", "waived", "doubt"})
    for (auto& value : header_values(tables, key)) lines.emplace_back(key, std::move(value));
  return lines;
}

void TrustOption::add_to(po::options_description& options)
{
  options.add_options()("trust", po::bool_switch(&trust),
                        "do not verify the content of runs with the digests in their files");
}

Header verification_lines(const TrajectoryReader& run)
{
  Header lines{{"verified", run.verified()}};
  if (!run.closed())
    lines.emplace_back(
        "incomplete",
        run.size() == 0
            ? std::string("the run had not ended, and had no frame")
            : fmt::format("the run had not ended; it had {} frames, the last at {:.9g} s",
                          run.size(), run.times().back()));
  add_lines(lines, "cell", run, "import_cell");
  add_lines(lines, "coordinates", run, "import_coordinates");
  add_lines(lines, "undecided", run, "import_undecided");
  add_lines(lines, "waived", run, "import_waived");
  add_lines(lines, "remarks", run, "import_remarks");
  return lines;
}

}  // namespace grseg
