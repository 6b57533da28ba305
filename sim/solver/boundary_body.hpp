// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cmath>
#include <cstdint>

namespace grseg {

/// Boundary grains that move as one body, from t = 0 on. Motion is prescribed; of a body with a
/// mass only that along x, whereas along y it follows from its load and its contacts.
struct BoundaryBody {
  std::uint32_t begin = 0, end = 0;  ///< rows of Grains
  Vec2 velocity = Vec2::Zero();      ///< m/s
  Vec2 amplitude = Vec2::Zero();     ///< m, of a displacement amplitude sin(angular_frequency t)
  double angular_frequency = 0;      ///< rad/s
  Vec2 centre = Vec2::Zero();        ///< m, of rotation, at t = 0
  double spin = 0;                   ///< rad/s, counter-clockwise
  double mass = 0;                   ///< kg; above 0 the body is free along y
  double load = 0;                   ///< N, along y, on a body that is free

  bool free() const { return mass > 0; }
};

/// Displacement of a body at `time`, s, since t = 0, m.
inline Vec2 displacement(const BoundaryBody& body, double time)
{
  if (time <= 0) return Vec2::Zero();
  return body.velocity * time + body.amplitude * std::sin(body.angular_frequency * time);
}

/// The velocity, m/s, that takes the point of the body at `position` to where it is prescribed to
/// be at `time` + `step`: along the chord, so that distances from the axis stay the same. Of a free
/// body, only x counts.
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
