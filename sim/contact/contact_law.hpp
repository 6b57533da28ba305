// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

/// The contact laws: Signorini's condition, Newton's restitution and Coulomb's friction between
/// rigid discs, in Moreau's time stepping (Moreau, Eur. J. Mech. A 13, 93, 1994; Jean, Comput.
/// Methods Appl. Mech. Eng. 177, 235, 1999). This file has them in words, with their
/// variables; contact_law-inl.hpp has the equations, for one pair or as many as a vector has lanes.
///
/// A step of length h leads from positions x and velocities v to v+ and x+ = x + h (v + v+)/2.
/// Contacts are found in the middle of the step, x_m = x + h v/2. For a pair i, j:
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
/// The laws differ in which pairs act, and in the rebound of pairs that are still apart:
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
/// summed over all (docs/studies/accuracy.md). Without the return of parting pairs, a light grain
/// that rattles between heavy ones would drive them apart.
///
/// A pair that bore an impulse p_n in the step before cannot approach if that step was solved
/// exactly. An approach below `solver_error` W_nn p_n is taken for the error of the solver: it is
/// stopped and does not rebound. Otherwise a bed at rest trembles for ever, and light grains under
/// a heavy one lift it. So does a separation below `parting_error` W_nn p_n not return.
///
/// Overlap is never pushed out, so that no energy enters that way.
/// docs/studies/accuracy.md compares the laws in flows and impacts.
namespace grseg {

/// Conditions under which a pair acts. Delays are means over the phase of an isolated impact in the
/// step.
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

/// Numbers of a law, as defined above. The defaults are ContactLaw::touch.
struct LawParameters {
  double forecast = 0;  // steps, from mid-step on
  double margin = 0;    // m, at least least_margin times the smallest diameter
  double horizon = 0;   // steps; 0: pairs that are apart rebound like touching ones
};

/// A contact at rest must not be lost, and its load with it, because the last digit of a position
/// makes its gap positive. In smallest diameters.
constexpr double least_margin = 1e-9;

/// Approach of a pair that bore a load, over W_nn p_n of the step before, that the solver's error
/// may make. Measured: from 0.003 on beds come to rest to round-off, up to 0.01 overlap in flows is
/// the same (docs/studies/accuracy.md).
constexpr double solver_error = 0.01;

/// Separation of such a pair, likewise. Measured: with 0 overlap in flows is 10 % larger, with 0.1
/// and 0.3 it is the same as where nothing returns.
constexpr double parting_error = 0.1;

/// Parameters of a law: the only place in sim that decides what a law means;
/// analysis/check/contact_violations.cpp states the same for grseg-check. All arguments but `law`
/// matter to the speculative law alone: its margin is the part that neighbours may add to the
/// approach of a pair within the horizon, at a velocity of sqrt(g d_S). `horizon` in steps, `step`
/// in s, `gravity` in m/s^2, `small_diameter` in m.
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

/// Motion of a grain, as its contacts need it. With the rim speed r*omega in place of the angular
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
  float unused = 0;  // contacts know the masses, see Increments
};
using Motion = MotionOf<double>;

/// A pair that acts, seen from the middle of the step. The normal n points from j to i, the
/// tangent is t = (-ny, nx). Impulses act ON i and are in kg m/s, over the whole step.
///
/// The lever arms are kappa r_i and kappa r_j, kappa = |x_i - x_j|/(r_i + r_j), so that they add up
/// to the distance of the centres and angular momentum is conserved whatever the gap.
///
/// Number is a double, or an array or a vector of the numbers of several pairs.
template <class Number>
struct WholeImpulses {
  Number nx, ny;
  Number kappa;                 // 1 at a straight wall
  Number mass_n, mass_t;        // kg, effective masses 1/W_nn and 1/W_tt
  Number rebound;               // m/s, least separation velocity after the step
  Number impulse_n, impulse_t;  // kg m/s
};

/// A contact in single precision, where impulses are increments on a `base` that velocities already
/// contain. The last digit is then relative to the change in a step, not to the load, and a bed at
/// rest does not creep. Impulses are per mass_n: the relative velocities that they make, of which
/// each body takes the part that its weight says. So a relaxation needs no mass, and the chain of
/// its operations is shorter.
template <class Number>
struct Increments {
  Number nx, ny;
  Number kappa;
  Number weight_i, weight_j;    // mass_n over the mass of the body; 0 for one that cannot be moved
  Number mass_ratio;            // mass_t/mass_n
  Number rebound;               // m/s
  Number base_n, base_t;        // m/s
  Number impulse_n, impulse_t;  // m/s
};

struct Contact : WholeImpulses<double> {
  std::int32_t i, j;  // entries of the Motion array
};

/// Effects at the contacts of a scene. An effect left out gives the same bits as its neutral
/// coefficient: friction 0, restitution 0, and for rotation rim speeds that stay 0.
struct Effects {
  bool friction = true;
  bool rotation = true;
  bool restitution = true;
};

/// use<flags...>() of flags that are known when the program runs: all combinations are compiled.
template <bool... known, class Use>
auto with_flags(const Use& use)
{
  return use.template operator()<known...>();
}
template <bool... known, class Use, class... Others>
auto with_flags(const Use& use, bool flag, Others... others)
{
  return flag ? with_flags<known..., true>(use, others...)
              : with_flags<known..., false>(use, others...);
}

struct Material {
  double friction = 0.5;      // Coulomb's mu
  double restitution = 0.25;  // Newton's e: separation over approach velocity
};

/// Changes made by relaxing a contact, along the normal and the tangent, and the impulses after it;
/// both as the relative velocities they stand for (m/s): W times the impulse.
template <class Number>
struct Relaxed {
  Number change_n, level_n, change_t, level_t;
};

/// m r^2/I of a disc: a tangential impulse p_t changes rim speeds by -2 kappa p_t/m.
constexpr double disc_rim_factor = 2;

/// Makes one contact obey the law while its neighbours hold still; see relax() in
/// contact_law-inl.hpp.
using Relax = Relaxed<double> (*)(Contact&, Motion&, Motion&, double friction);

/// relax() of a scene's effects. Restitution needs no variant here: without it rebounds are ignored
/// by setting them 0.
Relax choose_relax(Effects effects);

}  // namespace grseg
