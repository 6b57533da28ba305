// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/make_report.hpp"

#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/over.hpp"
#include "analysis/fit/start_of_flow.hpp"
#include "analysis/fit/table_doubts.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/cli/input_tables.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

std::vector<PartitionRule> rules_of(const FitOptions& s, const Table& first)
{
  if (s.quantity == "kinetic") return {PartitionRule{}};
  if (!s.partition.empty()) return parse_rules(s.partition);
  return {parse_rule(header_or(first, "partition", "size"))};
}

/// UsageError where the species of the tables do not make a pair, or too many for a scan.
std::vector<SpeciesPair> pairs_of(const FitOptions& s, const SpeciesList& species)
{
  if (species.size() < 2)
    throw UsageError(
        "the tables have one species, and B compares two; make them with --classes or --edges");
  if (!s.scan.empty() && species.size() > 2)
    throw UsageError(
        "--scan: p* is that of two species; merge the others with grseg-stress --group");
  if (!s.pair.empty()) return {parse_pair(s.pair, species)};
  return all_pairs(species.size());
}

/// UsageError where the runs and flows at hand cannot be the population asked for.
void require_population(const FitOptions& s, const FitData& data)
{
  if (s.over.empty()) return;
  const auto over = choose(s.over, "--over", overs);
  const auto flows = data.number_of_flows();
  if (over == Over::runs && flows > 1)
    throw UsageError(
        fmt::format("--over runs: the tables hold runs of {} flows; without --over each has its "
                    "own interval, --over flows gives one number for all, and --flows tells "
                    "which tables belong together",
                    flows));
  if ((over == Over::runs || over == Over::compositions) && data.runs.size() < 2)
    throw UsageError(fmt::format(
        "--over {}: there is one run; give the tables of several, or --over windows", s.over));
  const bool of_flows =
      over == Over::flows || over == Over::equal_flows || over == Over::random_flows;
  if (of_flows && flows < 2)
    throw UsageError(fmt::format(
        "--over {}: all tables are of one flow; leave the option out, or tell with --flows "
        "which tables belong together",
        s.over));
  if (!s.scan.empty() && (over == Over::equal_flows || over == Over::random_flows))
    throw UsageError(
        fmt::format("--scan: B(p) has no intervals over {}; choose --over flows or windows, or "
                    "scan each flow by itself",
                    s.over));
}

/// What the rows' intervals are over: "runs", or "runs, then flows" of flows one by one.
std::string over_words(const FitReport& report)
{
  const auto of = [](const RuleFit& fit) { return std::string(word_of(fit.over, overs)); };
  const auto& rows = report.scan ? report.scan->fits : report.rules;
  return rows.front().flow ? of(rows.front()) + ", then " + of(rows.back()) : of(rows.back());
}

/// The lines that say how the fit was made.
Header header_of(const ToolInfo& info, const FitOptions& s, const std::string& preset,
                 const std::vector<Table>& tables, const FitReport& report, const FitData& data)
{
  return {
      program_line(info),
      {"preset", preset},
      {"quantity", s.quantity},
      {"component", s.component},
      {"ratio_range", s.ratio_range},
      {"heights", heights_in_words(s.filters.heights)},
      {"times",
       s.filters.all_times() ? "all" : fmt::format("{:g}:{:g}", s.filters.begin, s.filters.end)},
      {"min_solid", format_number(s.filters.min_solid)},
      {"rows", data.count.sentence()},
      {"runs", fmt::format("{}", data.runs.size())},
      {"windows", fmt::format("{}", number_of_windows(data.runs))},
      {"bootstrap", fmt::format("{}", s.bootstrap)},
      {"seed", fmt::format("{}", s.seed)},
      {"interval", "95 %"},
      {"over", over_words(report)},
      {"flows", grouping_words(s.flows, tables)}};
}

PartitionScan scan(const char* program, const FitData& data, const ScanRange& range,
                   const FitSettings& settings, const Bootstrap& bootstrap, bool quiet)
{
  const auto shares = static_cast<double>(range.shares().size());
  ProgressBar progress(program, {.things = "shares", .total = shares}, quiet);
  return scan_partition(data, range, settings, bootstrap,
                        [&](double done) { progress.show(done); });
}

}  // namespace

FitReport make_report(const ToolInfo& info, const FitOptions& s, const std::string& preset,
                      const std::vector<Table>& tables)
{
  const auto base = s.base.empty() ? header_or(tables[0], "base", "contact-point") : s.base;
  FitReport report;
  report.quantity = choose(s.quantity, "--quantity", quantities);
  report.component = choose(s.component, "--component", components);
  const FitSettings settings{report.component, choose(base, "--base-part", base_parts),
                             s.over.empty() ? Over::automatic : choose(s.over, "--over", overs)};
  const auto rules = rules_of(s, tables[0]);
  auto read = rules;
  if (!s.scan.empty()) read.push_back({PartitionRule::Kind::uniform});
  auto all = read_fit_tables(tables, report.quantity, read);
  report.flows = find_flows(all, s.flows);
  for (const auto& table : tables) report.table_names.push_back(table.name);
  report.shared_runs = find_runs(tables).shared(tables);
  report.species = all.front().species;
  const auto pairs = pairs_of(s, report.species);
  const auto data = select_fit_data(all, report.quantity, s.filters, pairs);
  require_population(s, data);
  report.shares = weight_shares(data, report.flows.size());
  const Resampling resampling{static_cast<std::size_t>(s.bootstrap),
                              static_cast<unsigned long>(s.seed)};
  const Bootstrap bootstrap(data.runs, resampling.samples, resampling.seed);
  report.rules = fit_pairs(all, report.quantity, s.filters, pairs, rules, settings, resampling,
                           s.exponent || report.names_pairs());
  if (!s.scan.empty())
    report.scan = scan(info.name, data, parse_scan(s.scan), settings, bootstrap, s.quiet);
  report.with_paper = s.fit == "paper";
  report.number_of_runs = data.runs.size();
  report.number_of_windows = bootstrap.windows();

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
  if (resampling.samples > 0)
    for (auto& doubt : doubts_of_tables(tables, all, data))
      report.doubts_of_tables.push_back(std::move(doubt));
  if (const auto doubt = doubt_of_start(data, rules.front(), settings); !doubt.empty())
    report.doubts_of_tables.push_back(doubt);
  report.history = header_values(tables, "history");
  return report;
}

}  // namespace grseg
