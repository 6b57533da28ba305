// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/series.hpp"

#include "analysis/frames/composition.hpp"
#include "analysis/frames/layer_flow.hpp"

#include <array>
#include <limits>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double ratio(double a, double b)
{
  return b > 0 ? a / b : nan;
}

SegregationSeries::Moment heights(const Grains& grains, const Frame& frame)
{
  std::array<double, 2> mass{}, moment{};
  double area = 0, area_moment = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), square = grains.radius[g] * grains.radius[g];
    mass[species] += grains.mass[g];
    moment[species] += grains.mass[g] * y;
    area += square;
    area_moment += square * y;
  }
  SegregationSeries::Moment now;
  now.time = frame.time;
  now.small = ratio(moment[0], mass[0]);
  now.large = ratio(moment[1], mass[1]);
  now.bed = 2 * ratio(area_moment, area);
  return now;
}

double shear_rate(const Grains& grains, const Frame& frame, double bed)
{
  LayerFlowSums sums;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const double y = frame.position[g].y();
    if (is_mobile(grains, g) && y > 0.1 * bed && y < 0.9 * bed)
      sums.add(grains.mass[g], y, frame.velocity[g]);
  }
  return sums.mean(bed).du_dy;
}

}  // namespace

double mixing_index(const Layers& layers, const Grains& grains, const Frame& frame)
{
  Composition composition(layers, GrainArea::centre);
  composition.add(grains, frame);
  std::array<double, 2> number{};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) ++number[static_cast<std::size_t>(grains.species[g])];
  const auto all = composition.mean();
  const double area = all.small + all.large, phi = all.phi_large();
  if (!(phi > 0 && phi < 1)) return nan;

  double variance = 0, occupied = 0;
  for (std::size_t n = 0; n < composition.layers(); ++n) {
    const auto here = composition.mean(n);
    const double own = here.small + here.large;
    if (!(own > 0)) continue;
    const double excess = here.phi_large() - phi;
    variance += own * excess * excess / area;
    ++occupied;
  }
  const double apart = phi * (1 - phi);
  const double of_one = (1 - phi) * all.large / number[1] + phi * all.small / number[0];
  const double random = occupied * apart * of_one / area;
  return (apart - variance) / (apart - random);
}

void SegregationSeries::add(const Grains& grains, const Frame& frame)
{
  auto now = heights(grains, frame);
  now.shear_rate = shear_rate(grains, frame, now.bed);
  now.mixing = mixing_index(layers_, grains, frame);
  if (!moments_.empty()) {
    const auto& last = moments_.back();
    now.strain = last.strain + (last.shear_rate + now.shear_rate) / 2 * (now.time - last.time);
  }
  moments_.push_back(now);
}

void SegregationSeries::merge(const SegregationSeries& later)
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

}  // namespace grseg
