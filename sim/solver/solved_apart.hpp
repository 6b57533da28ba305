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

/// Where a contact is that is solved by itself.
struct ContactPlace {
  ContactBlock* block;
  std::uint32_t lane;

  /// Indices in the span of Motion.
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
  /// The contact need no more than stop its approach.
  void bar_rebound() const { block->rebound[lane] = std::min(block->rebound[lane], 0.0); }
  /// One relaxation. Without `restitution` rebounds are 0.
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

/// Free bodies within the solve of one step. In a sweep boundary grains have infinite mass; after
/// each, every free body and its contacts are solved together. The contacts are relaxed and the
/// body takes the velocity V of one Newton step towards
///   M (V - V_free) = P(V),  dP/dV = - (sum of the effective masses of its contacts under force),
/// in turn, until V settles. P is the sum of its contact impulses along y, V_free its velocity
/// without contacts. A body that keeps a small part of its load's impulse each step sinks into its
/// grains.
class FreeBodies {
 public:
  /// `place` gives the index in `motion` of each row of Grains.
  FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
             std::span<const BlockRuns> strips, std::span<const Motion> motion);

  /// Sets the velocities of all bodies from the impulses in the blocks. Returns the largest change,
  /// m/s.
  double update_velocities(std::span<Motion> motion);
  /// Solves the bodies and their own contacts, the impulses of which it changes. Returns the
  /// largest change of a body's velocity, m/s.
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

/// Grains that friction can lock between two bodies which contacts do not move: the line through
/// the two contact points lies in both cones of friction (tan of its angle to the normals below
/// mu).
///
/// No impulses of these contacts, however large, push such a grain out again. So it cannot rebound
/// from them: sweeps would seek rebounds in vain and let forces grow without bound. And a
/// relaxation of either contact stops little of its motion into the gap: with the few sweeps of a
/// step it would sink deeper, step after step. So its contacts with these bodies are relaxed in
/// turn, after each sweep, until they settle. Between bodies that close in on each other no
/// impulses stop a locked grain; what they have added up is forgotten when the bodies part.
class WedgedGrains {
 public:
  /// `on_base` are the contacts with bodies that contacts do not move. Sets rebounds that cannot be
  /// reached to 0, and the first guesses of a grain whose bodies part.
  WedgedGrains(std::span<const std::span<ContactBlock>> on_base, std::span<const Motion> motion,
               double friction);

  bool empty() const { return grains_.empty(); }
  /// Solves the contacts of each grain. Returns the largest change of a contact's relative
  /// velocity, m/s.
  double settle(std::span<Motion> motion, double friction, Effects effects);

 private:
  std::vector<std::vector<ContactPlace>> grains_;
};

/// True where friction can lock a disc between a and b.
bool locks(const Contact& a, const Contact& b, double friction);

/// Bodies that are solved apart after each sweep; null where there are none.
struct SolvedApart {
  FreeBodies* free = nullptr;
  WedgedGrains* wedged = nullptr;

  bool any() const { return free != nullptr || wedged != nullptr; }
};

}  // namespace grseg
