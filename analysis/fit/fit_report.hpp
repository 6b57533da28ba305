// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/flows.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/frames/sums.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// All that grseg-fit prints.
struct FitReport {
  std::vector<std::pair<std::string, std::string>> header;  // settings, as "# key: value"
  std::vector<std::string> inputs, history;
  std::vector<std::pair<std::string, std::string>> trust;  // header lines on verified inputs
  Quantity quantity = Quantity::contact;
  Component component = Component::yy;
  SpeciesList species;         // species of the tables
  std::vector<Flow> flows;     // flows of the tables
  std::vector<double> shares;  // share of each flow in the weight of all samples in B
  std::vector<std::string> table_names, other_names;  // other: of the tables of --minus
  std::vector<std::vector<std::string>>
      shared_runs;                            // for each run with several tables, their names
  std::vector<std::string> doubts_of_tables;  // warnings about the tables (data_doubts.hpp)
  std::vector<std::string> verdict;  // how the grains move in these times (flow_verdict.hpp)
  bool changes = false;              // FlowVerdict::changes
  std::vector<RuleFit> rules;
  std::optional<PartitionScan> scan;
  std::vector<std::vector<Cell>> series;  // rows of --series (time_series.hpp); empty without it
  bool with_paper = false;  // true: also print the fits of Staron & Phillips (estimators.hpp)
  int digits = 0;           // significant digits of the short table; 0: three decimals
  std::size_t number_of_runs = 0, number_of_windows = 0;
  bool names_pairs() const { return species.size() > 2; }
  /// True if each flow has its own rows, besides the rows of all flows together.
  bool is_by_flow() const
  {
    return std::ranges::any_of(rules, [](const RuleFit& fit) { return fit.flow.has_value(); });
  }
};

/// The rule as typed; "kinetic" for kinetic stress, which is the same under every rule.
std::string rule_name(const FitReport& report, const RuleFit& fit);

/// Reasons why intervals may be too narrow, usually none: first reasons in the tables, then in the
/// fit of each rule, then in the scan.
std::vector<std::string> doubts(const FitReport& report);

/// Populations of the intervals in the report, each with the sentence on what B is over; if not
/// `all`, only of the first interval of each rule.
std::vector<std::pair<Population, std::string>> estimands(const FitReport& report, bool all = true);

/// A number of the report.
struct NumberRow {
  // Words of the row. `rule` is "-" for a number common to all rules, `over` is "-" for a number
  // without interval, `pair` is "S+L", the smaller species first.
  std::string rule, flow, pair, quantity, over;
  std::optional<std::size_t> of_flow;  // index of the flow; none: all flows
  Estimate number;
  double degrees = no_number;  // degrees of freedom of the interval
};

/// All numbers, in the order of the table: of each rule B over every known population, beginning with
/// RuleFit::over, and what else depends on the rule; then quantities common to all rules ("-").
/// formats/cli/columns.tsv defines them.
std::vector<NumberRow> number_rows(const FitReport& report);

/// A table (table.hpp) with one row per number (number_rows). A scan has one row per share p
/// instead, and p_zero and dB_dp in the header.
std::string to_tsv(const FitReport& report);
/// All numbers and header lines as one JSON object; NaN becomes null.
std::string to_json(const FitReport& report);

/// The report for a terminal. Each rule has B with its interval, the share of the mixed contacts'
/// stress that large grains get, and the programs that use the rule. Then follow p*, the
/// populations (the grains or times that each interval speaks for) and the doubts. Numbers have
/// three decimals, or FitReport::digits significant digits; "-" replaces a missing number.
std::string short_table(const FitReport& report);

}  // namespace grseg
