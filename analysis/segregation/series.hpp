// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "formats/core/frame.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// How far a bed has segregated, frame by frame: a few numbers each.
class SegregationSeries {
 public:
  /// Of the mobile grains in one frame; NaN where a species is absent.
  struct Moment {
    double time = 0;              // s
    double large = 0, small = 0;  // y_L, y_S: centres of mass of the species, m
    double bed = 0;               // height, m: twice the mean height of the grains' area
    double shear_rate = 0;        // 1/s, slope of the least-squares line u(y) over 10-90 % of `bed`
    double mixing = 0;            // Lacey's index, see mixing_index
    double strain = 0;            // integral of the shear rate since the first frame, by trapezia
  };

  explicit SegregationSeries(const Layers& layers) : layers_(layers) {}

  void add(const Grains& grains, const Frame& frame);
  /// Appends the frames of another, which come later.
  void merge(const SegregationSeries& later);
  const std::vector<Moment>& moments() const { return moments_; }

 private:
  Layers layers_;
  std::vector<Moment> moments_;
};

/// Lacey's (1954) index of the composition by layer: (s_0^2 - s^2)/(s_0^2 - s_r^2), 0 where the
/// species are apart and 1 where they lie at random. s^2 is the variance of phi_L over the layers
/// about the bed's Phi_L, weighted by area; s_0^2 = Phi_L Phi_S that of separated species and
/// s_r^2 = n Phi_L Phi_S (Phi_S a_L + Phi_L a_S)/A that of random ones (Stange 1954), for n layers,
/// area A of all grains and a_S, a_L of one. Grains count whole where their centre is. NaN where a
/// species is absent.
double mixing_index(const Layers& layers, const Grains& grains, const Frame& frame);

}  // namespace grseg
