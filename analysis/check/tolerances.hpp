// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace grseg {

/// How far a run may be from the laws of mechanics. There are three kinds: tolerances of round-off,
/// of the solver, and of statistics. A statistical check fails only where the deviation is beyond
/// both the number given here and what chance explains, i.e. the quantile of Student's t at
/// `false_alarm`, over all layers together, times the standard error. It passes only where chance
/// explains no more than the number given here: else it is undecided, and a longer run decides.
struct CheckTolerances {
  double round_off = 1e-10, single_precision = 1e-5;     // relative
  double mean_overlap = 5e-3, largest_overlap = 0.1;     // d_S
  double mean_approach = 1e-3, largest_approach = 0.05;  // d_S per step
  double false_alarm = 1e-3;
  double weight = 0.01, slope = 0.005;
  double overlap_drift = 1e-3;  // d_S over the run
  double x_drift = 1e-3;        // sqrt(g d_S)
  double least_load = 0.02;     // of the load of the first layer; layers with less are left out

  /// A tolerance as an option of the command line and a line of the table's header.
  struct Option {
    const char* name;
    double CheckTolerances::*value;
    const char* meaning;
  };
  static const std::array<Option, 12>& options();
  /// The name of the option of a tolerance.
  static const char* option_of(double CheckTolerances::*value);

  /// UsageError, naming the option, where a value makes no sense.
  void require_valid() const;
};

}  // namespace grseg
