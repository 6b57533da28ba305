// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/statistics/confidence.hpp"

namespace grseg {

/// B over the share p that the large grain gets of every mixed contact. Of two species it is a straight
/// line, B = dB_dp (p - p_zero), since sigma^L is linear in p and B in sigma^L. Where contacts are
/// counted at the grains' centres (--assign grain) the whole stress of a layer depends on p, too, and
/// the line is the tangent where B = 0.
struct LineOverShare {
  Measured p_zero;  // p*, where B = 0
  Measured dB_dp;
};

/// The line of contact stress and two species, NaN of others; errors are over `over`, with windows as
/// dependent as they are at p*.
LineOverShare line_over_share(const FitData& data, const FitSettings& settings,
                              const Bootstrap& bootstrap, Population over);

/// The part of what B gains from p = 0 to 1 that it gains from p = 0 to `points`, those of some rule:
/// the share of all mixed contacts that gives the same B.
double share_of_large(const FitData& data, const std::vector<FitPoint>& points,
                      const FitSettings& settings);

}  // namespace grseg
