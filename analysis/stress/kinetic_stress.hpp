// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/cells.hpp"
#include "analysis/frames/layer_flow.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// sum m dv (x) dv, without a factor 1/2, and the same of rotation, sum k m r^2 dw^2 (w: spin; k =
/// 1/2 of discs and 2/5 of spheres); J.
template <int D>
struct Fluctuations {
  Tensor<D> kinetic = Tensor<D>::Zero();
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
/// thickness of the layer, and nothing elsewhere. A map has neither profile nor bias.
///
/// About MeanFlow::instant_unbiased a grain needs two others in its layer or cell and frame. Where
/// there are fewer it counts in the mean flow but not in the sums, its mass and its number included,
/// so that temperatures and ratios are those of the grains that count; `left_out` has the others. The
/// same holds of MeanFlow::profile_unbiased where no bin of the profile has two others.
///
/// The frames of a window are read twice: first for the mean flow, then for the fluctuations.
template <int D>
class KineticStress {
 public:
  using Temperatures = Vector<D + 1>;
  /// Of one species in one layer.
  struct Mean {
    double mass = 0;      // kg
    double content = 0;   // m^2 or m^3, area or volume
    double grains = 0;    // number
    double left_out = 0;  // number: those that are too few for the mean; not among `grains`
    double own_part = 0;  // kg: mass times MeanVelocity::own_part(); about MeanFlow::profile only
    Fluctuations<D> about_mean;
    Fluctuations<D> layer_bias;

    /// Granular temperatures (dv_x^2, dv_y^2, dv_z^2 in three dimensions, k r^2 dw^2), mass-weighted
    /// means, m^2/s^2; NaN without grains. Energies per grain and degree of freedom are half the
    /// grain's mass times that; the spin of a sphere has three.
    Temperatures temperature() const;
    Mean& operator+=(const Mean& other);
  };

  /// About the mean over the frames that `mean` was given, which are those to be added.
  KineticStress(const Layers& layers, MeanFlow flow, const MeanVelocity<D>& mean,
                std::size_t species = 2);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const KineticStress& others);

  std::size_t layers() const { return sums_.size(); }
  Mean mean(std::size_t layer, Species species) const;
  /// Mass-weighted mean velocity of a layer, m/s; NaN without grains.
  Vector<D> velocity(std::size_t layer) const
  {
    return mean_velocity_.of_layer(layer).template head<D>();
  }
  LayerFlow flow(std::size_t layer) const;
  /// Of two species: energy per large grain over energy per small grain in x, y, z and rotation: 1
  /// for equipartition, the mass ratio where all fluctuate as fast. NaN unless both are there.
  Temperatures equipartition(std::size_t layer) const;
  /// What the mean shear alone would make of the layer bias in xx, J: mass (du/dy h)^2/12.
  double shear_bias(std::size_t layer, Species species) const;

  /// The columns of grseg-kinetic from mass_S on with a layer's numbers, NaN without a layer.
  std::vector<Cell> cells(const SpeciesList& species, std::optional<std::size_t> layer) const;

 private:
  struct Sums {
    std::vector<Mean> species;
    LayerFlowSums flow;
    Sums& operator+=(const Sums& others);
  };
  Motion<D> mean_in(std::size_t layer, Species species, const MeanVelocity<D>& now) const;

  Layers layers_;
  MeanFlow flow_;
  MeanVelocity<D> mean_velocity_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::vector<Sums> sums_;
};

}  // namespace grseg
