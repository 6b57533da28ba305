// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/series.hpp"
#include "analysis/segregation/summary.hpp"

#include <vector>

namespace grseg {

/// Segregation time by several definitions, counted from the first moment, in seconds and in strain
/// (numbers named _strain):
///   y_L_start, y_L_end, tau  y_L = end - (end - start) exp(-t/tau), least squares over frames
///   t50, t90      when y_L has covered 50 % and 90 % of the way from start to end of the fit
///   mixing_start, mixing_most, mixing_end  mixing_index in the first window, in the one that is
///                 mixed most and in the last, means over the window's frames
///   t_mixing      middle of the window that is mixed most; the interval reaches from the first to
///                 the last window whose index does not differ significantly
/// `windows` lists the number of moments in each window.
SegregationSummary segregation_times(const std::vector<SegregationMoment>& moments,
                                     const std::vector<std::size_t>& windows);

}  // namespace grseg
