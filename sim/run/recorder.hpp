// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"
#include "sim/step/simulation.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace grseg {

/// In d_S: an overlap above this, and above what the fastest approach makes in a step, means that a
/// grain passes into another one or into a wall.
constexpr double deep_overlap = 0.25;

/// Sums and extremes over the reports of steps.
struct StepTotals {
  std::int64_t steps = 0;
  std::int64_t missed = 0;  ///< steps that ended above the tolerance
  double sweeps = 0, residual_rms = 0, touching = 0, force_bearing = 0;
  double sum_overlap = 0, sum_gap_bearing = 0;
  double largest_residual = 0, largest_overlap = 0, fastest_approach = 0, farthest_approach = 0;
  std::int64_t divided = 0;          ///< steps that were taken in parts
  Vec2 base_impulse = Vec2::Zero();  ///< kg m/s

  void add(const StepReport& report);
  void add(const StepTotals& other);
  double per_step(double sum) const { return steps > 0 ? sum / static_cast<double>(steps) : 0; }
  double mean_overlap() const { return touching > 0 ? sum_overlap / touching : 0; }
  /// True where two grains, or one and a wall, overlapped by more than deep_overlap.
  bool passed_into(double small_diameter) const
  {
    return largest_overlap > std::max(deep_overlap * small_diameter, farthest_approach);
  }
  double mean_gap_bearing() const
  {
    return force_bearing > 0 ? sum_gap_bearing / force_bearing : 0;
  }
};

/// Writes frames of a simulation with their observables, keeps the totals of all steps, and stops a
/// run that is out of bounds. Observables describe the steps since the frame before; energies and
/// the momentum defect, the frame itself.
class Recorder {
 public:
  static std::vector<Observable> observables();

  /// State of the recorder between two steps.
  struct State {
    StepTotals since_frame;  ///< of the steps that no frame covers yet
    StepTotals totals;       ///< of the steps before
  };

  Recorder(TrajectoryWriter& writer, double small_diameter) : Recorder(writer, small_diameter, {})
  {
  }
  /// Continues from `state`.
  Recorder(TrajectoryWriter& writer, double small_diameter, const State& state);

  void add(const StepReport& report) { state_.since_frame.add(report); }
  /// Writes `frame`; its own step must have been added. RunError where the mean overlap since the
  /// last frame is above 1 % of d_S and above what the fastest approach makes in a step, a grain
  /// approaches its neighbour by more than half of d_S even in
  /// the smallest part of a step, or a number is not finite.
  void write(const Frame<2>& frame, const Simulation& simulation);

  const StepTotals& totals() const { return state_.totals; }
  const State& state() const { return state_; }

 private:
  void check_bounds(const Frame<2>& frame, const Simulation& simulation) const;

  TrajectoryWriter& writer_;
  double small_diameter_;
  State state_;
};

/// Largest |sum of contact forces + m g - force| of a mobile grain over the largest |contact
/// force|.
double momentum_defect(const Grains& grains, const Frame<2>& frame, const Vec2& gravity);

}  // namespace grseg
