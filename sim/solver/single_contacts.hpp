// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <boost/align/aligned_allocator.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// The contacts of a step in single precision: a sweep relaxes twice as many at a time and
/// transfers half as many bytes. All numbers are velocities in m/s or ratios (Increments), so that
/// the unit of mass does not matter.
template <int D>
class SingleContacts {
 public:
  /// Applies the first guesses of the impulses to `motion`, whose last entry is the immobile body,
  /// and copies contacts and velocities to single precision.
  void take(std::span<const BlockRuns<D>> strips, std::span<Motion<D>> motion, Effects effects,
            int threads);

  std::span<const RunsOf<D, float>> strips() const { return runs_; }
  std::span<MotionOf<D, float>> motion() { return motion_; }

  /// Adds the increments of a strip to the impulses in `contacts` and to the velocities. An impulse
  /// that round-off carried beyond Signorini's or Coulomb's limit is set to the limit.
  void give_back(std::size_t strip, const BlockRuns<D>& contacts, double friction, Effects effects,
                 Motion<D>* motion) const;

 private:
  struct Strip {
    std::vector<BlockOf<D, float>> blocks;  // the number in use is in `runs_`; never shrinks
    std::vector<std::uint32_t> ends;        // end of each run, as in RunsOf
  };
  static void take_strip(const BlockRuns<D>& contacts, Motion<D>* motion, std::uint32_t idle,
                         Effects effects, Strip& strip);

  std::vector<Strip> strips_;
  std::vector<RunsOf<D, float>> runs_;
  std::vector<MotionOf<D, float>, boost::alignment::aligned_allocator<MotionOf<D, float>, 64>>
      motion_;
};

}  // namespace grseg
