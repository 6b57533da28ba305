// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "formats/core/frame.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// Lacey's (1954) index of the composition by layer: (s_0^2 - s^2)/(s_0^2 - s_r^2), 0 where the
/// species are separated and 1 where they are mixed at random. s^2 is the variance of phi_L over
/// the layers about the bed's Phi_L, weighted by area or volume; s_0^2 = Phi_L Phi_S is that of
/// separated species and s_r^2 = n Phi_L Phi_S (Phi_S a_L + Phi_L a_S)/A that of a random mixture
/// (Stange 1954), for n layers, the area or volume A of all grains and a_S, a_L of one grain. Each
/// grain belongs to the layer of its centre. NaN where a species is missing.
template <int D>
double mixing_index(const Layers& layers, const Grains& grains, const Frame<D>& frame);

/// The mobile grains of one frame; NaN where a species is missing.
struct BedState {
  double time = 0;                       // s
  double large = 0, small = 0, bed = 0;  // m, as in BedHeights
  double shear_rate = 0;                 // 1/s, slope of the least-squares line u(y) from 10 to
                                         // 90 % of `bed`
  double mixing = 0;                     // mixing_index
  double strain = 0;                     // integral of the shear rate since the first frame, by
                                         // trapezia
};

/// How far a bed has segregated, frame by frame: a few numbers per frame.
template <int D>
class SegregationSeries {
 public:
  explicit SegregationSeries(const Layers& layers) : layers_(layers) {}

  void add(const Grains& grains, const Frame<D>& frame);
  /// Appends the frames of another, which come later.
  void merge(const SegregationSeries& later);
  const std::vector<BedState>& moments() const { return moments_; }

 private:
  Layers layers_;
  std::vector<BedState> moments_;
};

}  // namespace grseg
