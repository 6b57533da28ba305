// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/pressure_estimate.hpp"

#include <limits>
#include <numbers>

namespace grseg {

template <int D>
PressureEstimate estimate_pressure(const StructureSums<D>& sums, const ForceMeasure& measure,
                                   double small_diameter, double large_diameter)
{
  const double phi_large = sums.phi_large();
  const auto partial = [&](Species species, double phi, double diameter) {
    if (phi == 0) return 0.0;
    return phi * sums.coordination(species) * sums.mean_force(species, measure) /
           (std::numbers::pi * (D == 2 ? diameter : diameter * diameter));
  };
  return {partial(Species::small, 1 - phi_large, small_diameter),
          partial(Species::large, phi_large, large_diameter)};
}

template PressureEstimate estimate_pressure(const StructureSums<2>&, const ForceMeasure&, double,
                                            double);
template PressureEstimate estimate_pressure(const StructureSums<3>&, const ForceMeasure&, double,
                                            double);

double partition_slope(double stress_small, double stress_large, double phi_large)
{
  const double phi_small = 1 - phi_large;
  if (!(phi_large > 0 && phi_small > 0 && stress_large > 0))
    return std::numeric_limits<double>::quiet_NaN();
  return stress_small * phi_large / (stress_large * phi_small);
}

double local_b(double slope, double phi_large)
{
  return (1 - slope) / (phi_large + slope * (1 - phi_large));
}

}  // namespace grseg
