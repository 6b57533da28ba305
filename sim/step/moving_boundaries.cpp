// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/moving_boundaries.hpp"

namespace grseg {

void drive_boundaries(const World& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState& grains)
{
  for (const auto& body : world.bodies)
    for (auto row = body.begin; row < body.end; ++row) {
      auto& motion = grains.motion[body_of[row]];
      const auto velocity = chord_velocity(body, grains.position[body_of[row]], time, world.step);
      motion.vx = velocity.x();
      if (!body.free()) motion.vy = velocity.y();
      motion.rim_speed = time + world.step > 0 ? body.spin * world.grains.radius[row] : 0;
    }
}

void apply_loads(const World& world, double duration, std::span<const std::uint32_t> body_of,
                 GrainState& grains)
{
  for (const auto& body : world.bodies)
    if (body.free())
      for (auto row = body.begin; row < body.end; ++row)
        grains.motion[body_of[row]].vy += duration * body.load / body.mass;
}

}  // namespace grseg
