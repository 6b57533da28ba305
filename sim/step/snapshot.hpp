// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/detection.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list.hpp"
#include "sim/step/world.hpp"

#include <cstdint>
#include <span>

namespace grseg {

/// A step after its contacts are solved, before the grains leave the middle of the step.
struct SolvedStep {
  const World& world;
  const GrainState& grains;
  const Pairs& pairs;
  std::span<const StripContacts> contacts;
  std::span<const std::uint32_t> body_of;  // where in `grains` each row of Grains is
  std::span<const Motion> before;          // by row, at the beginning of the step
  std::int64_t steps_done = 0;             // before this one
  double middle = 0;                       // s, time
};

/// The step as a frame of a trajectory (formats/README.md): positions and contacts at mid-step,
/// velocities at its end, forces as means over it, everything in the order of Grains.
void write_frame(const SolvedStep& step, Frame<2>& frame);

}  // namespace grseg
