// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

namespace grseg {

/// Mean flow of the mobile grains in one layer, weighted by mass; NaN where there are none.
struct LayerFlow {
  double u,
      v;  // m/s, along and across the layer: down-slope and along y, in annuli round and outward
  double du_dy;  // 1/s, slope of the least-squares line u(y); NaN for less than two heights. In
                 // annuli no shear rate: a body that turns as a whole has du_dy = u/y
};

/// The sums it is made of. Heights are counted from the layer's bottom, so that little cancels.
struct LayerFlowSums {
  double mass = 0, my = 0, myy = 0, mu = 0, mv = 0, muy = 0;

  template <int D>
  void add(double grain_mass, double above_bottom, const Vector<D>& velocity);
  LayerFlowSums& operator+=(const LayerFlowSums& others);
  /// Heights that differ by less than a millionth of `thickness` (m) are the same.
  LayerFlow mean(double thickness) const;
};

}  // namespace grseg
