// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/make_report.hpp"

#include "analysis/fit/data_doubts.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/flow_verdict.hpp"
#include "analysis/fit/time_series.hpp"
#include "analysis/fit/two_readings.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace grseg {
namespace {

const std::vector<std::string> fit_words{"paper"};

std::string rules_help()
{
  std::string text =
      "rules for the large grain's share of the stress of a mixed contact (between a large and a "
      "small grain); the table has a row for each rule.";
  for (const auto& rule : rule_definitions())
    text += fmt::format("\n{}{}{}{}: {}{}", rule.word, *rule.number == '\0' ? "" : ":", rule.number,
                        rule.kind == PartitionRule{}.kind ? " (default)" : "", rule.meaning,
                        *rule.used_by == '\0' ? "" : fmt::format(" [{}]", rule.used_by));
  text += "\nstock:";
  for (const auto& rule : parse_rules({"stock"})) text += fmt::format(" {}", rule.name());
  return text;
}

std::string over_help()
{
  std::string text =
      "statistical population that the 95 % intervals are for. A run is one simulation; a flow is "
      "a set of runs that differ only in their seed; a window is an interval of time in a run.";
  for (const auto& [word, population, meaning] : populations)
    text += fmt::format("\n{}: {}", word, meaning);
  return text +
         "\ndefault: windows for one run, runs for several runs of one flow; for several flows a row "
         "for each flow over its runs, then rows for all flows together over flows";
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

}  // namespace

po::options_description FitOptions::description()
{
  po::options_description options("Options");
  const auto text = [](std::string& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  const auto number = [](auto& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  auto add = options.add_options();
  add("partition", words_option(partition, words_of_rules()), rules_help().c_str());
  add("component", word_option(&component, words_of(components)),
      ("component of the stress: " + list_of(components)).c_str());
  add("quantity", word_option(&quantity, words_of(quantities)),
      ("stress to fit: " + list_of(quantities)).c_str());
  add("fit", word_option(&fit, fit_words),
      "paper: also print the fits of Staron & Phillips (2015): s of sigma^S/sigma^L = s "
      "phi_S/phi_L, B from s, and k and a of sigma^S/sigma^L = k (phi_S/phi_L)^a");
  add("base-part", word_option(&base, words_of(base_parts)),
      ("part of the stress of a contact with base or wall that its grain gets: " +
       list_of(base_parts) + " (default: as in the table)")
          .c_str());
  add("thickness", word_option(&thickness, words_of(thicknesses)),
      ("part of B that comes from the thickness of the layers: " + list_of(thicknesses)).c_str());
  add("pair", text(pair, "A,B"), "B of these two species, by name or number (default: all pairs)");
  add("exponent", po::bool_switch(&exponent),
      "also print the exponent a by which stress depends on grain size: sigma^nu/sigma = phi^nu "
      "s_nu^a/(sum over mu of phi^mu s_mu^a), s_nu: diameter of species nu; always printed for three "
      "or more species");
  add("scan", text(scan, "p0:p1:dp"),
      "instead of B by rules, print B as function of the large grain's share p, from p0 to p1 in "
      "steps of dp");
  add("series", po::bool_switch(&series),
      "instead of B by rules, print a row for each window: B by each rule, phi_L, speed, and more; "
      "scripts/figures/over-time.gp draws it");
  add("minus", po::value(&minus)->multitoken()->value_name("FILES"),
      "tables of the same runs read another way, such as with thinner layers: also print B minus "
      "theirs, over the same windows; put this option last");
  add("over", word_option(&over, words_of(populations)), over_help().c_str());
  add("flows", text(flows, "N,N,...")->default_value("auto"),
      "number of tables of each flow, in the order of the tables; auto: tables are of one flow if "
      "their headers and overall compositions agree");
  add("ratio-range", text(ratio_range, "a:b")->default_value("0.01:100"),
      "range of phi_S/phi_L of the layers to use");
  filters.add_layers_to(options);
  add("min-shear", number(filters.min_shear, "X")->default_value(0, "0"),
      "leave out layers or cells whose mean flow shears by less than X 1/s (tables of grseg-kinetic)");
  filters.add_times_to(options);
  add("json", po::bool_switch(&json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&quiet), "print no remarks on standard error");
  output.add_to(options);
  return options;
}

WantedTables FitOptions::wanted() const
{
  if (quantity == "kinetic")
    return {
        {"", "grseg-kinetic"},
        "with --quantity kinetic name tables of grseg-kinetic, such as kinetic.tsv of grseg-kinetic "
        "run.h5 -o kinetic.tsv, or - for standard input",
        "--minus"};
  return {
      {"", "grseg-stress", "grseg-merge"},
      "name tables of grseg-stress, such as sums.tsv of grseg-stress run.h5 -o sums.tsv, or - for "
      "standard input; tables of grseg-kinetic need --quantity kinetic",
      "--minus"};
}

void FitOptions::check(const po::variables_map& values)
{
  output.check(values);
  filters.check();
  if (!over.empty()) choose(over, "--over", populations);
  if (!fit.empty() && fit != fit_words[0]) throw UsageError(unknown_word("--fit", fit, fit_words));
  parse_rules(partition);
  if (!scan.empty()) parse_scan(scan);
  if (series && (!scan.empty() || !minus.empty() || json))
    throw UsageError("--series prints B of each window; leave out --scan, --minus and --json");
  if (!scan.empty() && !minus.empty())
    throw UsageError("--minus compares B by rules; leave out --scan, or --minus");
  if (quantity == "kinetic")
    for (const char* option : {"partition", "scan", "base-part"})
      if (values.contains(option) && !values[option].defaulted())
        throw UsageError(
            fmt::format("--{} concerns contacts; leave it out with --quantity kinetic", option));
  if (!(filters.min_shear >= 0)) throw UsageError("--min-shear must not be negative");
  if (quantity == "contact" && filters.min_shear > 0)
    throw UsageError(
        "--min-shear concerns the mean flow; use it with --quantity kinetic, or select heights");
  parse_ratio_range(ratio_range, filters);
}

namespace {

std::vector<PartitionRule> rules_of(const FitOptions& s, const Table& first)
{
  if (s.quantity == "kinetic") return {PartitionRule{}};
  if (!s.partition.empty()) return parse_rules(s.partition);
  return {parse_rule(header_or(first, "partition", "size"))};
}

/// Pairs of species to fit. Throws UsageError if the tables have fewer than two species, or more
/// than two for a scan.
std::vector<SpeciesPair> pairs_of(const FitOptions& s, const SpeciesList& species)
{
  if (species.size() < 2)
    throw UsageError(
        "the tables have one species, and B compares two; make them with --classes or --edges");
  if (!s.scan.empty() && species.size() > 2)
    throw UsageError("--scan: p* compares two species; merge the others with grseg-stress --group");
  if (!s.pair.empty()) return {parse_pair(s.pair, species)};
  return all_pairs(species.size());
}

/// Moves the pairs that have no points in `data` from `pairs` to the result.
std::vector<SpeciesPair> take_pairs_without_points(std::vector<SpeciesPair>& pairs,
                                                   const FitData& data)
{
  const auto fitted =
      std::stable_partition(pairs.begin(), pairs.end(), [&](const SpeciesPair& pair) {
        return std::ranges::find(data.samples, pair, &LayerSample::pair) != data.samples.end();
      });
  std::vector<SpeciesPair> without(fitted, pairs.end());
  pairs.erase(fitted, pairs.end());
  return without;
}

/// Throws UsageError if the runs and flows of the tables do not allow the population of --over.
void require_population(const FitOptions& s, const FitData& data)
{
  if (s.over.empty()) return;
  const auto over = choose(s.over, "--over", populations);
  const auto flows = data.number_of_flows();
  if (over == Population::runs && flows > 1)
    throw UsageError(
        fmt::format("--over runs: the tables are of {} flows; without --over each flow has its "
                    "own interval, --over flows gives one number for all, and --flows says "
                    "which tables belong together",
                    flows));
  if (over == Population::runs && data.runs.size() < 2)
    throw UsageError(
        "--over runs: there is one run; name tables of several runs, or use --over windows");
  if (over == Population::flows && flows < 2)
    throw UsageError(
        "--over flows: all tables are of one flow; leave the option out, or say with --flows which "
        "tables belong together");
}

/// Population of the intervals: "runs", or "runs, then flows" if each flow has its own rows.
std::string over_words(const FitReport& report)
{
  const auto of = [](const RuleFit& fit) { return std::string(word_of(fit.over, populations)); };
  const auto& rows = report.scan ? report.scan->fits : report.rules;
  return rows.front().flow ? of(rows.front()) + ", then " + of(rows.back()) : of(rows.back());
}

/// Header lines with the settings of the fit and the numbers of rows, runs and windows.
Header header_of(const ToolInfo& info, const FitOptions& s, const std::string& preset,
                 const std::vector<Table>& tables, const FitReport& report, const FitData& data)
{
  const bool all_times = std::isinf(s.filters.begin) && std::isinf(s.filters.end);
  const auto least_shear = s.filters.min_shear > 0
                               ? Header{{"min_shear", format_number(s.filters.min_shear)}}
                               : Header{};
  Header header{
      program_line(info),
      {"preset", preset},
      {"quantity", s.quantity},
      {"component", s.component},
      {"thickness", s.thickness},
      {"ratio_range", s.ratio_range},
      {"heights", heights_in_words(s.filters.heights, has_annuli(tables[0]))},
      {"times", all_times ? "all" : fmt::format("{:g}:{:g}", s.filters.begin, s.filters.end)},
      {"min_solid", format_number(s.filters.min_solid)}};
  add_all(header, least_shear);
  return add_all(header, {{"rows", data.count.sentence()},
                          {"runs", fmt::format("{}", data.runs.size())},
                          {"windows", fmt::format("{}", number_of_windows(data.runs))},
                          {"interval", "95 %"},
                          {"over", over_words(report)},
                          {"flows", grouping_words(s.flows, tables)}});
}

PartitionScan scan(const char* program, const FitData& data, const ScanRange& range,
                   const FitSettings& settings, bool quiet)
{
  const auto shares = static_cast<double>(range.shares().size());
  ProgressBar progress(program, {.things = "shares", .total = shares}, quiet);
  return scan_partition(data, range, settings, [&](double done) { progress.show(done); });
}

}  // namespace

FitReport make_report(const ToolInfo& info, const FitOptions& s, const std::string& preset,
                      const std::vector<Table>& tables)
{
  const auto base = s.base.empty() ? header_or(tables[0], "base", "contact-point") : s.base;
  FitReport report;
  report.quantity = choose(s.quantity, "--quantity", quantities);
  report.component = choose(s.component, "--component", components);
  const FitSettings settings{
      report.component, choose(base, "--base-part", base_parts),
      s.over.empty() ? Population::automatic : choose(s.over, "--over", populations),
      choose(s.thickness, "--thickness", thicknesses)};
  const auto rules = rules_of(s, tables[0]);
  auto all = read_fit_tables(tables, report.quantity, rules);
  report.flows = find_flows(all, s.flows);
  for (const auto& table : tables) report.table_names.push_back(table.name);
  report.shared_runs = tables_of_shared_runs(all);
  report.species = all.front().species;
  auto pairs = pairs_of(s, report.species);
  const auto data = select_fit_data(all, report.quantity, s.filters, pairs);
  for (const auto& pair : take_pairs_without_points(pairs, data))
    report.doubts_of_tables.push_back(
        fmt::format("B of {} and {} is not fitted: no layer that is used holds enough of both",
                    report.species[pair.smaller].name, report.species[pair.larger].name));
  require_population(s, data);
  report.shares = weight_shares(data, report.flows.size());
  report.rules = fit_pairs(all, report.quantity, s.filters, pairs, rules, settings,
                           s.exponent || report.names_pairs());
  if (!s.minus.empty()) {
    const auto wanted = s.wanted();
    const auto others =
        listed(s.minus, [&](const auto& path) { return Table::read(path, &wanted); });
    require_same_runs(tables, others);
    auto read_otherwise = read_fit_tables(others, report.quantity, rules);
    find_flows(read_otherwise, s.flows);
    add_differences(report.rules, {all, report.quantity, s.filters},
                    {read_otherwise, report.quantity, s.filters}, settings);
    for (const auto& table : others) report.other_names.push_back(table.name);
  }
  if (!s.scan.empty()) report.scan = scan(info.name, data, parse_scan(s.scan), settings, s.quiet);
  if (s.series && pairs.size() > 1)
    throw UsageError("--series: B of a window is of two species; choose them with --pair");
  if (s.series) report.series = time_series(all, data, rules, settings);
  report.with_paper = s.fit == "paper";
  report.number_of_runs = data.runs.size();
  report.number_of_windows = number_of_windows(data.runs);

  report.header = header_of(info, s, preset, tables, report, data);
  if (report.quantity == Quantity::contact) report.header.emplace_back("base", base);
  if (names_species(report.species))
    report.header.emplace_back("species", species_text(report.species));
  report.inputs = header_values(tables, "input");
  for (auto& line : trust_of(tables))
    if (line.first == "doubt")
      report.doubts_of_tables.push_back(line.second);
    else
      report.trust.push_back(std::move(line));
  for (auto& doubt : doubts_of_tables(tables, all, data))
    report.doubts_of_tables.push_back(std::move(doubt));
  // With several pairs of species the verdict is on the first.
  const auto of_pair =
      pairs.size() == 1 ? data : select_fit_data(all, report.quantity, s.filters, {pairs.front()});
  auto verdict = verdict_on(all, of_pair, fit_rule(of_pair, rules.front(), settings), settings);
  report.verdict = std::move(verdict.sentences);
  if (pairs.size() > 1)
    report.verdict.push_back(fmt::format("B of the verdict is of {} and {}; --pair chooses others",
                                         report.species[pairs.front().smaller].name,
                                         report.species[pairs.front().larger].name));
  report.changes = verdict.changes;
  for (auto& doubt : verdict.doubts) report.doubts_of_tables.push_back(std::move(doubt));
  report.history = header_values(tables, "history");
  return report;
}

}  // namespace grseg
