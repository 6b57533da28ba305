// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/mean_velocity.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <vector>

namespace grseg {

/// Kinetic stress of frames about their mean flow, in layers of height 1; `bin`: bin of the
/// velocity profile.
inline KineticStress<2> kinetic_of(const std::vector<Packing>& frames, MeanFlow flow, double bin)
{
  const Layers layers(1, 10);
  MeanVelocity<2> mean(layers, bin);
  for (const auto& packing : frames) mean.add(packing.grains, packing.frame);
  KineticStress<2> stress(layers, flow, mean);
  for (const auto& packing : frames) stress.add(packing.grains, packing.frame);
  return stress;
}

}  // namespace grseg
