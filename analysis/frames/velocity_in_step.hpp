// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <string>

namespace grseg {

/// Which velocity of the step that a frame stands for. Frames hold that after the step.
enum class VelocityInStep { after, middle };
inline constexpr Choice<VelocityInStep> velocities_in_step[] = {
    {"after", VelocityInStep::after, "at the end of the step, as stored"},
    {"middle", VelocityInStep::middle,
     "half a step before: v - F h/(2 m), F the force on the grain, its weight included; of spins "
     "likewise with the torques of the contacts"}};

/// Turns the velocities and spins of the mobile grains, those after a step of `step` s, into those
/// in its middle, the means of before and after:
///   v - F h/(2 m), F = m (v_after - v_before)/h, the `force` of the frame;
///   w - T h/(2 I), T the torques of the frame's contacts, unless grains do not turn (`turning`).
/// Exact where nothing happens but gravity. Of a grain that bounces it is the mean of before and
/// after, at e = 1 no velocity at all. FormatError where the frame has no forces of grains.
template <int D>
void to_middle_of_step(const Grains& grains, double step, bool turning, Frame<D>& frame);

/// What the header of a table says of --velocity: the word, or "instant" of an imported run, whose frames
/// have one velocity. UsageError where one was chosen of such a run.
std::string velocity_line(const TrajectoryReader& run, const std::string& word, bool chosen);

/// Sums over frames with the velocities of one kind, made of those that frames hold.
template <int D, class Sums>
struct AtVelocity {
  Sums sums;
  VelocityInStep which;
  double step;  // s
  bool turning;

  void add(const Grains& grains, const Frame<D>& frame)
  {
    if (which == VelocityInStep::after) return sums.add(grains, frame);
    Frame<D> middle = frame;
    to_middle_of_step(grains, step_of_force(frame, step), turning, middle);
    sums.add(grains, middle);
  }
  void merge(const AtVelocity& others) { sums.merge(others.sums); }
};

}  // namespace grseg
