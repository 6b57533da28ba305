// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/worst_case.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/gravity.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Newton's and Euler's laws for every mobile grain, in the step that a frame stands for:
///   sum of its contact forces + m g = m (v_after - v_before)/h, which the file stores as `force`;
///   sum of its torques = I (w_after - w_before)/h, where two frames are consecutive steps; I is
///   m r^2/2 of a disc and 2/5 m r^2 of a sphere.
/// The force between two grains acts at r_i/(r_i + r_j) of the branch, so that the lever arms add
/// up to the distance of the centres; at a straight wall the arm is r_i. Both laws hold to
/// round-off, whatever the solver's tolerance.
template <int D>
class ForceBalance {
 public:
  /// Gravity and the step h, s.
  ForceBalance(const Gravity<D>& gravity, double step) : gravity_(gravity), step_(step) {}

  /// Frames in order. A frame without `force` counts for torques only.
  void add(const Grains& grains, const Frame<D>& frame);

  /// |defect| over the frame's largest force, weights included; by grain.
  const WorstCase& forces() const { return forces_; }
  /// |defect| over that force times the largest radius; empty where no frames are consecutive,
  /// or their steps were taken in parts.
  const WorstCase& torques() const { return torques_; }

 private:
  struct Turning {
    std::int64_t step = 0;
    double time = 0, scale = 0;               // s, N m
    std::vector<Spin<D>> inertia_times_spin;  // kg m^2/s; of mobile grains, 0 of others
    std::vector<Spin<D>> torque;              // N m; of mobile grains, 0 of others
  };
  void add_forces(const Grains& grains, const Frame<D>& frame, double scale);
  void add_torques(const Turning& before, const Turning& after);

  Gravity<D> gravity_;
  double step_;
  WorstCase forces_, torques_;
  Turning last_;  // of the last frame added; inertia_times_spin is empty before the first
};

}  // namespace grseg
