// SPDX-License-Identifier: GPL-3.0-or-later
// A bed on its base, which may be shaken.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <numbers>

namespace grseg {
namespace {

std::vector<BoundaryBody> shaken_base(const Scene& scene, const Grains& grains)
{
  if (scene.shake_amplitude == 0) return {};
  auto base = body_of_beads(grains);
  base.amplitude = {0, scene.shake_amplitude};
  base.angular_frequency = 2 * std::numbers::pi * scene.shake_frequency;
  return {base};
}

}  // namespace

const Geometry bed_geometry{.name = "bed",
                            .help = "on a base",
                            .shapes_base = true,
                            .boundaries = base_and_sides,
                            .bodies = shaken_base};

}  // namespace grseg
