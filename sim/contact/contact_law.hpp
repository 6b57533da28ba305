// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

/// Signorini's condition, Newton's restitution and Coulomb's friction for one contact of two discs
/// (Moreau 1994, Jean 1999), in the form in which the local problem has an exact solution.
namespace grseg {

/// What a contact needs to know of a grain, 32 bytes. With the rim speed r*omega in place of the
/// angular velocity the moment of inertia of a disc, m r^2/2, leaves the equations. Aligned, so
/// that one load fetches it.
struct alignas(32) Motion {
  double vx = 0, vy = 0;    // m/s
  double rim_speed = 0;     // m/s, radius times angular velocity (counter-clockwise)
  double inverse_mass = 0;  // 1/kg; 0 for whatever does not give way
};

/// A pair that touches, seen from the middle of the step. The normal n points from j to i, the
/// tangent is t = (-ny, nx). Impulses are those ON i, in kg m/s, over the whole step.
///
/// The lever arms are kappa r_i and kappa r_j, kappa = |x_i - x_j|/(r_i + r_j), so that they add up
/// to the distance of the centres and angular momentum is conserved whatever the gap.
struct Contact {
  double nx, ny;
  double kappa;                 // 1 at a straight wall
  double mass_n, mass_t;        // kg, effective masses 1/W_nn and 1/W_tt
  double rebound;               // m/s, least separation velocity asked for after the step
  double impulse_n, impulse_t;  // kg m/s
  std::int32_t i, j;            // entries of the Motion array
};

/// What a scene's contacts do. A switched-off effect equals its neutral coefficient to the last
/// bit: friction 0, restitution 0, and for rotation rim speeds that stay 0.
struct Effects {
  bool friction = true;
  bool rotation = true;
  bool restitution = true;
};

struct Material {
  double friction = 0.5;      // Coulomb's mu
  double restitution = 0.25;  // Newton's e: separation over approach velocity
};

/// Changes of one relaxation, as the relative velocities they stand for (m/s): W times the impulse.
struct Change {
  double normal, tangential;
};

/// Twice the rim-speed change per momentum: a disc's r^2/I is 2/m.
constexpr double disc_rim_factor = 2;

/// Makes one contact obey Signorini, Newton and Coulomb while its neighbours hold still. W_nt = 0
/// for discs, so normal and tangential parts have each their exact solution.
///
/// This is the law in one contact's words; sweep.cpp does the same to many at a time, operation by
/// operation, and tests hold the two together to the last bit. Limits are written as max and min
/// in the order of their arguments that also gives zeros the sign which vector instructions give.
template <Effects with>
inline Change relax(Contact& c, Motion& a, Motion& b, double friction)
{
  const double w_nn = a.inverse_mass + b.inverse_mass;
  const double dvx = a.vx - b.vx, dvy = a.vy - b.vy;
  const double separation = dvx * c.nx + dvy * c.ny;
  const double excess = with.restitution ? separation - c.rebound : separation;
  const double before_n = c.impulse_n;
  c.impulse_n = std::max(0.0, before_n - c.mass_n * excess);
  const double change_n = c.impulse_n - before_n;
  double px = change_n * c.nx, py = change_n * c.ny;

  Change change{std::abs(change_n) * w_nn, 0};
  if constexpr (with.friction) {
    const double lever = disc_rim_factor * c.kappa;
    double sliding = dvy * c.nx - dvx * c.ny;
    if constexpr (with.rotation) sliding -= c.kappa * (a.rim_speed + b.rim_speed);
    const double limit = friction * c.impulse_n;
    const double before_t = c.impulse_t;
    c.impulse_t = std::min(limit, std::max(-limit, before_t - c.mass_t * sliding));
    const double change_t = c.impulse_t - before_t;
    px -= change_t * c.ny;
    py += change_t * c.nx;
    if constexpr (with.rotation) {
      const double spin = lever * change_t;
      a.rim_speed -= a.inverse_mass * spin;
      b.rim_speed -= b.inverse_mass * spin;
    }
    const double w_tt = with.rotation ? w_nn * (1 + lever * c.kappa) : w_nn;
    change.tangential = std::abs(change_t) * w_tt;
  }
  a.vx += a.inverse_mass * px;
  a.vy += a.inverse_mass * py;
  b.vx -= b.inverse_mass * px;
  b.vy -= b.inverse_mass * py;
  return change;
}

using Relax = Change (*)(Contact&, Motion&, Motion&, double friction);

/// relax() of a scene's effects. Restitution needs no variant here: without it rebounds are ignored
/// by setting them 0.
inline Relax choose_relax(Effects e)
{
  // [friction][rotation]
  static constexpr Relax table[2][2] = {
      {relax<Effects{false, false, true}>, relax<Effects{false, true, true}>},
      {relax<Effects{true, false, true}>, relax<Effects{true, true, true}>}};
  return table[e.friction][e.rotation];
}

}  // namespace grseg
