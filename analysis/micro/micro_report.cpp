// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/micro_report.hpp"

#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

std::vector<Table> read_tables(const po::variables_map& values)
{
  if (!values.contains("input"))
    throw UsageError("no table given; name tables of grseg-micro, or - for standard input");
  std::vector<Table> tables;
  for (const auto& path : values["input"].as<std::vector<std::string>>())
    tables.push_back(Table::read(path));
  return tables;
}

ForceMeasure measure_of(const ReportOptions& options)
{
  return {
      choose<ContactForce>(options.force, "--force",
                           {{"modulus", ContactForce::modulus}, {"normal", ContactForce::normal}}),
      choose<ForceAverage>(options.average, "--average",
                           {{"contacts", ForceAverage::contacts}, {"ends", ForceAverage::ends}})};
}

PartitionRule rule_of(const ReportOptions& options)
{
  using Kind = PartitionRule::Kind;
  const auto rule = parse_rule(options.partition);
  if (rule.kind == Kind::contact_point || rule.kind == Kind::power)
    throw UsageError(fmt::format(
        "--partition {}: the table of grseg-micro has the sums for size, half, drop and uniform:P",
        rule.name()));
  return rule;
}

RowFilter filter_of(const ReportOptions& options, const FrameOptions& frames,
                    const LengthUnits& units)
{
  RowFilter filter;
  filter.begin = frames.windows.begin.value_or(filter.begin);
  filter.end = frames.windows.end.value_or(filter.end);
  if (options.heights.empty()) return filter;
  const auto colon = options.heights.find(':');
  if (colon == std::string::npos)
    throw UsageError(
        fmt::format("--heights {}: write low:high, e.g. 4dS:56dS or 4dS:", options.heights));
  const auto low = options.heights.substr(0, colon), high = options.heights.substr(colon + 1);
  if (!low.empty()) filter.lowest = parse_length(low, "--heights", units);
  if (!high.empty()) filter.highest = parse_length(high, "--heights", units);
  return filter;
}

void require_same_scale(const Table& first, const Table& other)
{
  for (const char* key : {"small_diameter", "large_diameter", "gravity_x", "gravity_y", "density",
                          "friction", "layer", "composition"})
    if (first.header_text(key) != other.header_text(key))
      throw UsageError(fmt::format("{} and {} differ in '{}'; derive from them one by one",
                                   first.name, other.name, key));
}

/// The header of the first table, with the inputs and histories of all.
Table empty_table(const ToolInfo& info, const std::vector<Table>& tables,
                  const ReportOptions& options, const std::string& preset,
                  const std::string& command)
{
  Table result;
  auto& header = result.header;
  header = {program_line(info), {"preset", preset}};
  for (const auto& line : header_values(tables, "history")) header.emplace_back("history", line);
  header.emplace_back("history", command);
  for (const auto& input : header_values(tables, "input")) header.emplace_back("input", input);
  for (const auto& line : settings_of(tables[0]))
    if (line.first != "preset") header.push_back(line);
  const std::string depth = options.depth.empty() ? "height of the bed" : options.depth;
  const std::string heights = options.heights.empty() ? "all" : options.heights;
  for (const auto& [key, value] : {std::pair{"force", options.force},
                                   {"average", options.average},
                                   {"partition", options.partition},
                                   {"depth", depth},
                                   {"heights", heights},
                                   {"pool", options.pool}})
    header.emplace_back(key, value);
  return result;
}

void add_row(Table& table, const MicroRow& row, const std::vector<Cell>& cells)
{
  if (table.columns.empty()) {
    table.columns = {"t0[s]", "t1[s]", "y0[m]", "y1[m]", "frames", "V[m^2]"};
    for (const auto& cell : cells) table.columns.push_back(cell.name);
  }
  auto& values = table.rows.emplace_back(
      std::vector<double>{row.begin, row.end, row.bottom, row.top, row.frames, row.volume});
  for (const auto& cell : cells) values.push_back(cell.value);
}

}  // namespace

void ReportOptions::add_to(po::options_description& options)
{
  const auto word = [](std::string& place) {
    return po::value(&place)->default_value(place)->value_name("WORD");
  };
  auto add = options.add_options();
  add("force", word(force), "with --derived, the force of a contact: modulus, or normal part");
  add("average", word(average),
      "likewise, f_S and f_L over contacts with at least one such grain, each once, or over ends "
      "on "
      "such grains");
  add("partition", word(partition),
      "likewise, the large grain's share of a mixed contact in P_S and P_L: size, half, drop or "
      "uniform:P");
  add("pool", word(pool),
      "likewise, rows as they are: none; or merged by layer: windows; or by phi_L: composition");
  add("depth", po::value(&depth)->value_name("LENGTH"),
      "likewise, H of forces in units of the pressure below H - y (default: the bed's height)");
  add("heights", po::value(&heights)->value_name("y0:y1"),
      "likewise, layers that take part lie between, e.g. 4dS:56dS or 4dS: (default: all)");
}

void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why)
{
  for (const char* option : options)
    if (values.contains(option) && !values[option].defaulted())
      throw UsageError(fmt::format("--{} {}", option, why));
}

void report_derived(const ToolInfo& info, const po::variables_map& values,
                    const ReportOptions& options, const FrameOptions& frames,
                    const std::string& command)
{
  refuse_options(values,
                 {"layer", "window", "stride", "threads", "composition", "friction", "unit", "bin",
                  "distribution"},
                 "belongs to the making of the sums; leave it out with --derived");
  const auto pool = choose<Pool>(
      options.pool, "--pool",
      {{"none", Pool::none}, {"windows", Pool::windows}, {"composition", Pool::composition}});
  ViewSettings settings{measure_of(options), rule_of(options), 0};
  const auto tables = read_tables(values);
  std::vector<MicroRow> rows;
  for (const auto& table : tables) {
    const auto more = read_micro_rows(table);
    require_same_scale(tables[0], table);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  const auto scale = read_micro_scale(tables[0]);
  const LengthUnits units{scale.small_diameter, scale.large_diameter};
  if (!options.depth.empty()) settings.depth = parse_length(options.depth, "--depth", units);

  auto table = empty_table(info, tables, options, preset_of(values), command);
  for (const auto& row : pooled(filtered(std::move(rows), filter_of(options, frames, units)), pool))
    add_row(table, row, derived(row, scale, settings));
  if (table.rows.empty())
    throw RunError("no row is left; choose another --begin, --end or --heights");
  write_whole(frames.output, frames.json ? table.to_json() : table.to_text());
}

}  // namespace grseg
