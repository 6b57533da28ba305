// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/series.hpp"

#include "analysis/frames/composition.hpp"
#include "analysis/frames/layer_flow.hpp"
#include "analysis/segregation/mixing_index.hpp"

namespace grseg {
namespace {

/// From 10 to 90 % of the height of the bed.
template <int D>
double shear_rate(const Grains& grains, const Frame<D>& frame, double bed)
{
  LayerFlowSums sums;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const double y = frame.position[g].y();
    if (is_mobile(grains, frame, g) && y > 0.1 * bed && y < 0.9 * bed)
      sums.add(grains.mass[g], y, frame.velocity[g]);
  }
  return sums.mean(bed).du_dy;
}

}  // namespace

template <int D>
void SegregationSeries<D>::add(const Grains& grains, const Frame<D>& frame)
{
  const auto heights = bed_heights(grains, frame);
  SegregationMoment now;
  now.time = frame.time;
  now.large = heights.large;
  now.small = heights.small;
  now.bed = heights.bed;
  now.shear_rate = shear_rate(grains, frame, now.bed);
  now.mixing = mixing_index(layers_, grains, frame);
  if (!moments_.empty()) {
    const auto& last = moments_.back();
    now.strain = last.strain + (last.shear_rate + now.shear_rate) / 2 * (now.time - last.time);
  }
  moments_.push_back(now);
}

template <int D>
void SegregationSeries<D>::merge(const SegregationSeries& later)
{
  if (later.moments_.empty()) return;
  double offset = 0;
  if (!moments_.empty()) {
    const auto &last = moments_.back(), &next = later.moments_.front();
    offset = last.strain + (last.shear_rate + next.shear_rate) / 2 * (next.time - last.time);
  }
  for (auto moment : later.moments_) {
    moment.strain += offset;
    moments_.push_back(moment);
  }
}

template class SegregationSeries<2>;
template class SegregationSeries<3>;

}  // namespace grseg
