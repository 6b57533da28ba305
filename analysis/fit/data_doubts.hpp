// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_data.hpp"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Reasons why windows and runs may not be independent, one sentence each; usually an empty list.
/// Reasons are: two runs that may be the same run, flows that share a run, and windows between
/// which no grain moves.
std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data);

/// Difference between the start and the end of runs. Geweke's test (1992) compares the mean over
/// the first tenth of the windows with the mean over the last half, by Student's t. Variance,
/// autocorrelation time and degrees of freedom come from the last half; several runs are averaged.
struct StartOfFlow {
  double excess = 0;  // mean of the first tenth minus mean of the last half
  double chance = 1;  // probability of a difference at least this large if the runs are steady
  // Least fraction of first windows, in steps of 1/20, without which `chance` is 2.5 % or more; 1
  // if there is none.
  double leave_out = 0;
};

/// Geweke's test of `series`, which has one number per window, run after run. Returns nothing if
/// the last half of a run is worth fewer than two independent windows, or a run has fewer than ten.
std::optional<StartOfFlow> start_of_flow(const Eigen::VectorXd& series, const RunLengths& runs);

/// Warning that B or the stress ratio differs between the start and the end of the runs, with the
/// time after which neither does; usually empty. The part of B that the composition of the layers
/// explains is subtracted first (least_squares.hpp), because B changes as the species separate, and
/// that change is not a start.
std::string doubt_of_start(const FitData& data, const PartitionRule& rule,
                           const FitSettings& settings);

/// B over the first and over the last third of the windows of all runs.
struct ChangeOfB {
  double first = 0, last = 0;
  double chance = 1;  // probability of a difference at least this large if B does not change
};

/// Compares the two by Student's t. Variance, autocorrelation time and degrees of freedom come from
/// the windows of all runs about a straight line in each run, so that a drift does not count as
/// noise. Returns nothing if this leaves fewer than two independent windows.
std::optional<ChangeOfB> change_of_b(const WindowSums& windows, const RunLengths& runs);

/// Warning that B changes in time, as while the species separate; usually empty. Unlike
/// doubt_of_start(), the part that the composition of the layers explains counts, too.
std::string doubt_of_change(const FitData& data, const PartitionRule& rule,
                            const FitSettings& settings);

}  // namespace grseg
