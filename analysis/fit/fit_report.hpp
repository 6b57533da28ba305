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
  std::vector<std::pair<std::string, std::string>> trust;  // what was verified of the inputs
  Quantity quantity = Quantity::contact;
  Component component = Component::yy;
  SpeciesList species;         // of the tables
  std::vector<Flow> flows;     // of the tables
  std::vector<double> shares;  // of each flow in the weight of all
  std::vector<std::string> table_names;
  std::vector<std::vector<std::string>>
      shared_runs;                            // names of the tables of each run with several
  std::vector<std::string> doubts_of_tables;  // on what the tables are of
  std::vector<RuleFit> rules;
  std::optional<PartitionScan> scan;
  bool with_paper = false;  // whether what the paper fits is printed, too
  int digits = 0;           // significant ones of the short table; 0: three decimals
  std::size_t number_of_runs = 0, number_of_windows = 0;
  bool names_pairs() const { return species.size() > 2; }
  /// True where each flow has rows of its own, besides the rows of all flows.
  bool is_by_flow() const
  {
    return std::ranges::any_of(rules, [](const RuleFit& fit) { return fit.flow.has_value(); });
  }
};

/// The rule as typed; "kinetic" for kinetic stress, which no rule concerns.
std::string rule_name(const FitReport& report, const RuleFit& fit);

/// Reasons why intervals may be too narrow, mostly none: of the tables, then of each rule, then of
/// the scan.
std::vector<std::string> doubts(const FitReport& report);

/// A number of the report.
struct NumberRow {
  // "-" where it is of all rules, or has no interval; the pair "S+L", the smaller species first.
  std::string rule, flow, pair, quantity, over;
  std::optional<std::size_t> of_flow;  // that it is of
  Estimate number;
  double degrees = no_number;  // of freedom of the interval
};

/// All numbers, in the order of the table. Quantities of a rule: B over each population that is
/// known, beginning with RuleFit::over; share, neutral, B_minus_size, size_exponent; with_paper:
/// paper_s, paper_B, paper_k, paper_a; effective_windows, autocorrelation_time[windows]. Of all
/// rules ("-"): p_zero, dB_dp, and of the data Phi_L, weight_share, runs and points (layers and
/// windows).
std::vector<NumberRow> number_rows(const FitReport& report);

/// A table (table.hpp) with a row per number (number_rows); with a scan instead a row per share
/// p, with p_zero and dB_dp in the header.
std::string to_tsv(const FitReport& report);
/// All numbers and header lines as one JSON object; NaN becomes null.
std::string to_json(const FitReport& report);

/// The report for reading on a terminal: per rule B with its interval, the share of the mixed
/// contacts' stress that large grains get, and whose rule it is; then p*, the populations and the
/// doubts. Three decimals, or FitReport::digits; "-" where there is no number.
std::string short_table(const FitReport& report);

}  // namespace grseg
