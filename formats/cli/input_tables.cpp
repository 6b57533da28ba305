// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/input_tables.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

namespace grseg {
namespace {

void remark_on_versions(const ToolInfo& info, const std::vector<Table>& tables)
{
  std::map<std::string, int> number_of;
  for (const auto& table : tables)
    if (!table.version_without_end.empty()) ++number_of[table.version_without_end];
  for (const auto& [version, number] : number_of) {
    const bool one = number == 1;
    fmt::print(stderr, "{}: {} {} of grseg {} {} no checksum; make {} anew to have {} verified\n",
               info.name, number, one ? "table" : "tables", version, one ? "carries" : "carry",
               one ? "it" : "them", one ? "it" : "them");
  }
}

}  // namespace

std::vector<Table> read_tables(const ToolInfo& info, const po::variables_map& values, bool quiet)
{
  std::vector<Table> tables;
  if (!values.contains("input")) return tables;
  const auto& paths = values["input"].as<std::vector<std::string>>();
  if (std::count(paths.begin(), paths.end(), "-") > 1)
    throw UsageError("standard input, -, can be read only once");
  tables.reserve(paths.size());
  for (const auto& path : paths) tables.push_back(Table::read(path));
  if (!quiet) remark_on_versions(info, tables);
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

}  // namespace grseg
