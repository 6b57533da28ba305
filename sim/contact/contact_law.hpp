// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cmath>
#include <cstdint>

/// The contact laws: Signorini's condition, Newton's restitution and Coulomb's friction between
/// rigid discs or spheres, in Moreau's time stepping (Moreau, Eur. J. Mech. A 13, 93, 1994; Jean,
/// Comput. Methods Appl. Mech. Eng. 177, 235, 1999). This file states the laws in words and defines
/// their variables; contact_law-inl.hpp has the equations, for one pair or for one pair per vector
/// lane.
///
/// A step of length h leads from positions x and velocities v to v+ and x+ = x + h (v + v+)/2.
/// Contacts are found in the middle of the step, x_m = x + h v/2. For a pair i, j:
///
///   n         unit vector from j to i at mid-step (of a wall: its normal)
///   gap       |x_m,i - x_m,j| - (r_i + r_j), m; below 0 the grains overlap
///   u, u+     separation velocity n . (v_i - v_j) before and after the step, m/s
///   approach  -u; negative if the grains move apart
///   p_n, p_t  impulse on i over the step, along n and in the tangent plane, kg m/s. For discs p_t
///             is a number, along t = (-n_y, n_x); for spheres it is a vector in space
///   W         matrix of the changes of relative velocities by impulses; W_nn: of u by p_n
///
/// A pair "acts" in a step if the solver may apply an impulse to it. Every law requires of it:
///
///   Signorini and Newton  p_n >= 0,  u+ >= rebound,  p_n (u+ - rebound) = 0
///   Coulomb               |p_t| <= mu p_n; equal and opposite to the slip if the surfaces slide
///                         after the step
///
/// The laws differ in the condition to act, and in the rebound of pairs whose gap is still open:
///
///   acts      if the gap is at most `margin` after `forecast` more steps of free flight:
///             |x_m,i - x_m,j + forecast h (v_i - v_j)| <= r_i + r_j + margin
///   rebound   e times the approach before the step (Newton; e: restitution). So a pair that was
///             moving apart may come back with e times its velocity (Moreau). If `horizon` > 0, a
///             pair with gap > 0 is only slowed down, so that its gap lasts `horizon` steps:
///             rebound = -gap/(horizon h), or less if it was moving apart. Its approach is stored;
///             in the next step the pair rebounds with e times the stored approach.
///
/// So the contacts of a step without friction dissipate the energy (1 - e)/(1 + e) p.W p/2, p.W p
/// summed over all contacts (docs/studies/accuracy.md). If pairs that move apart did not come back,
/// a light grain that rattles between heavy ones would drive these apart.
///
/// A pair that had an impulse p_n in the previous step cannot approach if that step was solved
/// exactly. An approach below `solver_error` W_nn p_n is treated as an error of the solver: it is
/// stopped and does not rebound. Otherwise a bed at rest trembles for ever, and light grains lift
/// a heavy one above them. A separation below `parting_error` W_nn p_n is ignored alike. After an
/// impact p_n is not the impulse of the impact, which does not last, but at most twice the load
/// before it and a fall of one step (Simulation::lower_guesses()).
///
/// Overlap is not corrected: moving grains out of each other would add energy.
/// docs/studies/accuracy.md compares the laws in flows and impacts.
namespace grseg {

/// Conditions under which a pair acts. Delays of an isolated impact ("late", "early") are means
/// over the time within a step at which the grains touch; e is the coefficient of restitution.
enum class ContactLaw {
  /// A pair whose gap would close within `horizon` steps (0.75 by default) is slowed down, and
  /// rebounds in the next step. At the same step, overlap in flows is a quarter
  /// of the overlap by other laws.
  speculative,
  /// A pair acts if it touches at mid-step. Late by (1 + 1/e) h/2; overlap up to |u| h.
  touch,
  /// A pair acts if it would touch by the end of the step. On time; overlap up to |u| h/2.
  centred,
  /// A pair acts if it would touch half a step after the end. Early by (1 + 1/e) h/2.
  predictive
};

/// Parameters of a law, defined at the top of this file. The defaults are ContactLaw::touch.
struct LawParameters {
  double forecast = 0;  // steps of free flight after mid-step
  double margin = 0;    // m, largest gap after the forecast; at least least_margin d_min
  double horizon = 0;   // steps that an open gap lasts; 0: open pairs rebound like touching ones
};

/// Least margin, in smallest diameters d_min: a contact at rest must not lose its load because the
/// last digit of a position makes its gap positive.
constexpr double least_margin = 1e-9;

/// Largest approach, over W_nn p_n of the previous step, that is attributed to the solver's error.
/// Measured: from 0.003 on, beds come to rest to round-off; up to 0.01, overlap in flows is the
/// same (docs/studies/accuracy.md).
constexpr double solver_error = 0.01;

/// Largest separation velocity, over W_nn p_n of the previous step, that is attributed to the
/// solver's error. Measured: with 0, overlap in flows is 10 % larger; with 0.1 and 0.3 it is the
/// same as if no separating pair comes back.
constexpr double parting_error = 0.1;

/// Parameters of a law. No other place in sim depends on the name of the law;
/// analysis/check/laws_of_motion.cpp repeats the parameters for grseg-check. All arguments but
/// `law` are used by the speculative law alone: its margin is the distance that neighbours may push
/// a pair together within the horizon, at a velocity of sqrt(g d_S). `horizon` in steps, `step` in
/// s, `gravity` in m/s^2, `small_diameter` in m.
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

/// Components of a vector in D dimensions.
template <int D, class Number>
using Along = std::array<Number, D>;
/// A number for each axis that may be periodic: x, and in three dimensions z.
template <int D, class Number = double>
using Horizontal = std::array<Number, D - 1>;
/// A number for each axis across x: y, and in three dimensions z.
template <int D, class Number = double>
using Across = std::array<Number, D - 1>;
/// Components of an angular velocity or of a tangential impulse: one for discs (about z; along t),
/// three for spheres.
template <int D, class Number>
using Turning = std::array<Number, D == 2 ? 1 : 3>;

template <std::size_t n>
Eigen::Matrix<double, n, 1> vector_of(const std::array<double, n>& components)
{
  return Eigen::Matrix<double, n, 1>(components.data());
}

/// A rotation in components as an angular velocity, and the other way round.
template <int D>
Spin<D> spin_of(const Turning<D, double>& components)
{
  if constexpr (D == 2)
    return components[0];
  else
    return vector_of(components);
}
template <int D>
Turning<D, double> components_of(const Spin<D>& spin)
{
  if constexpr (D == 2)
    return {spin};
  else
    return {spin.x(), spin.y(), spin.z()};
}

/// Velocities and inverse mass of a grain, used by its contacts. With the rim velocity r*omega
/// instead of the angular velocity, the moment of inertia drops out of the equations. Aligned, so
/// that one load instruction reads four members.
template <int D, class Real>
struct MotionOf;
template <class Real>
struct alignas(4 * sizeof(Real)) MotionOf<2, Real> {
  Along<2, Real> v{};      // m/s, velocity of the centre
  Real inverse_mass = 0;   // 1/kg; 0 for grains and walls that contacts cannot move. In single
                           // precision always 0: masses are stored in the contacts, see Increments
  Turning<2, Real> rim{};  // m/s, radius times angular velocity
};
template <class Real>
struct alignas(8 * sizeof(Real)) MotionOf<3, Real> {
  Along<3, Real> v{};
  Real inverse_mass = 0;
  Turning<3, Real> rim{};
  Real unused = 0;
};
template <int D>
using Motion = MotionOf<D, double>;

/// A contact (a pair that acts), with its geometry at mid-step. The normal n points from j to i.
/// Impulses act ON i, over the whole step.
///
/// The lever arms are kappa r_i and kappa r_j, kappa = |x_i - x_j|/(r_i + r_j). They add up to the
/// distance of the centres, so that angular momentum is conserved for any gap.
///
/// Number is a double, or an array or a vector with one number per contact.
template <int D, class Number>
struct WholeImpulses {
  Along<D, Number> n;
  Number kappa;                  // lever arm over radius; 1 at a straight wall
  Number mass_n, mass_t;         // kg, effective masses 1/W_nn and 1/W_tt
  Number rebound;                // m/s, least separation velocity after the step
  Number impulse_n;              // kg m/s
  Turning<D, Number> impulse_t;  // kg m/s
};

/// A contact in single precision. Its impulses are increments on a `base` impulse, whose effect the
/// velocities already contain. Round-off is then relative to the change in a step, not to the load,
/// so that a bed at rest does not creep. Impulses are divided by mass_n, which makes them relative
/// velocities; weight_i is the fraction of it by which a body's velocity changes. So a relaxation
/// needs no mass, and its chain of operations is shorter.
template <int D, class Number>
struct Increments {
  Along<D, Number> n;
  Number kappa;
  Number weight_i, weight_j;  // mass_n over the mass of the body; 0 for an immobile body
  Number mass_ratio;          // mass_t/mass_n
  Number rebound;             // m/s, least separation velocity after the step
  Number base_n;              // first guess of the impulse over mass_n, m/s
  Turning<D, Number> base_t;
  Number impulse_n;  // increment of the impulse over mass_n, m/s
  Turning<D, Number> impulse_t;
};

template <int D>
struct Contact : WholeImpulses<D, double> {
  std::int32_t i, j;  // indices of the two bodies in the array of Motion
};

/// Effects that are computed at the contacts of a scene. Leaving out an effect produces the same
/// bits as its neutral coefficient: friction 0, restitution 0, and for rotation rim speeds of 0.
struct Effects {
  bool friction = true;
  bool rotation = true;
  bool restitution = true;
};

/// Calls use<flags...>() with run-time flags as template arguments: all combinations are compiled.
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

/// Result of relaxing a contact: change of the impulse, and impulse afterwards (`level`), along the
/// normal and the tangent. All are multiplied by W, which makes them relative velocities, m/s.
template <int D, class Number>
struct Relaxed {
  Number change_n, level_n;
  Turning<D, Number> change_t, level_t;
};

/// Ratio m r^2/I of a disc or sphere: a tangential impulse p_t changes rim velocities by
/// -rim_factor kappa n x p_t/m.
template <int D>
constexpr double rim_factor = 1 / inertia_factor<D>;

/// Function that makes one contact obey the law while all other contacts keep their impulses:
/// relax() in contact_law-inl.hpp.
template <int D>
using Relax = Relaxed<D, double> (*)(Contact<D>&, Motion<D>&, Motion<D>&, double friction);

/// Returns relax() compiled for `effects`. Restitution needs no variant here: callers without
/// restitution set rebounds to 0.
template <int D>
Relax<D> choose_relax(Effects effects);

}  // namespace grseg
