// SPDX-License-Identifier: GPL-3.0-or-later
// Reads tables as grseg-fit, grseg-merge and grseg-derive do. The parts of an input are tables,
// each with the last line that it should have.
#include "analysis/fit/fit_data.hpp"
#include "analysis/micro/sums_table.hpp"
#include "analysis/stress/merge_tables.hpp"
#include "formats/cli/table.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

using namespace grseg;

/// The table plus a correct last line.
std::string ended(std::string_view part)
{
  std::string text(part.substr(0, part.find(end_mark)));
  std::size_t rows = 0;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    rows += text[at] != '#';
    if (text.find('\n', at) == std::string::npos) break;
  }
  return text + end_line(text, rows > 0 ? rows - 1 : 0) + "\n";
}

void read(const std::vector<Table>& tables)
{
  fuzz::try_to([&] {
    const auto contact = Quantity::contact;
    select_fit_data(read_fit_tables(tables, contact, parse_rules({"stock"})), contact, {},
                    {{0, 1}});
  });
  fuzz::try_to([&] {
    const auto kinetic = Quantity::kinetic;
    select_fit_data(read_fit_tables(tables, kinetic, {}), kinetic, {{.heights = "1dS:"}}, {{0, 1}});
  });
  constexpr ToolInfo tool{"grseg-stress", "", "", ""};
  fuzz::try_to([&] { merge_tables(tables, tables.size() % 2 == 0, tool, "fuzz"); });
  for (const auto& table : tables) {
    fuzz::try_to([&] { read_run_constants(table); });
    fuzz::try_to([&] { read_sums_rows<2>(table); });
    fuzz::try_to([&] { read_sums_rows<3>(table); });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::vector<Table> tables;
  fuzz::try_to([&] {
    for (const auto part : fuzz::parts_of(fuzz::text_of(data, size)))
      tables.push_back(Table::parse(ended(part), "table"));
  });
  read(tables);
  for (const auto& table : tables) {
    const auto text = table.to_text();
    table.to_json();
    // Comments of tables made by hand need not have the form "# key: value".
    if (table.made_by_hand()) continue;
    fuzz::try_to([&] {
      fuzz::require(Table::parse(text, "again").to_text() == text,
                    "a table is read as it was written");
    });
  }
  return 0;
}
