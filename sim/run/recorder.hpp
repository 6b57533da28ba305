// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"
#include "sim/step/simulation.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace grseg {

/// Overlap, in d_S, above which a grain counts as passing into another one or into a wall, if the
/// fastest approach in one step does not explain the overlap.
constexpr double deep_overlap = 0.25;

/// Sums and maxima over the reports (StepReport) of several steps.
struct StepTotals {
  std::int64_t steps = 0;
  std::int64_t missed = 0;  ///< steps whose residual exceeded the tolerance
  double sweeps = 0, residual_rms = 0, touching = 0, force_bearing = 0;
  double sum_overlap = 0, sum_gap_bearing = 0;
  double largest_residual = 0, largest_overlap = 0, fastest_approach = 0, farthest_approach = 0;
  std::int64_t divided = 0;          ///< steps that were divided into parts
  std::int64_t solved_again = 0;     ///< steps whose first solution created energy
  Vec3 base_impulse = Vec3::Zero();  ///< kg m/s, on mobile grains
  /// kg m/s, sum of the largest impulse of each step that met the tolerance.
  double largest_impulses = 0;
  // In steps that missed the tolerance:
  double missed_impulse = 0;  ///< kg m/s, largest impulse
  double missed_gain = 0;     ///< J, most energy that contacts added (StepReport::energy_gain)
  double missed_overlap = 0;  ///< m, largest overlap in the step after
  bool last_missed = false;   ///< the last step missed the tolerance

  void add(const StepReport& report);
  void add(const StepTotals& other);
  double per_step(double sum) const { return steps > 0 ? sum / static_cast<double>(steps) : 0; }
  double mean_overlap() const { return touching > 0 ? sum_overlap / touching : 0; }
  /// True if a grain overlapped another one or a wall too much, see deep_overlap.
  bool passed_into(double small_diameter) const
  {
    return largest_overlap > std::max(deep_overlap * small_diameter, farthest_approach);
  }
  double mean_gap_bearing() const
  {
    return force_bearing > 0 ? sum_gap_bearing / force_bearing : 0;
  }
};

/// Writes frames of a simulation with their observables, sums up the reports of all steps, and
/// stops a run with invalid results. Energies and the momentum defect describe the frame itself,
/// other observables the steps since the previous frame.
class Recorder {
 public:
  static std::vector<Observable> observables(int dimension);

  /// State of the recorder between two steps.
  struct State {
    StepTotals since_frame;  ///< totals of the steps after the last frame
    StepTotals totals;       ///< totals of the steps up to the last frame
  };

  Recorder(TrajectoryWriter& writer, double small_diameter) : Recorder(writer, small_diameter, {})
  {
  }
  /// Continues from `state`.
  Recorder(TrajectoryWriter& writer, double small_diameter, const State& state);

  void add(const StepReport& report) { state_.since_frame.add(report); }
  /// Writes `frame`; the report of its step must have been added. Throws RunError if
  /// - a number is not finite;
  /// - grains are so fast that the shortest part of a step lets them approach by more than half the
  ///   smallest diameter;
  /// - the mean overlap since the last frame exceeds both 1 % of d_S and the fastest approach in
  ///   one step.
  template <int D>
  void write(const Frame<D>& frame, const Simulation<D>& simulation);

  const StepTotals& totals() const { return state_.totals; }
  const State& state() const { return state_; }

 private:
  template <int D>
  void check_bounds(const Frame<D>& frame, const Simulation<D>& simulation) const;

  TrajectoryWriter& writer_;
  double small_diameter_;
  State state_;
};

/// Largest |sum of contact forces + m g - force| of a mobile grain over the largest contact force.
template <int D>
double momentum_defect(const Grains& grains, const Frame<D>& frame, const Vector<D>& gravity);

}  // namespace grseg
