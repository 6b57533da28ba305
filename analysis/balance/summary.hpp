// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/driving_forces.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Which layers of a window lie inside the bed: at least two large diameters away from the base and
/// from the surface, which lies at twice the mean height of the mass.
template <int D>
std::vector<std::size_t> layers_inside(const MomentumBalance<D>& window, const Layers& layers,
                                       double large_diameter);

/// The balances of a run in one sentence: which way each mechanism pushes the large grains, in
/// units of their weight, and how well the balances close; mixed contacts are cut at the contact
/// point. The mechanisms are taken inside the bed only (layers_inside). Errors are standard errors
/// over windows, taken as independent. With other than two species only how well they close.
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

  Layers layers_;
  double large_diameter_;
  double residual_ = 0;  // largest of a species in a layer, over the largest term of its balance
  std::vector<double> push_, push_kinetic_, drag_;  // by window, over the weight
};

}  // namespace grseg
