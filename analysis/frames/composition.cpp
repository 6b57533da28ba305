// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/composition.hpp"

#include "analysis/frames/accumulate.hpp"

#include <algorithm>

namespace grseg {

template <int D>
void Composition<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  const std::size_t count = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count), Contents(species_));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = layers_.height<D>(frame.position[g]), radius = grains.radius[g];
    const double whole = grain_volume<D>(radius);
    const auto book = [&](std::size_t n, double part) { sums_[n][species] += part; };
    if (rule_ == GrainArea::centre)
      book(layers_.holding<D>(frame.position[g], y), whole);
    else if (rule_ == GrainArea::clipped)
      layers_.share_grain<D>(y, radius, count, book);
    else
      share_kernel(layers_, *kernel_, y, y, count,
                   [&](std::size_t n, double share) { book(n, share * whole); });
  }
}

template <int D>
void Composition<D>::merge(const Composition& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

template <int D>
typename Composition<D>::Contents Composition<D>::mean(std::size_t layer) const
{
  Contents mean = sums_[layer];
  for (auto& content : mean) content /= static_cast<double>(frames_);
  return mean;
}

template <int D>
typename Composition<D>::Contents Composition<D>::mean() const
{
  Contents all(species_);
  for (std::size_t n = 0; n < layers(); ++n) accumulate(all, mean(n));
  return all;
}

template class Composition<2>;
template class Composition<3>;

}  // namespace grseg
