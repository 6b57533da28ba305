// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <boost/align/aligned_allocator.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// The contacts of a step in single precision: sweeps relax twice as many at a time, and memory has
/// half as much to carry. All numbers are velocities in m/s or ratios (ContactOf<float>), whatever
/// the unit of mass.
class SingleContacts {
 public:
  /// Applies the first guesses of the impulses to `motion`, whose last entry is the body that never
  /// moves, and takes over contacts and velocities.
  void take(std::span<const BlockRuns> strips, std::span<Motion> motion, Effects effects,
            int threads);

  std::span<const RunsOf<float>> strips() const { return runs_; }
  std::span<MotionOf<float>> motion() { return motion_; }

  /// Adds a strip's increments to the impulses that they were taken from, and to the velocities. An
  /// impulse that rounding took beyond Signorini's or Coulomb's limit is set to it.
  void give_back(std::size_t strip, const BlockRuns& contacts, double friction, Effects effects,
                 Motion* motion) const;

 private:
  struct Strip {
    std::vector<BlockOf<float>> blocks;  // `runs_` says how many are in use; never shrinks
    std::vector<std::uint32_t> ends;     // as in RunsOf
  };
  static void take_strip(const BlockRuns& contacts, Motion* motion, std::uint32_t idle,
                         Effects effects, Strip& strip);

  std::vector<Strip> strips_;
  std::vector<RunsOf<float>> runs_;
  std::vector<MotionOf<float>, boost::alignment::aligned_allocator<MotionOf<float>, 64>> motion_;
};

}  // namespace grseg
