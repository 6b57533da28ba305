// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/composition.hpp"

#include "analysis/frames/accumulate.hpp"

#include <numbers>

namespace grseg {

void Composition::add(const Grains& grains, const Frame<2>& frame)
{
  ++frames_;
  const std::size_t count = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = layers_.height(frame.position[g]), radius = grains.radius[g];
    const double whole = std::numbers::pi * radius * radius;
    const auto book = [&](std::size_t n, double area) { sums_[n][species] += area; };
    if (rule_ == GrainArea::centre)
      book(layers_.at(y), whole);
    else if (rule_ == GrainArea::clipped)
      layers_.share_disc(y, radius, count, book);
    else
      share_kernel(layers_, *kernel_, y, y, count,
                   [&](std::size_t n, double share) { book(n, share * whole); });
  }
}

void Composition::merge(const Composition& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

Composition::Areas Composition::mean(std::size_t layer) const
{
  const auto frames = static_cast<double>(frames_);
  return {sums_[layer][0] / frames, sums_[layer][1] / frames};
}

Composition::Areas Composition::mean() const
{
  Areas all;
  for (std::size_t n = 0; n < layers(); ++n) {
    all.small += mean(n).small;
    all.large += mean(n).large;
  }
  return all;
}

}  // namespace grseg
