// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

/// Signorini's condition, Newton's restitution and Coulomb's friction for one contact of two discs
/// (Moreau 1994, Jean 1999), in the form in which the local problem has an exact solution.
namespace grseg {

/// What a contact needs to know of a grain, 32 bytes. With the rim speed r*omega in place of the
/// angular velocity the moment of inertia of a disc, m r^2/2, leaves the equations.
struct Motion {
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

/// Changes of one relaxation, as the relative velocities they stand for (m/s).
struct Change {
  double normal, tangential;
};

/// Twice the rim-speed change per momentum: a disc's r^2/I is 2/m.
constexpr double disc_rim_factor = 2;

/// Makes one contact obey Signorini, Newton and Coulomb while its neighbours hold still. W_nt = 0
/// for discs, so normal and tangential parts have each their exact solution.
template <Effects with>
inline Change relax(Contact& c, Motion& a, Motion& b, double friction)
{
  const double dvx = a.vx - b.vx, dvy = a.vy - b.vy;
  const double separation = dvx * c.nx + dvy * c.ny;
  const double target = with.restitution ? c.rebound : 0;
  const double before_n = c.impulse_n;
  c.impulse_n = std::max(0.0, before_n - c.mass_n * (separation - target));
  const double change_n = c.impulse_n - before_n;

  double change_t = 0;
  if constexpr (with.friction) {
    double sliding = dvy * c.nx - dvx * c.ny;
    if constexpr (with.rotation) sliding -= c.kappa * (a.rim_speed + b.rim_speed);
    const double limit = friction * c.impulse_n;
    const double before_t = c.impulse_t;
    c.impulse_t = std::clamp(before_t - c.mass_t * sliding, -limit, limit);
    change_t = c.impulse_t - before_t;
    if constexpr (with.rotation) {
      const double spin = disc_rim_factor * c.kappa * change_t;
      a.rim_speed -= a.inverse_mass * spin;
      b.rim_speed -= b.inverse_mass * spin;
    }
  }
  const double px = change_n * c.nx - change_t * c.ny;
  const double py = change_n * c.ny + change_t * c.nx;
  a.vx += a.inverse_mass * px;
  a.vy += a.inverse_mass * py;
  b.vx -= b.inverse_mass * px;
  b.vy -= b.inverse_mass * py;
  return {std::abs(change_n) / c.mass_n, std::abs(change_t) / c.mass_t};
}

}  // namespace grseg
