// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/solver/contact_place.hpp"

#include <cstdint>
#include <span>
#include <vector>

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
Vec2 displacement(const BoundaryBody& body, double time);

/// The velocity, m/s, that takes the point of the body at `position` to where it is prescribed to
/// be at `time` + `step`: along the chord, so that distances from the axis stay the same. Of a free
/// body, only x counts.
Vec2 chord_velocity(const BoundaryBody& body, const Vec2& position, double time, double step);

/// Free bodies within the solve of one step. In a sweep boundary grains have infinite mass; after
/// each, every free body and its contacts are solved together. The contacts are relaxed and the body
/// takes the velocity V of one Newton step towards
///   M (V - V_free) = P(V),  dP/dV = - (sum of the effective masses of its contacts under force),
/// in turn, until V settles. P is the sum of its contact impulses along y, V_free its velocity without
/// contacts. A body that keeps a small part of its load's impulse each step sinks into its grains.
class FreeBodies {
 public:
  /// `place` gives the index in `motion` of each row of Grains.
  FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
             std::span<const BlockRuns> strips, std::span<const Motion> motion);

  /// Sets the velocities of all bodies from the impulses in the blocks. Returns the largest change,
  /// m/s.
  double update_velocities(std::span<Motion> motion);
  /// Solves the bodies and their own contacts, the impulses of which it changes. Returns the largest
  /// change of a body's velocity, m/s.
  double balance(std::span<Motion> motion, double friction, Effects effects);

 private:
  void relax_contacts(std::span<Motion> motion, double friction, Effects effects);

  struct Body {
    double mass, free_velocity;  // kg, m/s without contacts
    std::vector<std::uint32_t> members;
    std::vector<ContactPlace> contacts;
  };
  std::vector<Body> bodies_;
};

}  // namespace grseg
