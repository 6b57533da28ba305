// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/layers.hpp"
#include "analysis/mean_velocity.hpp"
#include "formats/frame.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// Kinetic stress by layer and species, sigma^kappa = (1/V) sum m dv (x) dv (Staron & Phillips
/// 2015, kinetic stress), dv = velocity less the mean velocity at the grain's own height. A grain
/// is booked, whole, in the layer of its centre. J, not divided by V, means per frame.
///
/// All frames of a window are gone through twice: first for the mean flow, then for the
/// fluctuations.
class KineticStress {
 public:
  /// Of one species in one layer.
  struct Mean {
    double mass = 0;                    // kg
    Tensor2 kinetic = Tensor2::Zero();  // J, sum m dv (x) dv, without a factor 1/2
    double rotational = 0;              // J, sum m r^2/2 dw^2, likewise; w is the spin
    Mean& operator+=(const Mean& other);
  };
  /// Of all mobile grains in one layer, weighted by mass; NaN where there are none.
  struct Flow {
    double u, v;   // m/s
    double du_dy;  // 1/s, slope of the least-squares line u(y); NaN for less than two heights
  };

  /// About the mean over the frames that `mean` was given, which are those to be added.
  KineticStress(const Layers& layers, const MeanVelocity& mean);

  void add(const Grains& grains, const Frame& frame);
  void merge(const KineticStress& others);

  std::size_t layers() const { return sums_.size(); }
  Mean mean(std::size_t layer, Species species) const;
  Flow flow(std::size_t layer) const;

  /// The columns of grseg-kinetic from mass_S on, and a layer's numbers under them.
  static std::vector<std::string> columns();
  std::vector<double> row(std::size_t layer) const;

 private:
  struct Sums {
    std::array<Mean, 2> species;
    double mass = 0, my = 0, myy = 0, mu = 0, mv = 0, muy = 0;  // y from the layer's bottom
    Sums& operator+=(const Sums& others);
  };

  Layers layers_;
  MeanVelocity mean_velocity_;
  std::size_t frames_ = 0;
  std::vector<Sums> sums_;
};

}  // namespace grseg
