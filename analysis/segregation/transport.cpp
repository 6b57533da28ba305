// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/transport.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grseg {

TransportColumn::TransportColumn(std::vector<double> phi_large, double height)
    : phi_(std::move(phi_large)), flux_(phi_.size() + 1, 0.0), height_(height)
{
}

double TransportColumn::set_fluxes(const TransportLaw& law)
{
  const double cell = height_ / static_cast<double>(phi_.size());
  double fastest = 0;  // largest velocity at which a cell can be emptied or filled, m/s
  for (std::size_t k = 1; k < phi_.size(); ++k) {
    const double below = phi_[k - 1], above = phi_[k];
    const auto [S, D] = law(static_cast<double>(k) * cell, (below + above) / 2);
    const double advected = S > 0 ? S * below * (1 - above) : S * above * (1 - below);
    const double spread = std::max(0.0, D / cell - std::abs(S) / 2);
    flux_[k] = advected - spread * (above - below);
    fastest = std::max(fastest, std::abs(S) + spread);
  }
  return fastest > 0 ? cell / (2 * fastest) : std::numeric_limits<double>::infinity();
}

void TransportColumn::advance(double duration, const TransportLaw& law)
{
  const double cell = height_ / static_cast<double>(phi_.size());
  while (duration > 0) {
    const double longest = set_fluxes(law);
    const double step = longest < duration ? duration / std::ceil(duration / longest) : duration;
    for (std::size_t k = 0; k < phi_.size(); ++k)
      phi_[k] = std::clamp(phi_[k] - step / cell * (flux_[k + 1] - flux_[k]), 0.0, 1.0);
    duration = step < duration ? duration - step : 0;
  }
}

}  // namespace grseg
