// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/segregation_forces.hpp"

#include <string>
#include <vector>

namespace grseg {

/// What the balances of a run say in one sentence: which way each mechanism pushes the large
/// grains, in units of their weight, and how well the balances close. Only the inside of the bed
/// counts for the mechanisms: layers at least two large diameters away from the base and from the
/// surface, which lies at twice the mean height of the mass. Errors are standard errors over
/// windows, of which each counts as one independent value.
class BalanceSummary {
 public:
  /// Diameter in m.
  BalanceSummary(const Layers& layers, double large_diameter);

  void add(const MomentumBalance& window);

  /// Largest residual of a species in a layer over the largest term of its balance.
  double residual() const { return residual_; }
  /// Without a full stop; the mechanisms only where two windows or more have both species inside.
  std::string sentence() const;

 private:
  void add_residual(const SpeciesMomentum& own);
  double surface(const MomentumBalance& window) const;

  Layers layers_;
  double margin_, residual_ = 0;
  std::vector<double> push_, push_kinetic_, drag_;  // by window, over the weight
};

}  // namespace grseg
