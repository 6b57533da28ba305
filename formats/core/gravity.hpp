// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstdint>

namespace grseg {

/// Gravity of a run on a slope that is fixed or becomes steeper at a constant rate from t = 0 on. A
/// step is subject to gravity at its middle, which is the time of a frame. The slope turns about z.
template <int D>
struct Gravity {
  Vector<D> start = Vector<D>::Zero();  ///< m/s^2, at t = 0
  double slope_rate = 0;                ///< rad/s

  Gravity() = default;
  // Implicit: without a changing slope gravity is just a vector.
  Gravity(const Vector<D>& constant) : start(constant) {}
  Gravity(const Vector<D>& at_first, double rate) : start(at_first), slope_rate(rate) {}

  bool turns() const { return slope_rate != 0; }
  double norm() const { return start.norm(); }  // m/s^2, at any time
  /// m/s^2, at `time` in s.
  Vector<D> at(double time) const;
  /// The mean over `steps` >= 1 steps of length `step` (s), the last of which has its middle at
  /// `last` (s), all after t = 0.
  Vector<D> mean(double last, std::int64_t steps, double step) const;
};

}  // namespace grseg
