// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_flow.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// sum m dv (x) dv, without a factor 1/2, and the same of rotation, sum m r^2/2 dw^2 (w: spin); J.
struct Fluctuations {
  Tensor2 kinetic = Tensor2::Zero();
  double rotational = 0;

  Fluctuations& operator+=(const Fluctuations& other);
  Fluctuations operator/(double number) const;
};

/// Kinetic stress by layer and species, sigma^kappa = (1/V) sum m dv (x) dv (Staron & Phillips
/// 2015, eq. 5), dv = velocity less a mean velocity (MeanFlow). A grain counts, whole, in the layer
/// of its centre. J, not divided by V, means per frame. In annuli velocities are those along and
/// across the layer, at the grain's centre.
///
/// What the mean velocity of a layer adds to the sums about the profile is kept beside them,
/// whatever the mean: layer bias = sum about the layer's mean - sum about the
/// profile, by definition and exactly. Of a linear shear it is mass (du/dy h)^2/12 in xx, h the
/// thickness of the layer, and nothing elsewhere.
///
/// The frames of a window are read twice: first for the mean flow, then for the fluctuations.
class KineticStress {
 public:
  /// Of one species in one layer.
  struct Mean {
    double mass = 0;    // kg
    double grains = 0;  // number
    Fluctuations about_mean;
    Fluctuations layer_bias;

    /// Granular temperatures (dv_x^2, dv_y^2, r^2 dw^2/2), mass-weighted means, m^2/s^2; NaN
    /// without grains. Energies per grain and degree of freedom are half the grain's mass times
    /// that.
    Eigen::Vector3d temperature() const;
    Mean& operator+=(const Mean& other);
  };

  /// About the mean over the frames that `mean` was given, which are those to be added.
  KineticStress(const Layers& layers, MeanFlow flow, const MeanVelocity& mean);

  void add(const Grains& grains, const Frame<2>& frame);
  void merge(const KineticStress& others);

  std::size_t layers() const { return sums_.size(); }
  Mean mean(std::size_t layer, Species species) const;
  LayerFlow flow(std::size_t layer) const;
  /// Energy per large grain over energy per small grain in x, y and rotation: 1 for equipartition,
  /// the mass ratio where all fluctuate as fast. NaN unless both species are there.
  Eigen::Vector3d equipartition(std::size_t layer) const;
  /// What the mean shear alone would make of the layer bias in xx, J: mass (du/dy h)^2/12.
  double shear_bias(std::size_t layer, Species species) const;

  /// The columns of grseg-kinetic from mass_S on, and a layer's numbers under them.
  static std::vector<std::string> columns();
  std::vector<double> row(std::size_t layer) const;

 private:
  struct Sums {
    std::array<Mean, 2> species;
    LayerFlowSums flow;
    Sums& operator+=(const Sums& others);
  };
  Motion mean_at(std::size_t layer, Species species, double y, const MeanVelocity& now) const;

  Layers layers_;
  MeanFlow flow_;
  MeanVelocity mean_velocity_;
  std::size_t frames_ = 0;
  std::vector<Sums> sums_;
};

}  // namespace grseg
