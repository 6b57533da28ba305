// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/verify/check_context.hpp"
#include "formats/import/verify/check_series.hpp"

#include <vector>

namespace grseg {

/// The findings of all checks, one each in the order of check_names, from the moments of an import
/// so far. Depends on nothing else: parts of an import that are put together reach the same findings
/// as the whole.
std::vector<Finding> judge(const CheckSeries& series, const CheckContext& context);

/// Single checks, before waivers.
Finding judge_gravity(const CheckSeries& series, const CheckContext& context);
Finding judge_masses(const CheckSeries& series, const CheckContext& context,
                     const Finding& gravity);
Finding judge_sizes(const CheckContext& context);
Finding judge_time(const CheckSeries& series, const CheckContext& context);

/// Limits in units of the smaller radius: the difference between a distance and the sum of radii
/// and overlap (digits of the text), the gap of grains that bear a force, beyond the way that they
/// may part in a step, and the overlap.
inline constexpr double largest_distance = 0.01, widest_gap = 0.05, deepest_overlap = 0.3;
/// Part of the mobile grains that may seem to belong to rigid bodies, by chance; and what the
/// measure of completeness then is. Otherwise it is the overlap of pairs that are not listed, over
/// the smaller radius.
inline constexpr double fewest_rigid = 0.01, rigid_bodies = 1;
/// Fraction of the normal force that may pull: damping of soft grains that separate.
inline constexpr double largest_pull = 0.2;

/// Grains that have moved farther than this many times their way at the faster of two velocities
/// were not seen one step apart.
inline constexpr double farthest = 3;

/// Without forces on grains, two moments are close together where the contact forces on a grain
/// have changed by less than this fraction of their size. The mean over the time between them then
/// differs by at most half of the change from the mean of the two moments, as long as they change
/// one way. No grain can have met another in between where none can have moved by more than this
/// fraction of its radius.
inline constexpr double close_together = 0.1;

}  // namespace grseg
