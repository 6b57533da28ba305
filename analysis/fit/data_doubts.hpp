// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Reasons why windows and runs may not be independent, a sentence each, mostly none: runs that
/// nothing tells apart, flows that share a run, windows between which nothing moves.
std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data);

/// Difference between the start of runs and their end: Geweke's comparison (1992) of the mean over
/// the first tenth of the windows with the mean over the last half, by Student's t. The last half
/// gives variance, autocorrelation time and degrees of freedom; several runs are averaged.
struct StartOfFlow {
  double excess = 0;  // mean of the first tenth less mean of the last half
  double chance = 1;  // probability of such a difference between runs that are steady
  double leave_out =
      0;  // least part of the windows, in twentieths, without which it is 2.5 % or more; 1: none
};

/// `series` has a number per window, run after run. None where the last halves are worth fewer than
/// two independent windows, or runs have fewer than ten windows.
std::optional<StartOfFlow> start_of_flow(const Eigen::VectorXd& series, const RunLengths& runs);

/// The sentence that says so of B by a rule or of how the grains move, and from when both no longer
/// differ; mostly empty. What the composition of the layers explains of B is taken out first
/// (least_squares.hpp): as the species part, B of the mixture changes, and that is no start.
std::string doubt_of_start(const FitData& data, const PartitionRule& rule,
                           const FitSettings& settings);

}  // namespace grseg
