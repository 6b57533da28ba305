// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/boundary_body.hpp"

#include <cmath>

namespace grseg {

Vec2 displacement(const BoundaryBody& body, double time)
{
  if (time <= 0) return Vec2::Zero();
  return body.velocity * time + body.amplitude * std::sin(body.angular_frequency * time);
}

Vec2 chord_velocity(const BoundaryBody& body, const Vec2& position, double time, double step)
{
  const Vec2 now = displacement(body, time);
  Vec2 velocity = (displacement(body, time + step) - now) / step;
  if (body.spin != 0 && time + step > 0) {
    const double angle = body.spin * step, half = std::sin(angle / 2);
    const Vec2 arm = position - body.centre - now;
    const Vec2 across{-arm.y(), arm.x()};
    velocity += (std::sin(angle) * across - 2 * half * half * arm) / step;
  }
  return velocity;
}

}  // namespace grseg
