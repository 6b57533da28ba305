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

/// Terms of the momentum balance of each layer in one window, as stresses in N/m (V = Lx h) or Pa
/// (V = Lx Lz h), with components along x, y (and z).
///
/// Let l_i be the part of the layer's thickness that is below the centre of grain i. In a cell that
/// is periodic along x (and z), each layer then satisfies, for any motion,
///   V (sigma + sigma^kappa)_.y = d/dt sum m v l - sum m g l.
/// This is exact if contacts are shared among layers along their branch and the time mean is over
/// all steps. Frames are a sample of the steps, so for them it holds up to statistical scatter.
/// Without acceleration, sigma_yy is the weight above, and -sigma_xy/sigma_yy the tangent of the
/// slope.
template <int D>
struct WeightWindow {
  double time = 0;                  // time of the first frame, s
  std::vector<Vector<D>> stress;    // contact and kinetic stress by layer, (xy, yy, zy)
  std::vector<Vector<D>> weight;    // -sum m g l / V by layer
  std::vector<Vector<D>> momentum;  // sum m v l / V at the first frame by layer, N s/m or Pa s
};

/// Sums over a window. All its frames must be added twice (see KineticStress): first by
/// add_to_mean(), then by add().
template <int D>
class WeightSums {
 public:
  /// `gravity` is in m/s^2; `bin` (m) is the largest thickness of the bins of the velocity profile.
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
  std::optional<KineticStress<D>> kinetic_;  // created when the mean velocity is known
  PartialContactStress<D> contact_;
  std::size_t frames_ = 0;
  double time_ = 0;                 // time of the first frame, s
  std::vector<double> mass_above_;  // sum m l over all frames, by layer, kg m
  // Sum m v l of the first frame, by layer, kg m^2/s; l: part of the layer below the centre, m.
  std::vector<Vector<D>> momentum_;
};

/// Measured and required stress of a layer, over all windows but the last, which only marks the end
/// of the window before. Errors are standard errors over windows.
struct LayerBalance {
  double y0 = 0, y1 = 0;  // bottom and top of the layer, m
  double carried = 0;     // (sigma + sigma^kappa)_yy over the stress that the balance requires
  double carried_error = 0;
  /// Stress ratio along x and, for spheres, along z.
  struct StressRatio {
    double ratio = 0;  // measured ratio -(sigma_xy + sigma^kappa_xy)/(sigma_yy + sigma^kappa_yy)
    double slope = 0;  // required ratio (g_x - a_x)/(a_y - g_y), a: acceleration of the mass above
    double error = 0;  // standard error of ratio - slope
  } along, across;
};

/// Balances of all layers that carry at least `least_load` of the first layer's load, without this
/// first layer, which depends on the shape of the base. Empty for less than three windows.
template <int D>
std::vector<LayerBalance> balance_layers(const std::vector<WeightWindow<D>>& windows,
                                         const Layers& layers, double least_load);

}  // namespace grseg
