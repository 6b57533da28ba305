// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/map_flow.hpp"
#include "analysis/frames/motion.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

namespace grseg {

/// Mean flow of the mobile grains in one layer, weighted by mass; NaN if there are none.
struct LayerFlow {
  // Velocity along and across the layer, m/s: down-slope and along y; in annuli round and outward.
  double u, v;
  double du_dy;  // slope of the least-squares line u(y), 1/s; NaN for less than two heights. In
                 // annuli it is not the shear rate: a body that rotates rigidly has du_dy = u/y
};

/// Sums from which LayerFlow follows: of m, m y, m y^2, m u, m v, m u y, with mass m and y measured
/// from the layer's bottom, so that little cancels.
struct LayerFlowSums {
  double mass = 0, my = 0, myy = 0, mu = 0, mv = 0, muy = 0;

  template <int D>
  void add(double grain_mass, double above_bottom, const Vector<D>& velocity);
  static constexpr auto members =
      std::tuple(&LayerFlowSums::mass, &LayerFlowSums::my, &LayerFlowSums::myy, &LayerFlowSums::mu,
                 &LayerFlowSums::mv, &LayerFlowSums::muy);
  /// Heights that differ by less than a millionth of `thickness` (m) count as equal.
  LayerFlow mean(double thickness) const;
};

/// Mean velocity from which fluctuations are measured. Staron & Phillips (2015) do not say which.
enum class MeanFlow {
  profile,           ///< a fine profile over height, over all frames; in a map, planes in patches
                     ///< (map_flow.hpp). Each grain loses m_i/M of its fluctuation, M being the
                     ///< mass in its bin of the profile, over all frames; in a patch about 3 m_i/M
  profile_unbiased,  ///< the profile of all other grains
  layer,    ///< the layer's mean over all frames. The mean shear in the layer adds nu rho (du/dy
            ///< h)^2/12 to K_xx
  instant,  ///< the layer's mean in each frame. K_xx includes the same shear, but no fluctuations
            ///< of the whole layer; of n equal grains, each loses 1/n of its fluctuation
  instant_unbiased,  ///< as instant, but without the loss of 1/n (kinetic_stress.hpp)
  species,           ///< the layer's mean of each species, over all frames
};
inline constexpr Choice<MeanFlow> mean_flows[] = {
    {"profile", MeanFlow::profile,
     "profile over height in the window, at the height of the grain, from bins of at most dS/2; in a "
     "map, planes through the velocities in patches of at most dS"},
    {"profile-unbiased", MeanFlow::profile_unbiased,
     "as profile, but from all other grains, and corrected for the error of their mean: for "
     "windows of few frames"},
    {"layer", MeanFlow::layer, "mean of the layer over the window"},
    {"instant", MeanFlow::instant, "mean of the layer in each frame"},
    {"instant-unbiased", MeanFlow::instant_unbiased,
     "as instant, but each grain is compared with pairs of other grains, so that it is not part of "
     "the mean"},
    {"species", MeanFlow::species, "mean of the species in the layer over the window"}};

/// Motion of grain g, with components along and across its layer.
template <int D>
Motion<D> motion_of(const Layers& layers, const Frame<D>& frame, std::size_t g)
{
  const auto& position = frame.position[g];
  return motion_of<D>(layers.turned<D>(frame.velocity[g], position),
                      layers.turned_spin<D>(frame.angular_velocity[g], position));
}

/// Mean motion at the place of a grain, found from other grains, and the covariance of this mean
/// due to their fluctuations.
template <int D>
struct MotionOfOthers {
  Motion<D> mean;
  MotionProduct<D> covariance;
};

/// Mass-weighted mean motion of the mobile grains over the frames that were added: as a profile
/// over height, by layer, and by layer and species. A map has a MapFlow in place of the profile.
///
/// The profile connects one point per bin of height by straight lines: mean height and mean motion
/// of the grains in the bin. Empty bins have no point. Beyond the outermost points the profile is
/// extrapolated linearly, with the slope over the outermost two bins. Points at the mean height,
/// not the middle of the bin, reproduce a linear profile exactly, wherever grains are in their
/// bins.
template <int D>
class MeanVelocity {
 public:
  /// The bins are no thicker than `bin` (m), with a whole number of bins per layer; the patches of a
  /// map have at most twice this side.
  MeanVelocity(const Layers& layers, double bin, std::size_t species = 2);

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const MeanVelocity& others);
  /// Computes the means; no frame can be added afterwards.
  void finish();

  /// Mean motion over a map; null for layers and annuli.
  const MapFlow<D>* over_map() const { return over_map_ ? &*over_map_ : nullptr; }
  /// Mean motion at height y; NaN without grains.
  Motion<D> on_profile(double y) const;
  /// Profile V at a grain i that was added, from all other grains: grain i is removed from its bin,
  /// and bins of fewer than three grains have no point. V = sum a_j v_j over the other grains, so
  /// its covariance is sum a_j^2 var(v_j). This is estimated by sum m^2 e (x) e/(M^2 - Q) in a bin
  /// (M = sum m; Q = sum m^2; e: deviation from the line through the bin's mean with the slope
  /// between its neighbours). If velocities are independent about one linear profile, the mean of
  /// (v_i - V) (x) (v_i - V) less the covariance is the variance of v_i, up to terms of the order
  /// (m/M)^2. Nothing if the profile has no point.
  std::optional<MotionOfOthers<D>> on_profile_of_others(double y, double mass,
                                                        const Motion<D>& motion) const;
  /// Share of a grain in the mean of its bin, by which `profile` underestimates its fluctuation.
  /// It is an upper bound, as the straight lines mix two bins.
  double own_part(double y, double mass) const { return mass / of_bin_[bins_.at(y)].motion.mass; }
  /// Mean motion of a layer, and of one species in it. The layer must contain grains.
  Motion<D> of_layer(std::size_t layer) const;
  Motion<D> of_species(std::size_t layer, Species species) const;

 private:
  struct Sum {
    double mass = 0;                         // total mass, kg
    Motion<D> momentum = Motion<D>::Zero();  // sum of m v, kg m/s, and of m times the spin
    static constexpr auto members = std::tuple(&Sum::mass, &Sum::momentum);
  };
  static Motion<D> mean(const std::vector<Sum>& of_species);
  struct BinSum {
    Sum motion;
    double moment = 0;  // sum of m y, kg m
    std::size_t grains = 0;
    // Sums of m^2, m^2 y, m^2 y^2, m^2 v, m^2 y v, m^2 v (x) v, with mass m and motion v.
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
  std::optional<MapFlow<D>> over_map_;
  std::size_t species_;
  std::vector<std::vector<Sum>> of_layer_;  // sums by layer, then by species
  // Set by finish().
  std::vector<Point> profile_;
  std::vector<std::size_t> full_;  // numbers of the bins with three grains or more
  std::vector<Motion<D>> slope_;   // slope of the profile at each of the full bins, 1/s
  std::vector<Motion<D>> mean_of_layer_;
};

}  // namespace grseg
