// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/mean_velocity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grseg {

template <int D>
void LayerFlowSums::add(double grain_mass, double above_bottom, const Vector<D>& velocity)
{
  mass += grain_mass;
  my += grain_mass * above_bottom;
  myy += grain_mass * above_bottom * above_bottom;
  mu += grain_mass * velocity.x();
  mv += grain_mass * velocity.y();
  muy += grain_mass * velocity.x() * above_bottom;
}

template void LayerFlowSums::add(double, double, const Vec2&);
template void LayerFlowSums::add(double, double, const Vec3&);

LayerFlow LayerFlowSums::mean(double thickness) const
{
  if (!(mass > 0)) return {no_number, no_number, no_number};
  const double y = my / mass, u = mu / mass;
  const double variance = myy / mass - y * y;
  const double covariance = muy / mass - y * u;
  const double resolved = 1e-12 * thickness * thickness;
  return {u, mv / mass, variance > resolved ? covariance / variance : no_number};
}

template <int D>
MeanVelocity<D>::MeanVelocity(const Layers& layers, double bin, std::size_t species)
    : layers_(layers),
      bins_(layers.with_thickness(layers.thickness() /
                                  std::max(std::ceil(layers.thickness() / bin - 1e-9), 1.0))),
      species_(species)
{
  if (const auto* cells = layers.map()) over_map_.emplace(*cells, 2 * bin);
}

template <int D>
void MeanVelocity<D>::add(const Grains& grains, const Frame<D>& frame)
{
  if (!over_map_) of_bin_.resize(std::max(of_bin_.size(), bins_.count(grains, frame)));
  of_layer_.resize(std::max(of_layer_.size(), layers_.count(grains, frame)),
                   std::vector<Sum>(species_));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto& position = frame.position[g];
    const double y = layers_.height<D>(position), mass = grains.mass[g];
    const Motion<D> motion = motion_of<D>(layers_, frame, g);
    if (over_map_)
      over_map_->add(position, mass, motion);
    else
      of_bin_[bins_.at(y)].add(1, y, mass, motion);
    of_layer_[layers_.holding<D>(position, y)][static_cast<std::size_t>(grains.species[g])] +=
        Sum{mass, mass * motion};
  }
}

/// Adds a grain (sign 1), or subtracts it (sign -1).
template <int D>
typename MeanVelocity<D>::BinSum& MeanVelocity<D>::BinSum::add(double sign, double y, double mass,
                                                               const Motion<D>& own)
{
  motion += {sign * mass, sign * mass * own};
  moment += sign * mass * y;
  grains += sign > 0 ? 1 : -1;
  const double square = sign * mass * mass;
  squares += square;
  squares_y += square * y;
  squares_yy += square * y * y;
  weighted += square * own;
  weighted_y += square * y * own;
  product += symmetric_product<D>(square, own, own);
  return *this;
}

/// The mean motion of the bin, and its covariance from deviations from a line with this slope.
template <int D>
MotionOfOthers<D> MeanVelocity<D>::BinSum::mean(const Motion<D>& slope) const
{
  const Motion<D> mean = velocity();
  const double y = height();
  const double pairs = motion.mass * motion.mass - squares;  // sum of m_j m_k, j != k
  // Sums of m^2 d, m^2 d^2 and m^2 d (v - mean), with d = y - mean height.
  const double d = squares_y - y * squares;
  const double dd = squares_yy - y * (2 * squares_y - y * squares);
  const Motion<D> dv = weighted_y - y * weighted - d * mean;
  auto scatter = product;
  scatter += symmetric_product<D>(-2, weighted, mean);
  scatter += symmetric_product<D>(squares, mean, mean);
  scatter += symmetric_product<D>(-2, dv, slope);
  scatter += symmetric_product<D>(dd, slope, slope);
  return {mean, {scatter.velocities / pairs, scatter.spins / pairs}};
}

template <int D>
void MeanVelocity<D>::merge(const MeanVelocity& others)
{
  accumulate(of_bin_, others.of_bin_);
  accumulate(of_layer_, others.of_layer_);
  if (over_map_) over_map_->merge(*others.over_map_);
}

template <int D>
void MeanVelocity<D>::finish()
{
  for (std::size_t b = 0; b < of_bin_.size(); ++b) {
    const auto& bin = of_bin_[b];
    if (bin.motion.mass > 0) profile_.push_back({bin.height(), bin.velocity()});
    if (bin.grains > 2) full_.push_back(b);
  }
  for (std::size_t k = 0; k < full_.size(); ++k) slope_.push_back(slope_at(k));
  if (over_map_) over_map_->finish();
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
  if (n == 0) return Motion<D>::Constant(no_number);
  if (n == 1) return profile_[0].motion;
  const auto line = [y](const Point& a, const Point& b) -> Motion<D> {
    return a.motion + (b.motion - a.motion) * ((y - a.y) / (b.y - a.y));
  };
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(profile_, y, {}, &Point::y) -
                                              profile_.begin());
  // Mean heights of neighbours may be close, so the slope for extrapolation spans two bins.
  if (above == 0) return line(profile_[0], profile_[std::min<std::size_t>(2, n - 1)]);
  if (above == n) return line(profile_[n - 1], profile_[n - std::min<std::size_t>(3, n)]);
  return line(profile_[above - 1], profile_[above]);
}

/// Slope of the profile at the k-th full bin: between its neighbours, or from it to its only one.
template <int D>
Motion<D> MeanVelocity<D>::slope_at(std::size_t k) const
{
  const auto& below = of_bin_[full_[k == 0 ? 0 : k - 1]];
  const auto& above = of_bin_[full_[std::min(k + 1, full_.size() - 1)]];
  if (&below == &above) return Motion<D>::Zero();
  return (above.velocity() - below.velocity()) / (above.height() - below.height());
}

template <int D>
std::optional<MotionOfOthers<D>> MeanVelocity<D>::on_profile_of_others(
    double y, double mass, const Motion<D>& motion) const
{
  const auto n = full_.size();
  if (n == 0) return std::nullopt;
  const auto own = bins_.at(y);
  const auto others = [&](std::size_t k) {
    BinSum bin = of_bin_[full_[k]];
    if (full_[k] == own) bin.add(-1, y, mass, motion);
    return bin;
  };
  if (n == 1) return others(0).mean(slope_[0]);
  // Index of the first point above y.
  auto above = static_cast<std::size_t>(std::ranges::lower_bound(full_, own) - full_.begin());
  if (above < n && full_[above] == own && others(above).height() <= y) ++above;
  const auto ends = above == 0
                        ? std::pair<std::size_t, std::size_t>(0, std::min<std::size_t>(2, n - 1))
                    : above == n ? std::pair(n - 1, n - std::min<std::size_t>(3, n))
                                 : std::pair(above - 1, above);
  const auto a = others(ends.first), b = others(ends.second);
  const double part = (y - a.height()) / (b.height() - a.height());
  const auto of_a = a.mean(slope_[ends.first]), of_b = b.mean(slope_[ends.second]);
  MotionOfOthers<D> found{of_a.mean + part * (of_b.mean - of_a.mean), {}};
  const auto add = [&](double weight, const MotionProduct<D>& covariance) {
    found.covariance +=
        {weight * weight * covariance.velocities, weight * weight * covariance.spins};
  };
  add(1 - part, of_a.covariance);
  add(part, of_b.covariance);
  return found;
}

template class MeanVelocity<2>;
template class MeanVelocity<3>;

}  // namespace grseg
