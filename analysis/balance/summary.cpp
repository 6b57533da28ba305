// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/summary.hpp"

#include "analysis/balance/mean_of_windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// "up by 0.012 +- 0.003", or "neither way" where zero lies within two standard errors; without an error
/// where the windows have none.
std::string direction(const std::vector<double>& push)
{
  const auto [mean, error] = mean_of_windows(push);
  if (std::isnan(error))
    return mean == 0 ? "neither way"
                     : fmt::format("{} by {:.2g}", mean > 0 ? "up" : "down", std::abs(mean));
  if (std::abs(mean) <= 2 * error)
    return fmt::format("neither way ({:.2g} +- {:.1g})", mean, error);
  return fmt::format("{} by {:.2g} +- {:.1g}", mean > 0 ? "up" : "down", std::abs(mean), error);
}

/// m.
template <int D>
double surface(const MomentumBalance<D>& window, const Layers& layers)
{
  double mass = 0, moment = 0;
  for (std::size_t n = 0; n < window.layers(); ++n) {
    double here = 0;
    for (std::size_t k = 0; k < window.species(); ++k)
      here += window.mean(n, static_cast<Species>(k)).density;
    mass += here;
    moment += here * (layers.bottom(n) + layers.top(n)) / 2;
  }
  return 2 * moment / mass;
}

}  // namespace

template <int D>
std::vector<std::size_t> layers_inside(const MomentumBalance<D>& window, const Layers& layers,
                                       double large_diameter)
{
  const double margin = 2 * large_diameter, rounding = 1e-9 * margin;
  const double highest = surface(window, layers) - margin;
  std::vector<std::size_t> inside;
  for (std::size_t n = 0; n < window.layers(); ++n)
    if (layers.bottom(n) >= margin - rounding && layers.top(n) <= highest + rounding)
      inside.push_back(n);
  return inside;
}

template <int D>
BalanceSummary<D>::BalanceSummary(const Layers& layers, double large_diameter)
    : layers_(layers), large_diameter_(large_diameter)
{
}

template <int D>
void BalanceSummary<D>::add_residual(const SpeciesMomentum<D>& own)
{
  double largest = 0;
  for (const auto& term :
       {own.rate, own.gravity, own.contact, own.kinetic, own.interaction, own.base})
    largest = std::max(largest, term.cwiseAbs().maxCoeff());
  if (largest > 0) residual_ = std::max(residual_, own.residual().cwiseAbs().maxCoeff() / largest);
}

template <int D>
void BalanceSummary<D>::add(const MomentumBalance<D>& window)
{
  for (std::size_t n = 0; n < window.layers(); ++n)
    for (std::size_t k = 0; k < window.species(); ++k)
      add_residual(window.mean(n, static_cast<Species>(k)));
  if (window.species() != 2) return;
  double push = 0, push_kinetic = 0, drag = 0, weight = 0;
  for (const auto n : layers_inside(window, layers_, large_diameter_)) {
    const auto forces = driving_forces(window, n);
    if (std::isnan(forces.drag)) continue;
    push += forces.push;
    push_kinetic += forces.push_kinetic;
    drag += forces.drag;
    weight += std::abs(window.mean(n, Species::large).gravity.y());
  }
  if (!(weight > 0)) return;
  push_.push_back(push / weight);
  push_kinetic_.push_back(push_kinetic / weight);
  drag_.push_back(drag / weight);
}

template <int D>
std::string BalanceSummary<D>::sentence() const
{
  auto closed = fmt::format("the balances close to {:.1e} of the largest term of each", residual_);
  if (push_.size() < 2) return closed;
  return fmt::format(
      "in units of their weight, with mixed contacts cut at the contact point, large grains are "
      "pushed {} by contact stress, {} by kinetic "
      "stress and {} by drag (at least two large diameters from base and surface, {}); {}",
      direction(push_), direction(push_kinetic_), direction(drag_), errors_over(drag_), closed);
}

template std::vector<std::size_t> layers_inside(const MomentumBalance<2>&, const Layers&, double);
template std::vector<std::size_t> layers_inside(const MomentumBalance<3>&, const Layers&, double);
template class BalanceSummary<2>;
template class BalanceSummary<3>;

}  // namespace grseg
