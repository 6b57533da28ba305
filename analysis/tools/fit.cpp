// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_report.hpp"
#include "analysis/fit/partition_scan.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/stress/partition.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-fit", "the segregation strength B, with its interval, from tables of sums.",
    "grseg-fit sums.tsv ... | - [options]",
    "  grseg-fit sums.tsv                               B by size, the default\n"
    "  grseg-fit sums.tsv --partition stock             B by the rules of published codes\n"
    "  grseg-fit a.tsv b.tsv --partition size,half      several runs, several rules\n"
    "  grseg-fit sums.tsv --scan 0.4:0.9:0.005          B over the large grains' share\n"
    "  grseg-fit kinetic.tsv --quantity kinetic         B of the kinetic stress\n"
    "  grseg-stress run.h5 | grseg-fit - --json         without a file in between\n",
    presets::fit};

struct Settings {
  std::vector<std::string> partition;
  std::string component, quantity, base, scan, ratio_range, heights, output;
  int bootstrap = 0;
  long seed = 0;
  FitFilters filters;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  const auto text = [](std::string& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  const auto number = [](auto& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  auto add = options.add_options();
  add("partition", po::value(&s.partition)->composing()->value_name("RULE,..."),
      "share of a mixed contact that goes to its large grain: size (default), contact-point, half, "
      "drop, uniform:P or power:Q; several give a row each; stock: the first four, as published "
      "codes have them");
  add("component", text(s.component, "NAME")->default_value("yy"),
      "yy or pressure (half the trace)");
  add("quantity", text(s.quantity, "NAME")->default_value("contact"), "contact or kinetic stress");
  add("base", text(s.base, "NAME"),
      "part of contacts with base and walls: contact-point, half or none (default: what the table "
      "says)");
  add("scan", text(s.scan, "p0:p1:dp"), "print B over the share p instead of the rules");
  add("bootstrap", number(s.bootstrap, "N")->default_value(1000),
      "samples for the 95 % intervals; 0: no intervals");
  add("seed", number(s.seed, "N")->default_value(1), "seed of the samples");
  add("ratio-range", text(s.ratio_range, "a:b")->default_value("0.01:100"),
      "phi_S/phi_L of the layers that take part");
  add("heights", text(s.heights, "y0:y1"),
      "layers that take part lie between, e.g. 4dS:56dS or 4dS: (default: all)");
  add("min-solid", number(s.filters.min_solid, "X")->default_value(0.5, "0.5"),
      "least solid fraction of a layer, in units of the run's median");
  add("begin", number(s.filters.begin, "s"), "first time of the windows that take part");
  add("end", number(s.filters.end, "s"), "last time of the windows that take part");
  add("json", "print JSON instead of a table");
  add("quiet", "no remarks on standard error");
  add("output,o", text(s.output, "FILE"), "write there instead of to standard output");
  return options;
}

void parse_ratio_range(const std::string& text, FitFilters& filters)
{
  int used = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%n", &filters.ratio_low, &filters.ratio_high, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() ||
      !(filters.ratio_low > 0 && filters.ratio_low <= filters.ratio_high))
    throw UsageError(
        fmt::format("--ratio-range {}: write low:high, 0 < low <= high, e.g. 0.01:100", text));
}

void parse_heights(const std::string& text, FitFilters& filters)
{
  const auto colon = text.find(':');
  if (!text.empty() && colon == std::string::npos)
    throw UsageError(fmt::format("--heights {}: write low:high, e.g. 4dS:56dS or 4dS:", text));
  filters.lowest = text.substr(0, colon);
  filters.highest = text.empty() ? "" : text.substr(colon + 1);
}

/// Refuses what cannot be meant, before any table is read.
void check(const Settings& s, const po::variables_map& values)
{
  if (!values.contains("input"))
    throw UsageError("no table given; name tables of grseg-stress, or - for standard input");
  const auto& inputs = values["input"].as<std::vector<std::string>>();
  if (std::count(inputs.begin(), inputs.end(), "-") > 1)
    throw UsageError("standard input, -, can be read only once");
  if (s.bootstrap != 0 && (s.bootstrap < 100 || s.bootstrap > 100000))
    throw UsageError(fmt::format("--bootstrap {}: 0, or 100 to 100000 samples", s.bootstrap));
  if (s.seed < 0) throw UsageError("--seed must not be negative");
  if (std::isnan(s.filters.begin) || std::isnan(s.filters.end))
    throw UsageError("--begin and --end are times in seconds");
  if (!(s.filters.min_solid >= 0)) throw UsageError("--min-solid must not be negative");
  parse_rules(s.partition);
  if (!s.scan.empty()) parse_scan(s.scan);
  if (s.quantity == "kinetic")
    for (const char* option : {"partition", "scan", "base"})
      if (values.contains(option) && !values[option].defaulted())
        throw UsageError(
            fmt::format("--{} concerns contacts; leave it out with --quantity kinetic", option));
}

std::vector<PartitionRule> rules_of(const Settings& s, const Table& first)
{
  if (s.quantity == "kinetic") return {PartitionRule{}};
  if (!s.partition.empty()) return parse_rules(s.partition);
  return {parse_rule(header_or(first, "partition", "size"))};
}

/// Says on standard error what a reader of the numbers should know.
void remark(const std::vector<Table>& tables, const FitReport& report)
{
  for (const char* key : {"assign", "width", "layer", "window", "base", "partition", "step"})
    for (const auto& table : tables)
      if (header_or(table, key, "") != header_or(tables[0], key, ""))
        std::cerr << fmt::format("{}: {} and {} differ in '{}'\n", info.name, tables[0].name,
                                 table.name, key);
  for (const auto& doubt : doubts(report)) std::cerr << fmt::format("{}: {}\n", info.name, doubt);
}

FitReport make_report(const Settings& s, const std::string& preset,
                      const std::vector<Table>& tables)
{
  const auto base = s.base.empty() ? header_or(tables[0], "base", "contact-point") : s.base;
  FitReport report;
  report.quantity = choose<Quantity>(
      s.quantity, "--quantity", {{"contact", Quantity::contact}, {"kinetic", Quantity::kinetic}});
  report.component = choose<Component>(s.component, "--component",
                                       {{"yy", Component::yy}, {"pressure", Component::pressure}});
  const FitSettings settings{report.component, parse_base(base)};
  const auto rules = rules_of(s, tables[0]);
  auto read = rules;
  if (!s.scan.empty()) read.push_back({PartitionRule::Kind::uniform});
  const auto data = read_fit_data(tables, report.quantity, s.filters, read);
  const Bootstrap bootstrap(data.runs, static_cast<std::size_t>(s.bootstrap),
                            static_cast<unsigned long>(s.seed));
  for (const auto& rule : rules) report.rules.push_back(fit_rule(data, rule, settings, bootstrap));
  if (!s.scan.empty()) report.scan = scan_partition(data, parse_scan(s.scan), settings, bootstrap);

  report.header = {
      program_line(info),
      {"preset", preset},
      {"quantity", s.quantity},
      {"component", s.component},
      {"ratio_range", s.ratio_range},
      {"heights", s.heights.empty() ? "all" : s.heights},
      {"times",
       s.filters.all_times() ? "all" : fmt::format("{:g}:{:g}", s.filters.begin, s.filters.end)},
      {"min_solid", format_number(s.filters.min_solid)},
      {"rows", data.count.sentence()},
      {"runs", fmt::format("{}", data.runs.size())},
      {"windows", fmt::format("{}", bootstrap.windows())},
      {"bootstrap", fmt::format("{}", s.bootstrap)},
      {"seed", fmt::format("{}", s.seed)},
      {"interval", "95 %"}};
  if (report.quantity == Quantity::contact) report.header.emplace_back("base", base);
  report.inputs = header_values(tables, "input");
  report.history = header_values(tables, "history");
  return report;
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    check(settings, values);
    parse_ratio_range(settings.ratio_range, settings.filters);
    parse_heights(settings.heights, settings.filters);
    std::vector<Table> tables;
    for (const auto& path : values["input"].as<std::vector<std::string>>())
      tables.push_back(Table::read(path));

    auto report = make_report(settings, preset_of(values), tables);
    report.history.push_back(command_line(argc, argv));
    if (!values.contains("quiet")) remark(tables, report);
    write_whole(settings.output, values.contains("json") ? to_json(report) : to_tsv(report));
  });
}
