// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace grseg {

/// The terms of the momentum balance of each layer in one window, all as a stress in N/m (per
/// V = Lx h) or Pa (Lx Lz h), components along x and y (and z).
///
/// Let l_i be the length of the layer's thickness that lies below the centre of grain i. Then, in a
/// cell that is periodic along x (and z), in each layer and for any motion,
///   V (sigma + sigma^kappa)_.y = d/dt sum m v l - sum m g l,
/// exactly if contacts are shared among layers along their branch and the time mean is over all
/// steps; frames are a sample of them, for which it holds up to their scatter. Without acceleration
/// this means that sigma_yy carries the weight above and that -sigma_xy/sigma_yy is the tangent of
/// the slope.
template <int D>
struct WeightWindow {
  double time = 0;                  // s, of the first frame
  std::vector<Vector<D>> stress;    // contact and kinetic, (xy, yy, zy)
  std::vector<Vector<D>> weight;    // -sum m g l / V
  std::vector<Vector<D>> momentum;  // N s/m, sum m v l / V at the first frame
};

/// The sums over a window. As for KineticStress, all of its frames are added twice.
template <int D>
class WeightSums {
 public:
  /// Gravity, m/s^2; bins of the mean velocity's profile no thicker than `bin`, m.
  WeightSums(const Layers& layers, const Vector<D>& gravity, double bin, std::size_t species = 2);

  void add_to_mean(const Grains& grains, const Frame<D>& frame);
  void add(const Grains& grains, const Frame<D>& frame);
  WeightWindow<D> window() const;

 private:
  Tensor<D> whole_stress(std::size_t layer) const;

  Layers layers_;
  Vector<D> gravity_;
  std::size_t species_;
  MeanVelocity<D> mean_;
  std::optional<KineticStress<D>> kinetic_;  // once the mean is known
  PartialContactStress<D> contact_;
  std::size_t frames_ = 0;
  double time_ = 0;                  // s, of the first frame
  std::vector<double> mass_above_;   // kg m, sum m l over frames
  std::vector<Vector<D>> momentum_;  // kg m^2/s, sum m v l of the first frame
};

/// How well a layer carries the weight above it, over all windows but the last, which only ends the
/// one before it. Errors are standard errors over windows.
struct LayerBalance {
  double y0 = 0, y1 = 0;  // m
  double carried = 0;     // (sigma + sigma^kappa)_yy over what the balance requires
  double carried_error = 0;
  /// Along x and, of spheres, along z.
  struct StressRatio {
    double ratio = 0;  // -(sigma_xy + sigma^kappa_xy)/(sigma_yy + sigma^kappa_yy)
    double slope = 0;  // what the balance requires: (g_x - a_x)/(a_y - g_y), a of the mass above
    double error = 0;  // of ratio - slope
  } along, across;
};

/// The layers above the first (which depends on the shape of the base) that carry at least
/// `least_load` of the load of the first. Empty for less than three windows.
template <int D>
std::vector<LayerBalance> balance_layers(const std::vector<WeightWindow<D>>& windows,
                                         const Layers& layers, double least_load);

}  // namespace grseg
