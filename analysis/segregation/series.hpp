// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "formats/core/frame.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// The mobile grains of one frame; NaN where a species is missing.
struct SegregationMoment {
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
  const std::vector<SegregationMoment>& moments() const { return moments_; }

 private:
  Layers layers_;
  std::vector<SegregationMoment> moments_;
};

}  // namespace grseg
