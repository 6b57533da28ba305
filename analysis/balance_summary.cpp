// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance_summary.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

struct Estimate {
  double mean, error;
};

Estimate over_windows(const std::vector<double>& values)
{
  const std::size_t n = values.size();
  const double mean = gsl_stats_mean(values.data(), 1, n);
  return {mean, gsl_stats_sd_m(values.data(), 1, n, mean) / std::sqrt(static_cast<double>(n))};
}

/// "up 0.012 +- 0.003"; "neither way" where the error is no smaller than half the mean.
std::string direction(const Estimate& push)
{
  const bool known = std::abs(push.mean) > 2 * push.error;
  const char* way = !known ? "neither way" : push.mean > 0 ? "up" : "down";
  return fmt::format("{} ({:.2g} +- {:.1g})", way, push.mean, push.error);
}

}  // namespace

void BalanceSummary::add(const SpeciesMomentum& small, const SpeciesMomentum& large)
{
  for (const auto* own : {&small, &large}) {
    double largest = 0;
    for (const auto& term : {own->rate, own->gravity, own->contact, own->kinetic, own->interaction,
                             own->base, own->force})
      largest = std::max(largest, term.cwiseAbs().maxCoeff());
    if (largest > 0)
      residual_ = std::max(residual_, own->residual().cwiseAbs().maxCoeff() / largest);
  }
  const auto forces = segregation_forces(small, large);
  auto& window = windows_.back();
  if (std::isnan(forces.push) || std::isnan(forces.push_kinetic)) return;
  window.force[0] += forces.push;
  window.force[1] += forces.push_kinetic;
  window.force[2] += forces.drag;
  window.weight += large.density * std::abs(gravity_);
  window.drift += forces.drift;
}

std::string BalanceSummary::sentence() const
{
  const auto closed = fmt::format("each balance closes to {:.1e} of its largest term", residual_);
  std::array<std::vector<double>, mechanisms> parts;
  for (const auto& window : windows_)
    for (std::size_t m = 0; m < mechanisms && window.weight > 0; ++m)
      parts[m].push_back(window.force[m] / window.weight);
  if (parts[0].size() < 2) return closed;
  return fmt::format(
      "in units of their weight, over {} windows, large grains are pushed {} by the contact stress, "
      "{} by the kinetic stress, {} by drag; {}",
      parts[0].size(), direction(over_windows(parts[0])), direction(over_windows(parts[1])),
      direction(over_windows(parts[2])), closed);
}

}  // namespace grseg
