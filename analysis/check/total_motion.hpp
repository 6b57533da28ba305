// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/worst_case.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/gravity.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace grseg {

/// The mobile grains of a frame as one body. Velocities are those after the step.
template <int D>
struct TotalMotion {
  std::int64_t step = 0;
  double time = 0;                         // s
  double mass = 0;                         // kg
  Vector<D> momentum = Vector<D>::Zero();  // kg m/s
  double energy = 0;                       // J, kinetic, of translation
  Vector<D> centre = Vector<D>::Zero();    // m, of mass, periods counted
  std::uint64_t grains = 0;                // which_are_absent()
};
template <int D>
TotalMotion<D> total_motion(const Grains& grains, const Frame<D>& frame, const Box& box);

/// The mobile grains as one body from frame to frame:
///   momentum now - momentum before = (time between) (M g + mean force of base and walls),
/// which holds to round-off where that mean (/observables/base_force_x, _y, and _z of spheres) is over all the steps
/// between; and the distance that the centre of mass moves against the integral of its velocity over
/// time (trapezium rule). Between frames of different grains neither is defined, and nothing counts.
template <int D>
class MotionBalance {
 public:
  /// Gravity and the step, s.
  MotionBalance(const Gravity<D>& gravity, double step) : gravity_(gravity), step_(step) {}

  /// Frames in order; `base_force` (N) is the mean over the steps since the frame before.
  void add(const TotalMotion<D>& now, const std::optional<Vector<D>>& base_force);

  /// |defect| over the larger of the impulses of gravity and of the base, by frame.
  const WorstCase& momentum() const { return momentum_; }

  std::size_t frames() const { return frames_; }
  /// Whether all frames had the same grains.
  bool same_grains() const { return same_grains_; }
  /// m: the distance moved along an axis less that by velocity, since the first frame.
  double stray(int axis) const
  {
    return first_ ? last_.centre[axis] - first_->centre[axis] - by_velocity_[axis] : 0;
  }

 private:
  Gravity<D> gravity_;
  double step_;
  std::size_t frames_ = 0;
  bool same_grains_ = true;
  std::optional<TotalMotion<D>> first_;
  TotalMotion<D> last_;
  Vector<D> by_velocity_ = Vector<D>::Zero();  // m
  WorstCase momentum_;
};

}  // namespace grseg
