// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/mean_velocity.hpp"

#include "analysis/frames/accumulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {

template <int D>
MeanVelocity<D>::MeanVelocity(const Layers& layers, double bin, std::size_t species)
    : layers_(layers),
      bins_(layers.with_thickness(layers.thickness() /
                                  std::max(std::ceil(layers.thickness() / bin - 1e-9), 1.0))),
      species_(species)
{
}

template <int D>
void MeanVelocity<D>::add(const Grains& grains, const Frame<D>& frame)
{
  const bool profile = !layers_.map();
  if (profile) of_bin_.resize(std::max(of_bin_.size(), bins_.count(grains, frame)));
  of_layer_.resize(std::max(of_layer_.size(), layers_.count(grains, frame)),
                   std::vector<Sum>(species_));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto& position = frame.position[g];
    const double y = layers_.height<D>(position), mass = grains.mass[g];
    const Sum own{mass, mass * motion_of<D>(layers_, frame, g)};
    if (profile) of_bin_[bins_.at(y)] += {own, mass * y};
    of_layer_[layers_.holding<D>(position, y)][static_cast<std::size_t>(grains.species[g])] += own;
  }
}

template <int D>
typename MeanVelocity<D>::Sum& MeanVelocity<D>::Sum::operator+=(const Sum& other)
{
  mass += other.mass;
  momentum += other.momentum;
  return *this;
}

template <int D>
typename MeanVelocity<D>::BinSum& MeanVelocity<D>::BinSum::operator+=(const BinSum& other)
{
  motion += other.motion;
  moment += other.moment;
  return *this;
}

template <int D>
void MeanVelocity<D>::merge(const MeanVelocity& others)
{
  accumulate(of_bin_, others.of_bin_);
  accumulate(of_layer_, others.of_layer_);
}

template <int D>
void MeanVelocity<D>::finish()
{
  for (const auto& [sum, moment] : of_bin_)
    if (sum.mass > 0) profile_.push_back({moment / sum.mass, sum.momentum / sum.mass});
  for (const auto& layer : of_layer_) mean_of_layer_.push_back(mean(layer));
}

template <int D>
Motion<D> MeanVelocity<D>::mean(const std::vector<Sum>& of_species)
{
  Sum all;
  for (const auto& own : of_species) all += own;
  return all.momentum / all.mass;
}

template <int D>
Motion<D> MeanVelocity<D>::of_layer(std::size_t layer) const
{
  return mean_of_layer_.empty() ? mean(of_layer_[layer]) : mean_of_layer_[layer];
}

template <int D>
Motion<D> MeanVelocity<D>::of_species(std::size_t layer, Species species) const
{
  const auto& sum = of_layer_[layer][static_cast<std::size_t>(species)];
  return sum.momentum / sum.mass;
}

template <int D>
Motion<D> MeanVelocity<D>::on_profile(double y) const
{
  const std::size_t n = profile_.size();
  if (n == 0) return Motion<D>::Constant(std::numeric_limits<double>::quiet_NaN());
  if (n == 1) return profile_[0].motion;
  const auto line = [y](const Point& a, const Point& b) -> Motion<D> {
    return a.motion + (b.motion - a.motion) * ((y - a.y) / (b.y - a.y));
  };
  const auto above = static_cast<std::size_t>(
      std::upper_bound(profile_.begin(), profile_.end(), y,
                       [](double height, const Point& point) { return height < point.y; }) -
      profile_.begin());
  // Neighbours' mean heights may lie close together, so the slope outside is taken over two bins.
  if (above == 0) return line(profile_[0], profile_[std::min<std::size_t>(2, n - 1)]);
  if (above == n) return line(profile_[n - 1], profile_[n - std::min<std::size_t>(3, n)]);
  return line(profile_[above - 1], profile_[above]);
}

template class MeanVelocity<2>;
template class MeanVelocity<3>;

}  // namespace grseg
