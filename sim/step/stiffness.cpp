// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {

NumericalStiffness numerical_stiffness(const StiffnessInput& in)
{
  constexpr double rigid = 1e4, sinking = 1e-3;
  // Both conditions ask for a least N/h^2.
  const double for_rigidity = rigid * in.base_pressure / in.mass;
  const double for_sinking = in.layers * in.layers * in.gravity / (2 * sinking * in.diameter);
  const double least = std::max(for_rigidity, for_sinking);
  NumericalStiffness out;
  out.stiffness = in.sweeps * in.mass / (in.step * in.step);
  out.rigidity = out.stiffness / in.base_pressure;
  out.sound_speed = in.diameter * std::sqrt(in.sweeps) / in.step;
  out.advised_step = std::sqrt(in.sweeps / least);
  out.advised_sweeps = least * in.step * in.step;
  return out;
}

}  // namespace grseg
