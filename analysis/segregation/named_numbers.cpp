// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/named_numbers.hpp"

#include "formats/cli/table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace grseg {

std::string to_tsv(const NamedNumbers& summary, Header header)
{
  for (const auto& remark : summary.remarks) header.emplace_back("remark", remark);
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, number] : summary.numbers)
    rows.push_back(
        {name, format_number(number.value), format_number(number.low), format_number(number.high)});
  return table_text(header, {"quantity", "value", "low", "high"}, rows);
}

std::string to_json(const NamedNumbers& summary, const Header& header)
{
  using Json = nlohmann::ordered_json;
  Json numbers = Json::object();
  for (const auto& [name, number] : summary.numbers)
    numbers[name] = {{"value", number.value}, {"interval", {number.low, number.high}}};
  Table table;
  table.header = header;
  Json all{{"numbers", numbers}, {"remarks", summary.remarks}};
  const auto rest = Json::parse(table.to_json());
  for (const char* key : {"settings", "inputs", "history", "bed", "verified", "incomplete",
                          "undecided", "waived", "doubt"})
    if (rest.contains(key)) all[key] = rest[key];
  return all.dump(2) + '\n';
}

void write_numbers(const NamedNumbers& numbers, const Header& header, const ToolInfo& info,
                   const TableOptions& output, bool json, bool quiet)
{
  if (!quiet)
    for (const auto& remark : numbers.remarks) fmt::print(stderr, "{}: {}\n", info.name, remark);
  write_table(output, json ? to_json(numbers, header) : to_tsv(numbers, header));
}

}  // namespace grseg
