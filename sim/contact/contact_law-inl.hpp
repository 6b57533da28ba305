// SPDX-License-Identifier: GPL-3.0-or-later

// Equations of the contact law, see contact_law.hpp. V is a number, or a vector with one number per
// pair. Compiled once per instruction set, by files that include themselves for that purpose
// (hwy/foreach_target.h).
#if defined(GRSEG_SIM_CONTACT_LAW) == defined(HWY_TARGET_TOGGLE)
#ifdef GRSEG_SIM_CONTACT_LAW
#undef GRSEG_SIM_CONTACT_LAW
#else
#define GRSEG_SIM_CONTACT_LAW
#endif

#include "sim/contact/bodies-inl.hpp"
#include "sim/contact/contact_law.hpp"

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// True for two discs that act. (dx, dy): vector between their centres after `forecast` steps of
/// free flight (contact_law.hpp), m; reach = r_i + r_j.
template <class V>
HWY_INLINE auto acts(V dx, V dy, V reach, V margin)
{
  const V limit = reach + margin;
  return dx * dx + dy * dy <= limit * limit;
}

/// True for a disc that acts on a wall. `distance` of its centre from the wall after `forecast`
/// steps of free flight, m; `reach` is its radius.
template <class V>
HWY_INLINE auto acts_on_wall(V distance, V reach, V margin)
{
  return distance <= reach + margin;
}

/// Unit vector from j to i, and distance of the centres, m: gap = distance - reach.
template <class V>
struct Normal {
  V nx, ny, distance;
};

/// Normal of two discs. (dx, dy): vector between their centres at mid-step, m. The result is
/// arbitrary but finite if `used` is false.
template <class V>
HWY_INLINE Normal<V> normal_of_discs(V dx, V dy, MaskOf<V> used)
{
  const V one = number<V>(1), distance = root(dx * dx + dy * dy);
  const V inverse = one / choose(used, distance, one);
  return {dx * inverse, dy * inverse, distance};
}

/// Normal of a disc at a wall with normal (nx, ny). (dx, dy): vector from a point of the wall to
/// the centre of the disc, m.
template <class V>
HWY_INLINE Normal<V> normal_of_wall(V dx, V dy, V nx, V ny)
{
  return {nx, ny, dx * nx + dy * ny};
}

/// Effective masses 1/W_nn (from the sum of inverse masses; 0 if `used` is false) and 1/W_tt, kg;
/// W_nt = 0 for discs.
template <class V>
HWY_INLINE V normal_mass(V inverse_masses, MaskOf<V> used)
{
  const V one = number<V>(1);
  return choose(used, one / choose(used, inverse_masses, one));
}
template <class V>
HWY_INLINE V tangential_mass(V normal_mass, V kappa, double rim_factor = disc_rim_factor)
{
  return normal_mass / (number<V>(1) + number<V>(rim_factor) * (kappa * kappa));
}

/// Approach, -separation (m/s), or 0 if it may be an error of the solver; `load` = W_nn p_n (m/s).
template <class V>
HWY_INLINE V fresh_approach(V separation, V load)
{
  const V error =
      choose(separation > number<V>(0), number<V>(parting_error), number<V>(solver_error));
  return choose(magnitude(separation) > error * load, minus(separation));
}

/// Separation velocity that an acting pair must reach, and the approach stored for the next step.
template <class V>
struct Rebound {
  V velocity;    // m/s, least separation velocity after the step
  V remembered;  // m/s, approach of a pair that is only slowed down; stored if p_n > 0
};

/// `gap` (m) at mid-step, `separation` (m/s) before the step; `load` = W_nn p_n (m/s) and
/// `remembered` (Rebound, m/s) are results of the previous step, 0 for a pair that did not act.
/// `horizon` in s. Without `with_restitution` e is 0; without `with_horizon` the horizon is 0.
template <bool with_restitution, bool with_horizon, class V>
HWY_INLINE Rebound<V> rebound_of(V gap, V separation, V load, V remembered, double restitution,
                                 double horizon)
{
  const V zero = number<V>(0);
  const auto already_slowed_down = remembered > zero;
  V approach = fresh_approach(separation, load);
  if constexpr (with_horizon)
    approach = choose(already_slowed_down, larger(remembered, approach), approach);
  // Adding zero turns -0, the product for e = 0, into 0.
  const V newton = with_restitution ? number<V>(restitution) * approach + zero : zero;
  if constexpr (!with_horizon) return {newton, zero};
  const V closing = minus(gap) / number<V>(horizon);
  const auto slowed_down_now = but_not(gap > zero, already_slowed_down);
  // A pair with a load has lost its approach in an earlier step.
  const auto newcomer = both(load == zero, separation < closing);
  return {choose(slowed_down_now, smaller(closing, newton), newton),
          choose(both(slowed_down_now, newcomer), approach)};
}

/// Ratio W_tt/W_nn of discs that may rotate.
template <class V>
HWY_INLINE V w_ratio(V kappa)
{
  return number<V>(1) + number<V>(disc_rim_factor) * kappa * kappa;
}

/// Effect of impulses along the normal and the tangent. Multiplied by the inverse mass of the body,
/// (px, py) is added to the velocity of i and subtracted from the velocity of j, and `spin` is
/// subtracted from both rim speeds.
template <class V>
struct Push {
  V px, py, spin;
};
template <Effects with, class V>
HWY_INLINE Push<V> push_of(V nx, V ny, V kappa, V normal, V tangential)
{
  Push<V> p{normal * nx, normal * ny, number<V>(0)};
  if constexpr (with.friction) {
    p.px = p.px - tangential * ny;
    p.py = p.py + tangential * nx;
  }
  if constexpr (with.friction && with.rotation)
    p.spin = number<V>(disc_rim_factor) * kappa * tangential;
  return p;
}
template <Effects with, class Body, class V>
HWY_INLINE void push(Body& a, Body& b, V weight_a, V weight_b, const Push<V>& p)
{
  if constexpr (with.friction && with.rotation) {
    a.rim_speed = a.rim_speed - weight_a * p.spin;
    b.rim_speed = b.rim_speed - weight_b * p.spin;
  }
  a.vx = a.vx + weight_a * p.px;
  a.vy = a.vy + weight_a * p.py;
  b.vx = b.vx - weight_b * p.px;
  b.vy = b.vy - weight_b * p.py;
}

/// Tangential velocity of the surface of i relative to the surface of j, m/s; friction opposes it.
template <Effects with, class Contacts, class Body, class V>
HWY_INLINE V sliding_of(const Contacts& c, const Body& a, const Body& b, V dvx, V dvy)
{
  const V sliding = dvy * c.nx - dvx * c.ny;
  if constexpr (!with.rotation) return sliding;
  return sliding - c.kappa * (a.rim_speed + b.rim_speed);
}

/// Least and largest impulse along a tangent.
template <class V>
struct Limits {
  V least, most;
};

// The law for WholeImpulses, then for Increments. The order of each sum makes the chain of
// operations on velocities as short as possible.

/// Normal impulse that would make the separation velocity equal to the rebound.
template <Effects with, class V>
HWY_INLINE V rebounding(const WholeImpulses<V>& c, V separation)
{
  const V excess = with.restitution ? separation - c.rebound : separation;
  return c.impulse_n - c.mass_n * excess;
}
template <class V>
HWY_INLINE V least_impulse(const WholeImpulses<V>&)
{
  return number<V>(0);
}
/// Tangential impulse that would stop sliding; then Coulomb's limits.
template <class V>
HWY_INLINE V sticking(const WholeImpulses<V>& c, V sliding)
{
  return c.impulse_t - c.mass_t * sliding;
}
template <class V>
HWY_INLINE Limits<V> cone(const WholeImpulses<V>& c, V friction)
{
  const V limit = friction * c.impulse_n;
  return {minus(limit), limit};
}
template <Effects with, class Body, class V>
HWY_INLINE void push(const WholeImpulses<V>&, Body& a, Body& b, const Push<V>& p)
{
  push<with>(a, b, a.inverse_mass, b.inverse_mass, p);
}
template <Effects with, class Body, class V>
HWY_INLINE Relaxed<V> relaxed(const WholeImpulses<V>& c, const Body& a, const Body& b, V change_n,
                              V change_t)
{
  const V w_nn = a.inverse_mass + b.inverse_mass;
  const V w_tt = with.rotation ? w_nn * w_ratio(c.kappa) : w_nn;
  return {magnitude(change_n) * w_nn, c.impulse_n * w_nn, magnitude(change_t) * w_tt,
          c.impulse_t * w_tt};
}

template <Effects with, class V>
HWY_INLINE V rebounding(const Increments<V>& c, V separation)
{
  const V aim = with.restitution ? c.impulse_n + c.rebound : c.impulse_n;
  return aim - separation;
}
template <class V>
HWY_INLINE V least_impulse(const Increments<V>& c)
{
  return minus(c.base_n);
}
template <class V>
HWY_INLINE V sticking(const Increments<V>& c, V sliding)
{
  return c.impulse_t - c.mass_ratio * sliding;
}
template <class V>
HWY_INLINE Limits<V> cone(const Increments<V>& c, V friction)
{
  const V held = friction * c.base_n, more = friction * c.impulse_n;
  return {(minus(held) - c.base_t) - more, (held - c.base_t) + more};
}
template <Effects with, class Body, class V>
HWY_INLINE void push(const Increments<V>& c, Body& a, Body& b, const Push<V>& p)
{
  push<with>(a, b, c.weight_i, c.weight_j, p);
}
template <Effects with, class Body, class V>
HWY_INLINE Relaxed<V> relaxed(const Increments<V>& c, const Body&, const Body&, V change_n,
                              V change_t)
{
  const V t = magnitude(change_t), level_t = c.base_t + c.impulse_t, ratio = w_ratio(c.kappa);
  return {magnitude(change_n), c.base_n + c.impulse_n, with.rotation ? t * ratio : t,
          with.rotation ? level_t * ratio : level_t};
}

/// Makes the contact of a and b obey Signorini, Newton and Coulomb while all other contacts keep
/// their impulses. W_nt = 0 for discs, so both components are solved exactly, the normal one first.
template <Effects with, class Contacts, class Body, class V>
HWY_INLINE Relaxed<V> relax(Contacts& c, Body& a, Body& b, V friction)
{
  const V dvx = a.vx - b.vx, dvy = a.vy - b.vy;
  const V before_n = c.impulse_n, before_t = c.impulse_t;
  c.impulse_n = larger(rebounding<with>(c, dvx * c.nx + dvy * c.ny), least_impulse(c));
  if constexpr (with.friction) {
    const V sliding = sliding_of<with>(c, a, b, dvx, dvy);
    const auto [least, most] = cone(c, friction);
    c.impulse_t = smaller(larger(sticking(c, sliding), least), most);
  }
  const V change_n = c.impulse_n - before_n, change_t = c.impulse_t - before_t;
  const auto p = push_of<with>(c.nx, c.ny, c.kappa, change_n, change_t);
  push<with>(c, a, b, p);
  return relaxed<with>(c, a, b, change_n, change_t);
}

/// Loads as many contacts of a block as a vector has lanes, from `lane` on.
HWY_INLINE WholeImpulses<Vector> load(const ContactBlock& b, std::size_t lane)
{
  return {load(b.nx, lane),        load(b.ny, lane),       load(b.kappa, lane),
          load(b.mass_n, lane),    load(b.mass_t, lane),   load(b.rebound, lane),
          load(b.impulse_n, lane), load(b.impulse_t, lane)};
}
HWY_INLINE Increments<hn::Vec<TagOf<float>>> load(const BlockOf<float>& b, std::size_t lane)
{
  return {load(b.nx, lane),        load(b.ny, lane),       load(b.kappa, lane),
          load(b.weight_i, lane),  load(b.weight_j, lane), load(b.mass_ratio, lane),
          load(b.rebound, lane),   load(b.base_n, lane),   load(b.base_t, lane),
          load(b.impulse_n, lane), load(b.impulse_t, lane)};
}

/// Calls use<with>() with the effects that applying impulses depends on: friction and rotation.
template <class Use>
HWY_INLINE void with_effects(Effects e, const Use& use)
{
  if (!e.friction)
    use.template operator()<Effects{false, false, false}>();
  else if (!e.rotation)
    use.template operator()<Effects{true, false, false}>();
  else
    use.template operator()<Effects{true, true, false}>();
}

/// Applies impulses, along normals and tangents, to the bodies of the contacts from `lane` on.
template <Effects with>
HWY_INLINE void apply(const ContactBlock& c, std::size_t lane, Vector normal, Vector tangential,
                      double* motion)
{
  const auto p =
      push_of<with>(load(c.nx, lane), load(c.ny, lane), load(c.kappa, lane), normal, tangential);
  push_bodies(D(), p.px, p.py, p.spin, motion, &c.i[lane], &c.j[lane]);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#endif
