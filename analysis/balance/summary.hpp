// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/driving_forces.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The balances of a run in one sentence: which way each mechanism pushes the large grains, in
/// units of their weight, and how well the balances close. The mechanisms are taken inside the bed
/// only, from layers at least two large diameters away from the base and from the surface, which
/// lies at twice the mean height of the mass. Errors are standard errors over windows, taken as
/// independent. With other than two species only how well they close.
template <int D>
class BalanceSummary {
 public:
  /// Diameter in m.
  BalanceSummary(const Layers& layers, double large_diameter);

  void add(const MomentumBalance<D>& window);

  /// Without a full stop. Mechanisms are left out unless two windows or more hold both species
  /// inside.
  std::string sentence() const;

 private:
  void add_residual(const SpeciesMomentum<D>& own);
  double surface(const MomentumBalance<D>& window) const;

  Layers layers_;
  double margin_;
  double residual_ = 0;  // largest of a species in a layer, over the largest term of its balance
  std::vector<double> push_, push_kinetic_, drag_;  // by window, over the weight
};

}  // namespace grseg
