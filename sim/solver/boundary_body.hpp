// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_blocks.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// Boundary grains that move as one, from t = 0 on: as prescribed, or along y, where the body has a
/// mass, as its load and the contacts make it.
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

/// Where a body is at time t, s, less where it was at t <= 0.
Vec2 displacement(const BoundaryBody& body, double time);

/// The velocity that brings the point of the body at `position` to where it is to be at
/// `time` + `step`: along the chord, so that radii stay what they are. Of a free body, along x
/// only.
Vec2 chord_velocity(const BoundaryBody& body, const Vec2& position, double time, double step);

/// Bodies that give way, within one step's solve. Contacts relax as if boundary grains had
/// infinite mass; after each sweep every body takes the velocity that the sum of its impulses asks
/// for, less what its contacts are going to answer: one Newton step of
/// M (V - V_free) = P(V), dP/dV = - sum of the effective masses of the contacts under force. Its
/// contacts are then relaxed and it gives way once more: grains that a solve left with what a body
/// does last, all alike, would sink into it step by step.
class FreeBodies {
 public:
  /// `place` says where in `motion` each row of Grains is.
  FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
             std::span<const BlockRuns> strips, std::span<const Motion> motion);

  /// Velocities of all bodies, given the impulses in the blocks. Returns the largest change, m/s.
  double give_way(std::span<Motion> motion);
  /// One relaxation of the bodies' own contacts.
  void relax_contacts(std::span<Motion> motion, double friction, Effects effects);

 private:
  struct Seat {  // of a contact
    ContactBlock* block;
    std::uint32_t lane;
  };
  struct Body {
    double mass, free_velocity;  // kg, m/s without contacts
    std::vector<std::uint32_t> members;
    std::vector<Seat> contacts;
  };
  std::vector<Body> bodies_;
};

}  // namespace grseg
