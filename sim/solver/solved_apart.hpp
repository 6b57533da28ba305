// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_blocks.hpp"
#include "sim/solver/boundary_body.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

constexpr std::uint32_t doubles_per_body = sizeof(Motion) / sizeof(double);

/// Place of a contact that is solved by itself: a lane of a block.
struct ContactPlace {
  ContactBlock* block;
  std::uint32_t lane;

  /// Indices of the two bodies in the span of Motion.
  std::uint32_t i() const { return block->i[lane] / doubles_per_body; }
  std::uint32_t j() const { return block->j[lane] / doubles_per_body; }

  Contact contact() const
  {
    const auto& b = *block;
    return {{b.nx[lane], b.ny[lane], b.kappa[lane], b.mass_n[lane], b.mass_t[lane], b.rebound[lane],
             b.impulse_n[lane], b.impulse_t[lane]},
            static_cast<std::int32_t>(i()),
            static_cast<std::int32_t>(j())};
  }
  void set_impulse(double n, double t) const
  {
    block->impulse_n[lane] = n;
    block->impulse_t[lane] = t;
  }
  /// Limits the rebound to 0, so that the contact only has to stop its approach.
  void bar_rebound() const { block->rebound[lane] = std::min(block->rebound[lane], 0.0); }
  /// Relaxes the contact once. Without `restitution` its rebound counts as 0.
  Relaxed<double> relax(Relax relax_alone, bool restitution, std::span<Motion> motion,
                        double friction) const
  {
    auto alone = contact();
    if (!restitution) alone.rebound = 0;
    const auto change = relax_alone(alone, motion[i()], motion[j()], friction);
    set_impulse(alone.impulse_n, alone.impulse_t);
    return change;
  }
};

/// Free bodies (BoundaryBody) within the solve of one step. During a sweep boundary grains have
/// infinite mass; after each sweep, every free body and its contacts are solved together. In turn,
/// the contacts are relaxed and the velocity V of the body is set by one Newton step towards
///   M (V - V_free) = P(V),  dP/dV = - (sum of the effective masses of its contacts under force),
/// until V settles. P is the sum of the body's contact impulses along y, V_free its velocity
/// without contacts. If even a small part of the load's impulse remained in each step, the body
/// would sink into the grains.
class FreeBodies {
 public:
  /// `place`: for each row of Grains, its index in `motion`.
  FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
             std::span<const BlockRuns> strips, std::span<const Motion> motion);

  /// Sets the velocities of all free bodies from the impulses in the blocks. Returns the largest
  /// change of a velocity, m/s.
  double update_velocities(std::span<Motion> motion);
  /// Solves the free bodies with their contacts, whose impulses change. Returns the largest change
  /// of a body's velocity, m/s.
  double balance(std::span<Motion> motion, double friction, Effects effects);

 private:
  void relax_contacts(std::span<Motion> motion, double friction, Effects effects);

  struct Body {
    double mass, free_velocity;          // M, kg; V_free, m/s
    std::vector<std::uint32_t> members;  // indices of its grains in `motion`
    std::vector<ContactPlace> contacts;
  };
  std::vector<Body> bodies_;
};

/// Grains that friction can lock between two immobile bodies: the line through the two contact
/// points lies in both friction cones (tangent of its angle to both normals below mu).
///
/// No impulses of the two contacts, however large, push a locked grain out. So its rebounds are set
/// to 0: sweeps could not reach them, and forces would grow without bound. One relaxation of either
/// contact stops little of the grain's motion into the gap; with the few sweeps of a step it would
/// sink deeper, step after step. So the two contacts are relaxed in turn, after each sweep, until
/// they settle. If the bodies approach each other no impulses stop a locked grain, and impulses add
/// up; they are set to 0 when the bodies move apart.
class WedgedGrains {
 public:
  /// `on_base`: contacts with immobile bodies. Sets to 0 the rebounds of locked grains, and their
  /// first guesses if the two bodies move apart.
  WedgedGrains(std::span<const std::span<ContactBlock>> on_base, std::span<const Motion> motion,
               double friction);

  bool empty() const { return grains_.empty(); }
  /// Solves the contacts of each locked grain. Returns the largest change of a contact's relative
  /// velocity, m/s.
  double settle(std::span<Motion> motion, double friction, Effects effects);

 private:
  std::vector<std::vector<ContactPlace>> grains_;
};

/// True if friction can lock a disc between its contacts a and b.
bool locks(const Contact& a, const Contact& b, double friction);

/// Bodies that are solved separately after each sweep; null if there are none.
struct SolvedApart {
  FreeBodies* free = nullptr;
  WedgedGrains* wedged = nullptr;

  bool any() const { return free != nullptr || wedged != nullptr; }
};

}  // namespace grseg
