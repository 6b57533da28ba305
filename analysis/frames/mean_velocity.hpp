// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <vector>

namespace grseg {

/// About which mean velocity fluctuations are counted. The paper does not say.
enum class MeanFlow {
  profile,  ///< a fine profile over height, over all frames
  layer,    ///< the layer's mean over all frames; leaves the mean shear inside the layer in K_xx,
            ///< nu rho (du/dy h)^2/12
  instant,  ///< the layer's mean in each frame; leaves the same shear, takes away what the whole
            ///< layer does together and, of n equal grains, 1/n of the fluctuations
  instant_unbiased,  ///< the same without that 1/n: unbiased_fluctuations.hpp
  species,           ///< the layer's mean of each species over all frames
};
inline constexpr Choice<MeanFlow> mean_flows[] = {
    {"profile", MeanFlow::profile,
     "over the window, in bins of at most half a dS, at the grain's own height"},
    {"layer", MeanFlow::layer, "over the window"},
    {"instant", MeanFlow::instant, "of the layer in each frame"},
    {"instant-unbiased", MeanFlow::instant_unbiased,
     "the same, with each grain compared with two others at a time, so that it is not in the mean "
     "from which it is counted"},
    {"species", MeanFlow::species, "of the species in the layer, over the window"}};

/// Components of a velocity, m/s, then those of a spin, rad/s: 3 or 6.
template <int D>
using Motion = Vector<D == 2 ? 3 : 6>;
template <int D>
Motion<D> motion_of(const Vector<D>& velocity, const Spin<D>& spin)
{
  if constexpr (D == 2) return {velocity.x(), velocity.y(), spin};
  Motion<D> motion;
  motion << velocity, spin;
  return motion;
}
/// Of grain g, with components along and across its layer.
template <int D>
Motion<D> motion_of(const Layers& layers, const Frame<D>& frame, std::size_t g)
{
  const auto& position = frame.position[g];
  return motion_of<D>(layers.turned<D>(frame.velocity[g], position),
                      layers.turned_spin<D>(frame.angular_velocity[g], position));
}

/// Mass-weighted mean motion of the mobile grains over the frames that were added: as a profile
/// over height (not of a map), by layer, and by layer and species.
///
/// The profile joins, by straight lines, one point per bin of height: mean height and mean motion
/// of the grains in it. Empty bins have no point, so that the line passes over them; beyond the
/// outer points it goes on with the slope of the outer two bins. Taking the mean height rather than
/// the middle of the bin, a linear profile comes out as it is, however the grains lie in their
/// bins.
template <int D>
class MeanVelocity {
 public:
  /// Bins no thicker than `bin` (m), a whole number of them per layer.
  MeanVelocity(const Layers& layers, double bin, std::size_t species = 2);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const MeanVelocity& others);
  /// Takes the means; nothing can be added after that.
  void finish();

  /// At height y; NaN without grains.
  Motion<D> on_profile(double y) const;
  /// Of a layer, and of one species in it; of layers with grains that were added only.
  Motion<D> of_layer(std::size_t layer) const;
  Motion<D> of_species(std::size_t layer, Species species) const;

 private:
  struct Sum {
    double mass = 0;  // kg
    Motion<D> momentum = Motion<D>::Zero();
    Sum& operator+=(const Sum& other);
  };
  static Motion<D> mean(const std::vector<Sum>& of_species);
  struct BinSum {
    Sum motion;
    double moment = 0;  // kg m
    BinSum& operator+=(const BinSum& other);
  };
  struct Point {
    double y;
    Motion<D> motion;
  };

  Layers layers_, bins_;
  std::vector<BinSum> of_bin_;
  std::size_t species_;
  std::vector<std::vector<Sum>> of_layer_;  // by species
  // Once they are taken.
  std::vector<Point> profile_;
  std::vector<Motion<D>> mean_of_layer_;
};

}  // namespace grseg
