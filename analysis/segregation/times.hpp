// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/series.hpp"
#include "analysis/segregation/summary.hpp"

#include <vector>

namespace grseg {

/// Segregation time by its several definitions, from the first moment on, in seconds and in strain
/// (numbers named _strain):
///   y_L_start, y_L_end, tau  y_L = end - (end - start) exp(-t/tau), least squares over frames
///   t50, t90                 when y_L has gone 50 % and 90 % of the way from start to end of the
///   fit mixing_start, mixing_most, mixing_end   mixing_index, means over windows t_mixing middle
///   of the window that is mixed most; the interval holds all windows
///                            up to the last that is not told from it
/// `windows` lists how many moments each window has.
SegregationSummary segregation_times(const std::vector<SegregationSeries::Moment>& moments,
                                     const std::vector<std::size_t>& windows);

}  // namespace grseg
