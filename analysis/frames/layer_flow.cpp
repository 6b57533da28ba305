// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_flow.hpp"

#include <limits>

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

LayerFlowSums& LayerFlowSums::operator+=(const LayerFlowSums& others)
{
  mass += others.mass;
  my += others.my;
  myy += others.myy;
  mu += others.mu;
  mv += others.mv;
  muy += others.muy;
  return *this;
}

LayerFlow LayerFlowSums::mean(double thickness) const
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!(mass > 0)) return {nan, nan, nan};
  const double y = my / mass, u = mu / mass;
  const double variance = myy / mass - y * y;
  const double covariance = muy / mass - y * u;
  const double resolved = 1e-12 * thickness * thickness;
  return {u, mv / mass, variance > resolved ? covariance / variance : nan};
}

}  // namespace grseg
