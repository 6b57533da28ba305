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
  double reach = 0;  ///< m, largest distance from the axis of grains that it carries
  double mass = 0;   ///< kg; if above 0, the body moves freely along y
  double load = 0;   ///< N, external force along y on a free body

  bool free() const { return mass > 0; }
};

/// Displacement of a body from t = 0 to `time` (s), without rotation, m.
inline Vec2 displacement(const BoundaryBody& body, double time)
{
  if (time <= 0) return Vec2::Zero();
  return body.velocity * time + body.amplitude * std::sin(body.angular_frequency * time);
}

// Boundary grains move as other grains do (simulation.hpp): for half a step with their velocity at
// its beginning, for the other half with the velocity at its end. A grain that rests on a boundary
// moves with it; with one velocity for the whole step the boundary would run into the grain. Each
// velocity is the prescribed one times tan(a)/a, where a is half the phase or the angle of a step:
// with this factor every step ends exactly at the prescribed place.

/// Velocity at the beginning of a step, m/s, of the point of the body that is at `position` then.
/// For a free body, only the x component is used.
inline Vec2 velocity_at_begin(const BoundaryBody& body, const Vec2& position, double time,
                              double step)
{
  if (time < 0) return Vec2::Zero();
  const Vec2 arm = position - body.centre - displacement(body, time);
  const double shaken = 2 / step * std::tan(body.angular_frequency * step / 2);
  const double turned = 2 / step * std::tan(body.spin * step / 2);
  return body.velocity + shaken * std::cos(body.angular_frequency * time) * body.amplitude +
         turned * Vec2(-arm.y(), arm.x());
}

/// Change of that velocity in the middle of the step, m/s; the point is at `position` then.
inline Vec2 velocity_change(const BoundaryBody& body, const Vec2& position, double time,
                            double step)
{
  if (time < 0) return Vec2::Zero();
  const double phase = body.angular_frequency * step / 2, angle = body.spin * step / 2;
  const Vec2 centre = body.centre + displacement(body, time + step / 2);
  return -4 / step *
         (std::tan(phase) * std::sin(phase) * std::sin(body.angular_frequency * time + phase) *
              body.amplitude +
          std::sin(angle) * std::sin(angle) * (position - centre));
}

/// Largest acceleration of a body's prescribed motion, m/s^2.
inline double largest_acceleration(const BoundaryBody& body)
{
  return body.amplitude.norm() * body.angular_frequency * body.angular_frequency +
         body.reach * body.spin * body.spin;
}

}  // namespace grseg
