// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

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
  static constexpr auto members =
      std::tuple(&LayerFlowSums::mass, &LayerFlowSums::my, &LayerFlowSums::myy, &LayerFlowSums::mu,
                 &LayerFlowSums::mv, &LayerFlowSums::muy);
  /// Heights that differ by less than a millionth of `thickness` (m) are the same.
  LayerFlow mean(double thickness) const;
};

/// About which mean velocity fluctuations are counted. The paper does not say.
enum class MeanFlow {
  profile,  ///< a fine profile over height, over all frames; takes away m_i/M of each grain's
            ///< fluctuations, M being the mass that a bin of the profile holds over all frames
  profile_unbiased,  ///< this profile without the grain itself
  layer,    ///< the layer's mean over all frames; leaves the mean shear inside the layer in K_xx,
            ///< nu rho (du/dy h)^2/12
  instant,  ///< the layer's mean in each frame; leaves the same shear, takes away what the whole
            ///< layer does together and, of n equal grains, 1/n of the fluctuations
  instant_unbiased,  ///< as instant, without the loss of 1/n: kinetic_stress.hpp
  species,           ///< the layer's mean of each species over all frames
};
inline constexpr Choice<MeanFlow> mean_flows[] = {
    {"profile", MeanFlow::profile,
     "over the window, at the grain's own height, from bins of at most dS/2"},
    {"profile-unbiased", MeanFlow::profile_unbiased,
     "as profile, but from all other grains, and corrected for their scatter: for windows of few "
     "frames"},
    {"layer", MeanFlow::layer, "of the layer, over the window"},
    {"instant", MeanFlow::instant, "of the layer, in each frame"},
    {"instant-unbiased", MeanFlow::instant_unbiased,
     "as instant, but with each grain compared with pairs of others, so that it is not in its own "
     "mean"},
    {"species", MeanFlow::species, "of the species in the layer, over the window"}};

/// Components of a velocity, m/s, then of a spin, rad/s: 3 or 6 numbers.
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
/// Motion of grain g, with components along and across its layer.
template <int D>
Motion<D> motion_of(const Layers& layers, const Frame<D>& frame, std::size_t g)
{
  const auto& position = frame.position[g];
  return motion_of<D>(layers.turned<D>(frame.velocity[g], position),
                      layers.turned_spin<D>(frame.angular_velocity[g], position));
}

/// A product of two motions: of the velocities, m^2/s^2, and of the spins, summed over their
/// components, 1/s^2.
template <int D>
struct MotionProduct {
  Tensor<D> velocities = Tensor<D>::Zero();
  double spins = 0;

  static constexpr auto members = std::tuple(&MotionProduct::velocities, &MotionProduct::spins);
};
/// The symmetric part of a (x) b, times a weight.
template <int D>
MotionProduct<D> symmetric_product(double weight, const Motion<D>& a, const Motion<D>& b);

/// The mean motion at the place of a grain by others, and the covariance that their fluctuations
/// give it.
template <int D>
struct MotionOfOthers {
  Motion<D> mean;
  MotionProduct<D> covariance;
};

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
  /// The profile at a grain that was added, from the others: its bin is left without it, and bins
  /// with fewer than two others have no point. With a share a_j of V for each other grain, its
  /// covariance is sum a_j^2 var(v_j), which the scatter within a bin, sum m^2 e (x) e/(M^2 - Q),
  /// estimates (Q = sum m^2; e: from the line through the bin's mean with the slope between its
  /// neighbours). Where velocities are independent about one linear profile, (v_i - V) (x) (v_i -
  /// V) less the covariance then has the variance of v_i, but for terms of the order (m/M)^2.
  /// Nothing where there is no such point.
  std::optional<MotionOfOthers<D>> on_profile_of_others(double y, double mass,
                                                        const Motion<D>& motion) const;
  /// The part of a grain in the mean of its bin, by which the profile makes its fluctuations too
  /// small: an upper bound, as straight lines mix two points.
  double own_part(double y, double mass) const { return mass / of_bin_[bins_.at(y)].motion.mass; }
  /// Mean motion of a layer, and of one species in it. The layer must hold grains that were added.
  Motion<D> of_layer(std::size_t layer) const;
  Motion<D> of_species(std::size_t layer, Species species) const;

 private:
  struct Sum {
    double mass = 0;  // kg
    Motion<D> momentum = Motion<D>::Zero();
    static constexpr auto members = std::tuple(&Sum::mass, &Sum::momentum);
  };
  static Motion<D> mean(const std::vector<Sum>& of_species);
  struct BinSum {
    Sum motion;
    double moment = 0;  // kg m
    std::size_t grains = 0;
    // sum m^2, m^2 y, m^2 y^2, m^2 v, m^2 y v, m^2 v (x) v
    double squares = 0, squares_y = 0, squares_yy = 0;
    Motion<D> weighted = Motion<D>::Zero(), weighted_y = Motion<D>::Zero();
    MotionProduct<D> product;
    static constexpr auto members = std::tuple(
        &BinSum::motion, &BinSum::moment, &BinSum::grains, &BinSum::squares, &BinSum::squares_y,
        &BinSum::squares_yy, &BinSum::weighted, &BinSum::weighted_y, &BinSum::product);
    BinSum& add(double sign, double y, double mass, const Motion<D>& motion);
    double height() const { return moment / motion.mass; }
    Motion<D> velocity() const { return motion.momentum / motion.mass; }
    MotionOfOthers<D> mean(const Motion<D>& slope) const;
  };
  Motion<D> slope_at(std::size_t k) const;
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
  std::vector<std::size_t> full_;  // bins of three grains or more
  std::vector<Motion<D>> slope_;   // of the profile through them, at each
  std::vector<Motion<D>> mean_of_layer_;
};

}  // namespace grseg
