// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cmath>
#include <cstdint>

namespace grseg {

/// Boundary grains that move as one body, from t = 0 on. Their motion is prescribed. If the body
/// has a mass, only its motion along x is prescribed; along y it follows from its load and its
/// contacts. Bodies move in the plane of x and y and rotate about z, also in three dimensions.
struct BoundaryBody {
  std::uint32_t begin = 0, end = 0;  ///< rows of its grains in Grains
  Vec2 velocity = Vec2::Zero();      ///< m/s, constant part of the velocity
  Vec2 amplitude = Vec2::Zero();     ///< m, A of a displacement A sin(angular_frequency t)
  double angular_frequency = 0;      ///< rad/s
  Vec2 centre = Vec2::Zero();        ///< m, centre of rotation at t = 0
  double spin = 0;                   ///< rad/s, angular velocity, counter-clockwise
  double mass = 0;                   ///< kg; if above 0, the body moves freely along y
  double load = 0;                   ///< N, external force along y on a free body

  bool free() const { return mass > 0; }
};

/// Displacement of a body from t = 0 to `time` (s), without rotation, m.
inline Vec2 displacement(const BoundaryBody& body, double time)
{
  if (time <= 0) return Vec2::Zero();
  return body.velocity * time + body.amplitude * std::sin(body.angular_frequency * time);
}

/// Velocity, m/s, that moves the point of the body at `position` in one step to its prescribed
/// place at `time` + `step`. It points along the chord, so that distances from the axis stay the
/// same. For a free body, only the x component is used.
inline Vec2 chord_velocity(const BoundaryBody& body, const Vec2& position, double time, double step)
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
