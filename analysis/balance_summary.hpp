// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation_forces.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// What the balances of a run say in one sentence: which way each mechanism pushes the large grains
/// of the whole bed, in units of their weight, and how well the balances close. Errors are standard
/// errors over windows, each of which counts as one independent value.
class BalanceSummary {
 public:
  /// Gravity along y, m/s^2.
  explicit BalanceSummary(double gravity) : gravity_(gravity) {}

  /// Layers of one window are added one by one, after next_window().
  void next_window() { windows_.push_back({}); }
  void add(const SpeciesMomentum& small, const SpeciesMomentum& large);

  /// Largest residual of a layer over the largest of its own terms.
  double residual() const { return residual_; }
  /// Without a full stop.
  std::string sentence() const;

 private:
  static constexpr std::size_t mechanisms = 3;  // push, push_kinetic, drag
  struct Window {
    std::array<double, mechanisms> force{};
    double weight = 0, drift = 0;
  };

  double gravity_, residual_ = 0;
  std::vector<Window> windows_;
};

}  // namespace grseg
