// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/kinetic_stress.hpp"

#include "analysis/add_up.hpp"

#include <limits>

namespace grseg {

KineticStress::KineticStress(const Layers& layers, const MeanVelocity& mean)
    : layers_(layers), mean_velocity_(mean)
{
  mean_velocity_.finish();
}

void KineticStress::add(const Grains& grains, const Frame& frame)
{
  ++frames_;
  sums_.resize(std::max(sums_.size(), layers_.count(grains, frame)));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const double mass = grains.mass[g], radius = grains.radius[g], y = frame.position[g].y();
    const Vec2& velocity = frame.velocity[g];
    const std::size_t layer = layers_.at(y);
    auto& sums = sums_[layer];

    const Motion mean = mean_velocity_.at(grains.species[g], y);
    const Vec2 fluctuation = velocity - mean.head<2>();
    const double spin = frame.angular_velocity[g] - mean[2];
    auto& own = sums.species[static_cast<std::size_t>(grains.species[g])];
    own.mass += mass;
    own.kinetic += mass * fluctuation * fluctuation.transpose();
    own.rotational += mass * radius * radius / 2 * spin * spin;

    const double above = y - layers_.bottom(layer);
    sums.mass += mass;
    sums.my += mass * above;
    sums.myy += mass * above * above;
    sums.mu += mass * velocity.x();
    sums.mv += mass * velocity.y();
    sums.muy += mass * velocity.x() * above;
  }
}

KineticStress::Mean& KineticStress::Mean::operator+=(const Mean& other)
{
  mass += other.mass;
  kinetic += other.kinetic;
  rotational += other.rotational;
  return *this;
}

KineticStress::Sums& KineticStress::Sums::operator+=(const Sums& others)
{
  add_up(species, others.species);
  mass += others.mass;
  my += others.my;
  myy += others.myy;
  mu += others.mu;
  mv += others.mv;
  muy += others.muy;
  return *this;
}

void KineticStress::merge(const KineticStress& others)
{
  frames_ += others.frames_;
  add_up(sums_, others.sums_);
}

KineticStress::Mean KineticStress::mean(std::size_t layer, Species species) const
{
  Mean mean = sums_[layer].species[static_cast<std::size_t>(species)];
  const auto frames = static_cast<double>(frames_);
  mean.mass /= frames;
  mean.kinetic /= frames;
  mean.rotational /= frames;
  return mean;
}

KineticStress::Flow KineticStress::flow(std::size_t layer) const
{
  const auto& sums = sums_[layer];
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!(sums.mass > 0)) return {nan, nan, nan};
  const double y = sums.my / sums.mass, u = sums.mu / sums.mass;
  const double variance = sums.myy / sums.mass - y * y;
  const double covariance = sums.muy / sums.mass - y * u;
  const double resolved = 1e-12 * layers_.thickness() * layers_.thickness();
  return {u, sums.mv / sums.mass, variance > resolved ? covariance / variance : nan};
}

std::vector<std::string> KineticStress::columns()
{
  return {"mass_S[kg]", "mass_L[kg]", "u[m/s]",    "v[m/s]",    "du_dy[1/s]",
          "K_S_xx[J]",  "K_S_xy[J]",  "K_S_yx[J]", "K_S_yy[J]", "K_L_xx[J]",
          "K_L_xy[J]",  "K_L_yx[J]",  "K_L_yy[J]", "Kr_S[J]",   "Kr_L[J]"};
}

std::vector<double> KineticStress::row(std::size_t layer) const
{
  const auto small = mean(layer, Species::small), large = mean(layer, Species::large);
  const auto here = flow(layer);
  std::vector<double> row{small.mass, large.mass, here.u, here.v, here.du_dy};
  for (const Tensor2& k : {small.kinetic, large.kinetic})
    row.insert(row.end(), {k(0, 0), k(0, 1), k(1, 0), k(1, 1)});
  row.insert(row.end(), {small.rotational, large.rotational});
  return row;
}

}  // namespace grseg
