// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/mixtures.hpp"
#include "analysis/fit/partition_scan.hpp"
#include "analysis/fit/rule_fit.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// What grseg-fit prints. Rows name their pair of species where there are more than two, and the
/// exponent of sizes where it was fitted.
struct FitReport {
  std::vector<std::pair<std::string, std::string>> header;  // settings, as "# key: value"
  std::vector<std::string> inputs, history;
  std::vector<std::pair<std::string, std::string>> trust;  // what of the inputs was verified
  Quantity quantity = Quantity::contact;
  Component component = Component::yy;
  SpeciesList species;            // of the tables
  std::vector<Mixture> mixtures;  // of the tables
  WeightShares shares;            // of each mixture in the weight of all
  std::vector<std::string> table_names;
  std::vector<std::vector<std::string>>
      shared_runs;                            // names of the tables of each run with several
  std::vector<std::string> doubts_of_tables;  // on what the tables are of
  std::vector<RuleFit> rules;
  std::optional<PartitionScan> scan;
  // For the short table only: how much data there is, and p* of contact stress.
  bool names_pairs() const { return species.size() > 2; }
  bool has_exponent() const
  {
    return std::any_of(rules.begin(), rules.end(),
                       [](const RuleFit& fit) { return fit.size_exponent.has_value(); });
  }
  /// Whether rows are of one mixture each, beside those of all.
  bool is_by_mixture() const
  {
    return std::any_of(rules.begin(), rules.end(),
                       [](const RuleFit& fit) { return fit.mixture.has_value(); });
  }
  std::size_t number_of_runs = 0, number_of_windows = 0;
  std::optional<ZeroOfB> zero;
};

/// The rule as typed; "kinetic" for kinetic stress, which no rule concerns.
std::string rule_name(const FitReport& report, const RuleFit& fit);
/// The same, with the pair of species where there are more than two, and the mixture where there
/// are several.
std::string row_name(const FitReport& report, const RuleFit& fit);
/// The codes that share mixed contacts so; "-" where none is known.
std::string used_by(const FitReport& report, const RuleFit& fit);

/// The name of the mixture that a row is of; "all" of all of them.
std::string mixture_name(const FitReport& report, const RuleFit& fit);

/// "1.7 % of the weight of B_half, 3.1 % of that of B_sums".
std::string share_words(const FitReport& report, std::size_t mixture);

/// What each kind of interval in the report is over, in words.
std::vector<std::pair<Over, std::string>> estimands(const FitReport& report);

/// Reasons why intervals may be too narrow, mostly none: those of the tables, one for each rule, one for
/// the scan.
/// Both forms below contain them.
std::vector<std::string> doubts(const FitReport& report);

/// A table (table_text.hpp) with a row per rule, whose name stands first; with a scan instead a row
/// per share p, with p_zero and dB_dp in the header.
std::string to_tsv(const FitReport& report);
/// The same as one JSON object; what is not a number is null.
std::string to_json(const FitReport& report);

}  // namespace grseg
