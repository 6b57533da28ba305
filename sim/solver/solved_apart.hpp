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

/// Place of a contact that is solved by itself: a lane of a block.
template <int D>
struct ContactPlace {
  ContactBlock<D>* block;
  std::uint32_t lane;

  /// Indices of the two bodies in the span of Motion.
  std::uint32_t i() const { return block->i[lane] / numbers_per_body<D>; }
  std::uint32_t j() const { return block->j[lane] / numbers_per_body<D>; }

  Contact<D> contact() const
  {
    const auto& b = *block;
    const auto at = [this](const auto& components) {
      std::array<double, std::tuple_size_v<std::decay_t<decltype(components)>>> values;
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = components[k][lane];
      return values;
    };
    return {{at(b.n), b.kappa[lane], b.mass_n[lane], b.mass_t[lane], b.rebound[lane],
             b.impulse_n[lane], at(b.impulse_t)},
            static_cast<std::int32_t>(i()),
            static_cast<std::int32_t>(j())};
  }
  void set_impulse(double n, const Turning<D, double>& t) const
  {
    block->impulse_n[lane] = n;
    for (std::size_t k = 0; k < t.size(); ++k) block->impulse_t[k][lane] = t[k];
  }
  /// Limits the rebound to 0, so that the contact only has to stop its approach.
  void bar_rebound() const { block->rebound[lane] = std::min(block->rebound[lane], 0.0); }
  /// Relaxes the contact once. Without `restitution` its rebound counts as 0.
  Relaxed<D, double> relax(Relax<D> relax_alone, bool restitution, std::span<Motion<D>> motion,
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
template <int D>
class FreeBodies {
 public:
  /// `place`: for each row of Grains, its index in `motion`.
  FreeBodies(std::span<const BoundaryBody> bodies, std::span<const std::uint32_t> place,
             std::span<const BlockRuns<D>> strips, std::span<const Motion<D>> motion);

  /// Sets the velocities of all free bodies from the impulses in the blocks. Returns the largest
  /// change of a velocity, m/s.
  double update_velocities(std::span<Motion<D>> motion);
  /// Solves the free bodies with their contacts, whose impulses change. Returns the largest change
  /// of a body's velocity, m/s.
  double balance(std::span<Motion<D>> motion, double friction, Effects effects);

 private:
  void relax_contacts(std::span<Motion<D>> motion, double friction, Effects effects);

  struct Body {
    double mass, free_velocity;          // M, kg; V_free, m/s
    std::vector<std::uint32_t> members;  // indices of its grains in `motion`
    std::vector<ContactPlace<D>> contacts;
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
///
/// Three contacts can lock a sphere where no two can: between three touching beads from mu = 0.83 on
/// at size ratio 2, from 0.5 on at 3.4. Such spheres are solved like others. Measured, in chutes of
/// size ratio 4 and mu = 0.5, and of 2 and mu = 1, over 1,300 sqrt(d_S/g) and more: neither overlaps
/// with the base (0.011 d_S at the start, 0.006 later) nor forces on it grow.
template <int D>
class WedgedGrains {
 public:
  /// `on_base`: contacts with immobile bodies. Sets to 0 the rebounds of locked grains, and their
  /// first guesses if the two bodies move apart.
  WedgedGrains(std::span<const std::span<ContactBlock<D>>> on_base,
               std::span<const Motion<D>> motion, double friction);

  bool empty() const { return grains_.empty(); }
  /// Solves the contacts of each locked grain. Returns the largest change of a contact's relative
  /// velocity, m/s.
  double settle(std::span<Motion<D>> motion, double friction, Effects effects);

 private:
  std::vector<std::vector<ContactPlace<D>>> grains_;
};

/// True if friction can lock a grain between its contacts a and b.
template <int D>
bool locks(const Contact<D>& a, const Contact<D>& b, double friction);

/// Bodies that are solved separately after each sweep; null if there are none.
template <int D>
struct SolvedApart {
  FreeBodies<D>* free = nullptr;
  WedgedGrains<D>* wedged = nullptr;

  bool any() const { return free != nullptr || wedged != nullptr; }
};

}  // namespace grseg
