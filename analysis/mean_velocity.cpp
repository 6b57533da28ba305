// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/mean_velocity.hpp"

#include "analysis/add_up.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Layers for the means of a layer, fine bins for the profile.
Layers bins_for(MeanFlow flow, const Layers& layers, double bin)
{
  const double parts = flow == MeanFlow::profile ? std::ceil(layers.thickness() / bin - 1e-9) : 1;
  return {layers.thickness() / std::max(parts, 1.0), layers.length()};
}

}  // namespace

MeanVelocity::MeanVelocity(MeanFlow flow, const Layers& layers, double bin)
    : flow_(flow), bins_(bins_for(flow, layers, bin))
{
}

void MeanVelocity::add(const Grains& grains, const Frame& frame)
{
  sums_.resize(std::max(sums_.size(), bins_.count(grains, frame)));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const double y = frame.position[g].y(), mass = grains.mass[g];
    const bool apart = flow_ == MeanFlow::species && grains.species[g] == Species::large;
    auto& sum = sums_[bins_.at(y)][apart ? 1 : 0];
    sum.mass += mass;
    sum.moment += mass * y;
    sum.momentum +=
        mass * Motion{frame.velocity[g].x(), frame.velocity[g].y(), frame.angular_velocity[g]};
  }
}

MeanVelocity::Sum& MeanVelocity::Sum::operator+=(const Sum& other)
{
  mass += other.mass;
  moment += other.moment;
  momentum += other.momentum;
  return *this;
}

void MeanVelocity::merge(const MeanVelocity& others)
{
  add_up(sums_, others.sums_);
}

void MeanVelocity::finish()
{
  if (flow_ != MeanFlow::profile) return;
  for (const auto& [sum, unused] : sums_)
    if (sum.mass > 0) profile_.push_back({sum.moment / sum.mass, sum.momentum / sum.mass});
}

Motion MeanVelocity::at(Species species, double y) const
{
  if (flow_ == MeanFlow::profile) return on_profile(y);
  const bool apart = flow_ == MeanFlow::species && species == Species::large;
  const auto& sum = sums_[bins_.at(y)][apart ? 1 : 0];
  return sum.momentum / sum.mass;
}

Motion MeanVelocity::on_profile(double y) const
{
  const std::size_t n = profile_.size();
  if (n == 1) return profile_[0].motion;
  const auto line = [y](const Point& a, const Point& b) -> Motion {
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

}  // namespace grseg
