// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/layers.hpp"
#include "formats/frame.hpp"

#include <array>
#include <optional>
#include <vector>

namespace grseg {

/// About which mean velocity fluctuations are counted. The paper does not say.
enum class MeanFlow {
  profile,  ///< a fine profile over height
  layer,  ///< the layer's mean; leaves the mean shear inside a layer in K_xx, nu rho (du/dy h)^2/12
  species,  ///< the layer's mean of each species
};

/// Down-slope velocity u and velocity v along y, m/s, and spin, rad/s.
using Motion = Eigen::Vector3d;

/// Mass-weighted mean motion of the mobile grains over the frames that were added.
///
/// The profile joins, by straight lines, one point per bin of height: mean height and mean motion
/// of the grains in it. Empty bins have no point, so that the line passes over them; beyond the
/// outer points it goes on with the slope of the outer two bins. Taking the mean height rather than
/// the middle of the bin, a linear profile comes out as it is, however the grains lie in their
/// bins.
class MeanVelocity {
 public:
  /// Bins no thicker than `bin` (m), a whole number of them per layer.
  MeanVelocity(MeanFlow flow, const Layers& layers, double bin);

  void add(const Grains& grains, const Frame& frame);
  void merge(const MeanVelocity& others);
  /// Takes the means; nothing can be added after that.
  void finish();
  /// At height y, for a grain of a species; of grains that were added only.
  Motion at(Species species, double y) const;

 private:
  struct Sum {
    double mass = 0, moment = 0;  // kg, kg m
    Motion momentum = Motion::Zero();
    Sum& operator+=(const Sum& other);
  };
  struct Point {
    double y;
    Motion motion;
  };
  Motion on_profile(double y) const;

  MeanFlow flow_;
  Layers bins_;
  std::vector<std::array<Sum, 2>> sums_;  // by bin and species; the same for both where they share
  std::vector<Point> profile_;
};

}  // namespace grseg
