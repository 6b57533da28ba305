// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

/// The contact laws: Signorini's condition, Newton's restitution and Coulomb's friction between
/// rigid discs, in Moreau's time stepping (Moreau, Eur. J. Mech. A 13, 93, 1994; Jean, Comput.
/// Methods Appl. Mech. Eng. 177, 235, 1999). This file states them for a single pair;
/// contact_law-inl.hpp states the same for several pairs at a time, operation by operation, and
/// tests hold the two together to the last bit.
///
/// A step of length h leads from positions x and velocities v to v+ and x+ = x + h (v + v+)/2.
/// Contacts are those of the middle of the step, x_m = x + h v/2. For a pair i, j:
///
///   n, t      unit vector from j to i at mid-step (of a wall: its normal), and t = (-n_y, n_x)
///   gap       |x_m,i - x_m,j| - (r_i + r_j), m; below 0 the discs overlap
///   u, u+     separation velocity n . (v_i - v_j) before and after the step, m/s
///   approach  -u; below 0 the pair was parting
///   p_n, p_t  impulse on i over the step, along n and t, kg m/s
///
/// Every law demands of a pair that acts in a step:
///
///   Signorini and Newton  p_n >= 0,  u+ >= rebound,  p_n (u+ - rebound) = 0
///   Coulomb               |p_t| <= mu p_n; equal where the surfaces slide after the step
///
/// The laws differ in which pairs act, and in the rebound of those that are still apart:
///
///   acts      if the gap is at most `margin` after `forecast` more steps of free flight:
///             |x_m,i - x_m,j + forecast h (v_i - v_j)| <= r_i + r_j + margin
///   rebound   e approach, from the velocity before the step (Newton); so a pair that was parting
///             may come back with e times its velocity (Moreau). If `horizon` > 0, a pair with
///             gap > 0 is only slowed down, so that its gap lasts `horizon` steps: rebound =
///             -gap/(horizon h), or less if it was parting. Its approach is remembered, and in the
///             next step it rebounds with e times that.
///
/// So the contacts of a step without friction take (1 - e)/(1 + e) p.W p/2 from the energy, p.W p
/// summed over all (docs/studies/numerics.md). Without the return of parting pairs, a light grain
/// that rattles between heavy ones would drive them apart.
///
/// A pair that bore an impulse p_n in the step before cannot approach if that step was solved
/// exactly. An approach below `solver_error` W_nn p_n is taken for the error of the solver: it is
/// stopped and does not rebound. Otherwise a bed at rest trembles for ever, and light grains under a
/// heavy one lift it. So does a separation below `parting_error` W_nn p_n not return.
///
/// Overlap is never pushed out, so that no energy enters that way.
/// docs/studies/numerics.md compares the laws in flows and impacts.
namespace grseg {

/// When a pair acts. Delays are those of an isolated impact, averaged over its phase in the step.
enum class ContactLaw {
  /// A pair that would close its gap within `horizon` steps (0.75 by default) is slowed down, and
  /// rebounds in the next step. Overlap in flows is a quarter of the others' at the same step.
  speculative,
  /// A pair that touches at mid-step. Late by (1 + 1/e) h/2; overlap up to |u| h.
  touch,
  /// A pair that will have touched by the end of the step. On time; overlap up to |u| h/2.
  centred,
  /// A pair that will have touched half a step later. Early by (1 + 1/e) h/2.
  predictive
};

/// The numbers a law amounts to; see above. Without a choice, those of ContactLaw::touch.
struct LawParameters {
  double forecast = 0;  // steps, from mid-step on
  double margin = 0;    // m, at least least_margin times the smallest diameter
  double horizon = 0;   // steps; 0: pairs that are apart rebound like those that touch
};

/// A contact at rest must not be lost, and its load with it, because the last digit of a position
/// makes its gap positive. In smallest diameters.
constexpr double least_margin = 1e-9;

/// Approach of a pair that bore a load, over W_nn p_n of the step before, that the solver's error may
/// make. Measured: from 0.003 on beds come to rest to round-off, up to 0.01 overlap in flows is
/// the same (docs/studies/numerics.md).
constexpr double solver_error = 0.01;

/// Separation of such a pair, likewise. Measured: with 0 overlap in flows is 10 % larger, with 0.1 and
/// 0.3 it is the same as where nothing returns.
constexpr double parting_error = 0.1;

/// The only place in sim that decides what a law means; analysis/check/contact_rules.cpp states the
/// same for grseg-check. All but `law` matter to the speculative law alone: its margin is what
/// neighbours may add to the approach of a pair within the horizon, at a velocity of sqrt(g d_S).
/// `horizon` in steps, `step` in s, `gravity` in m/s^2, `small_diameter` in m.
inline LawParameters law_parameters(ContactLaw law, double horizon, double step, double gravity,
                                    double small_diameter)
{
  switch (law) {
    case ContactLaw::speculative:
      return {horizon, horizon * step * std::sqrt(gravity * small_diameter), horizon};
    case ContactLaw::touch:
      return {.forecast = 0};
    case ContactLaw::centred:
      return {.forecast = 0.5};
    case ContactLaw::predictive:
      return {.forecast = 1};
  }
  return {};
}

/// What a contact needs to know of a grain. With the rim speed r*omega in place of the angular
/// velocity the moment of inertia of a disc, m r^2/2, leaves the equations. Aligned, so that one
/// load fetches it.
template <class Real>
struct alignas(4 * sizeof(Real)) MotionOf {
  Real vx = 0, vy = 0;    // m/s
  Real rim_speed = 0;     // m/s, radius times angular velocity (counter-clockwise)
  Real inverse_mass = 0;  // 1/kg; 0 for grains and walls that contacts cannot move
};
template <>
struct alignas(4 * sizeof(float)) MotionOf<float> {
  float vx = 0, vy = 0, rim_speed = 0;
  float unused = 0;  // contacts know the masses, see ContactOf<float>
};
using Motion = MotionOf<double>;

/// A pair that acts, seen from the middle of the step. The normal n points from j to i, the
/// tangent is t = (-ny, nx). Impulses are those ON i, in kg m/s, over the whole step.
///
/// The lever arms are kappa r_i and kappa r_j, kappa = |x_i - x_j|/(r_i + r_j), so that they add up
/// to the distance of the centres and angular momentum is conserved whatever the gap.
template <class Real>
struct ContactOf {
  Real nx, ny;
  Real kappa;                 // 1 at a straight wall
  Real mass_n, mass_t;        // kg, effective masses 1/W_nn and 1/W_tt
  Real rebound;               // m/s, least separation velocity after the step
  Real impulse_n, impulse_t;  // kg m/s
  std::int32_t i, j;          // entries of the Motion array
};
using Contact = ContactOf<double>;

/// In single precision impulses are increments on a `base`, which velocities contain already: the
/// last digit is then one of what a step changes, not one of the load, and a bed at rest does not
/// creep. They are per mass_n: the relative velocities that they make, of which each body takes the part
/// that its weight says. So a relaxation needs no mass, and the chain of its operations is shorter.
template <>
struct ContactOf<float> {
  float nx, ny;
  float kappa;
  float weight_i, weight_j;    // mass_n over the mass of the body; 0 for one that cannot be moved
  float mass_ratio;            // mass_t/mass_n
  float rebound;               // m/s
  float base_n, base_t;        // m/s
  float impulse_n, impulse_t;  // m/s
  std::int32_t i, j;
};

/// What the contacts of a scene do. An effect left out gives the same bits as its neutral
/// coefficient: friction 0, restitution 0, and for rotation rim speeds that stay 0.
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
template <class Real>
struct ChangeOf {
  Real normal, tangential;
};
using Change = ChangeOf<double>;

/// m r^2/I of a disc: a tangential impulse p_t changes rim speeds by -2 kappa p_t/m.
constexpr double disc_rim_factor = 2;

/// Whether two discs act whose centres are (dx, dy) apart after the forecast, m; reach = r_i + r_j.
inline bool acts(double dx, double dy, double reach, double margin)
{
  const double limit = reach + margin;
  return dx * dx + dy * dy <= limit * limit;
}

/// Whether a disc acts whose centre is then at `distance` from a wall, m; `reach` is its radius.
inline bool acts_on_wall(double distance, double reach, double margin)
{
  return distance <= reach + margin;
}

/// Unit vector from j to i, and the distance, m, of the centres: gap = distance - reach.
struct Normal {
  double nx, ny, distance;
};

/// Of two discs whose centres are (dx, dy) apart at mid-step, m.
inline Normal normal_of_discs(double dx, double dy)
{
  const double distance = std::sqrt(dx * dx + dy * dy), inverse = 1 / distance;
  return {dx * inverse, dy * inverse, distance};
}

/// Of a disc whose centre lies (dx, dy) from a point of a wall with normal (nx, ny).
inline Normal normal_of_wall(double dx, double dy, double nx, double ny)
{
  return {nx, ny, dx * nx + dy * ny};
}

/// Effective masses 1/W_nn and 1/W_tt, kg. W_nt = 0 for discs.
inline double normal_mass(double inverse_mass_i, double inverse_mass_j)
{
  return 1 / (inverse_mass_i + inverse_mass_j);
}
inline double tangential_mass(double normal_mass, double kappa)
{
  return normal_mass / (1 + disc_rim_factor * (kappa * kappa));
}

/// What a pair that acts must reach, and what it has to remember.
struct Rebound {
  double velocity;    // m/s, least separation velocity after the step
  double remembered;  // m/s, approach of a pair that is only slowed down; counts if it gets p_n > 0
};

/// -separation (m/s), or 0 where the error of the solver may have made it; `load` = W_nn p_n (m/s).
inline double fresh_approach(double separation, double load)
{
  const double error = (separation > 0 ? parting_error : solver_error) * load;
  return std::abs(separation) > error ? -separation : 0;
}

/// `gap` (m) at mid-step, `separation` (m/s) before the step; `load` = W_nn p_n (m/s) and
/// `remembered` are what the step before left behind, 0 for a pair that did not act. `horizon` in s.
inline Rebound rebound_of(double gap, double separation, double load, double remembered,
                          double restitution, double horizon)
{
  const bool already_slowed_down = remembered > 0;
  const double fresh = fresh_approach(separation, load);
  const double approach = already_slowed_down ? std::max(remembered, fresh) : fresh;
  const double newton = restitution * approach + 0.0;  // never -0, which e = 0 would make
  if (horizon == 0 || !(gap > 0) || already_slowed_down) return {newton, 0};
  const double closing = -gap / horizon;
  // A pair that bore a load has lost its approach before.
  const bool newcomer = load == 0 && separation < closing;
  return {std::min(closing, newton), newcomer ? approach : 0};
}

/// Adds the impulse (px, py) times their weights to a and takes it from b; `spin` is taken from both.
template <Effects with, class Real>
inline void push(MotionOf<Real>& a, MotionOf<Real>& b, Real weight_a, Real weight_b, Real px,
                 Real py, Real spin)
{
  if constexpr (with.friction && with.rotation) {
    a.rim_speed -= weight_a * spin;
    b.rim_speed -= weight_b * spin;
  }
  a.vx += weight_a * px;
  a.vy += weight_a * py;
  b.vx -= weight_b * px;
  b.vy -= weight_b * py;
}

/// Makes one contact obey Signorini, Newton and Coulomb while its neighbours hold still. W_nt = 0
/// for discs, so normal and tangential parts have each their exact solution.
///
/// Limits are written as max and min in the order of their arguments that also gives zeros the sign
/// which vector instructions give.
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
  double px = change_n * c.nx, py = change_n * c.ny, spin = 0;

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
    spin = lever * change_t;
    const double w_tt = with.rotation ? w_nn * (1 + lever * c.kappa) : w_nn;
    change.tangential = std::abs(change_t) * w_tt;
  }
  push<with>(a, b, a.inverse_mass, b.inverse_mass, px, py, spin);
  return change;
}

/// The same in single precision, see ContactOf<float>. Sums are in the order that makes the chain of
/// operations on velocities shortest.
template <Effects with>
inline ChangeOf<float> relax(ContactOf<float>& c, MotionOf<float>& a, MotionOf<float>& b,
                             float friction)
{
  const float dvx = a.vx - b.vx, dvy = a.vy - b.vy;
  const float separation = dvx * c.nx + dvy * c.ny;
  const float before_n = c.impulse_n, aim = with.restitution ? before_n + c.rebound : before_n;
  c.impulse_n = std::max(-c.base_n, aim - separation);
  const float change_n = c.impulse_n - before_n;
  float px = change_n * c.nx, py = change_n * c.ny, spin = 0;

  ChangeOf<float> change{std::abs(change_n), 0};
  if constexpr (with.friction) {
    const float lever = float{disc_rim_factor} * c.kappa;
    float sliding = dvy * c.nx - dvx * c.ny;
    if constexpr (with.rotation) sliding -= c.kappa * (a.rim_speed + b.rim_speed);
    const float held = friction * c.base_n, more = friction * c.impulse_n;
    const float lowest = (-held - c.base_t) - more, highest = (held - c.base_t) + more;
    const float before_t = c.impulse_t;
    c.impulse_t = std::min(highest, std::max(lowest, before_t - c.mass_ratio * sliding));
    const float change_t = c.impulse_t - before_t;
    px -= change_t * c.ny;
    py += change_t * c.nx;
    spin = lever * change_t;
    change.tangential =
        with.rotation ? std::abs(change_t) * (1 + lever * c.kappa) : std::abs(change_t);
  }
  push<with>(a, b, c.weight_i, c.weight_j, px, py, spin);
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
