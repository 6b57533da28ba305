// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/verify/check_context.hpp"
#include "formats/import/verify/check_series.hpp"

#include <vector>

namespace grseg {

/// The findings of all checks, in the order of check_names, from the frames of an import so far.
std::vector<Finding> judge(const CheckSeries& series, const CheckContext& context);

/// Findings of single checks, without waivers.
Finding judge_gravity(const CheckSeries& series, const CheckContext& context);
Finding judge_masses(const CheckSeries& series, const CheckContext& context,
                     const Finding& gravity);
Finding judge_sizes(const CheckContext& context);
Finding judge_time(const CheckSeries& series, const CheckContext& context);

/// Limits in units of the smaller radius. largest_distance: difference between the stated distance
/// and the distance of the positions (digits of the text). widest_gap: gap of grains that exert a
/// force on each other, minus the distance that they may separate in a step.
inline constexpr double largest_distance = 0.01, widest_gap = 0.05, deepest_overlap = 0.3;
/// fewest_rigid: largest fraction of the mobile grains that may seem to be parts of rigid bodies by
/// chance. rigid_bodies: measure of the check completeness above it. Otherwise this measure is the
/// overlap of unlisted pairs over the smaller radius.
inline constexpr double fewest_rigid = 0.01, rigid_bodies = 1;
/// Largest attractive fraction of the normal force; damping of separating soft grains attracts.
inline constexpr double largest_pull = 0.2;

/// Limit for frames with consecutive step numbers: displacement over (faster of two velocities
/// times the step). A larger ratio means that the frames are more than one step apart.
inline constexpr double farthest = 3;

/// Two frames without forces on grains are close together if the contact forces on a grain change
/// by less than this fraction of their size. If a force changes monotonically, its mean over the
/// time between them then differs from the mean of the two frames by at most half of the change. In
/// addition no grain may move by more than this fraction of its radius, so that no grains collide
/// in between.
inline constexpr double close_together = 0.1;

}  // namespace grseg
