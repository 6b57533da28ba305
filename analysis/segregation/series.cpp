// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/series.hpp"

#include "analysis/frames/composition.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/frames/sums.hpp"

#include <array>

namespace grseg {

template <int D>
double mixing_index(const Layers& layers, const Grains& grains, const Frame<D>& frame)
{
  Composition<D> composition(layers, GrainArea::centre);
  composition.add(grains, frame);
  std::array<double, 2> number{};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g)) ++number[static_cast<std::size_t>(grains.species[g])];
  const auto all = composition.mean();
  const double volume = all[0] + all[1], phi = all[1] / volume;
  if (!(phi > 0 && phi < 1)) return no_number;

  double variance = 0, occupied = 0;
  for (std::size_t n = 0; n < composition.layers(); ++n) {
    const auto here = composition.mean(n);
    const double own = here[0] + here[1];
    if (!(own > 0)) continue;
    const double excess = here[1] / own - phi;
    variance += own * excess * excess / volume;
    ++occupied;
  }
  const double apart = phi * (1 - phi);
  const double of_one = (1 - phi) * all[1] / number[1] + phi * all[0] / number[0];
  const double random = occupied * apart * of_one / volume;
  return (apart - variance) / (apart - random);
}

template double mixing_index(const Layers&, const Grains&, const Frame<2>&);
template double mixing_index(const Layers&, const Grains&, const Frame<3>&);

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
  BedState now;
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
