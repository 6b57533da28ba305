// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/rule_fit.hpp"

#include <vector>

namespace grseg {

/// How samples are drawn (Bootstrap).
struct Resampling {
  std::size_t samples = 0;
  unsigned long seed = 1;
};

/// One rule for all flows together and for each of them; the latter is empty where there is one.
struct FlowFits {
  RuleFit all;
  std::vector<RuleFit> of_each;
};

/// Fits data of one pair of species, with B_yy and B_pressure. A flow's interval is over its
/// runs, of a single one over its windows, whatever the intervals of all are over.
///
/// Over equal flows each number of all is the unweighted mean of those of the flows, whose
/// errors add up (confidence.hpp); over random flows the same mean with the scatter of the
/// flows' values, n - 1 degrees of freedom for n flows. Those of B_half and B_sums stand in
/// RuleFit::at() and sums_at() always.
FlowFits fit_flows(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                   const Resampling& resampling);

}  // namespace grseg
