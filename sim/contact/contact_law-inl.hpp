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

/// True for two grains that act. `apart`: vector between their centres after `forecast` steps of
/// free flight (contact_law.hpp), m; reach = r_i + r_j.
template <class V, std::size_t D>
HWY_INLINE auto acts(const std::array<V, D>& apart, V reach, V margin)
{
  const V limit = reach + margin;
  return dot(apart, apart) <= limit * limit;
}

/// True for a grain that acts on a wall. `distance` of its centre from the wall after `forecast`
/// steps of free flight, m; `reach` is its radius.
template <class V>
HWY_INLINE auto acts_on_wall(V distance, V reach, V margin)
{
  return distance <= reach + margin;
}

/// Unit vector from j to i, and distance of the centres, m: gap = distance - reach.
template <int D, class V>
struct Normal {
  Along<D, V> n;
  V distance;
};

/// Normal of two grains. `apart`: vector between their centres at mid-step, m. The result is
/// arbitrary but finite if `used` is false.
template <class V, std::size_t D>
HWY_INLINE Normal<D, V> normal_of_grains(const std::array<V, D>& apart, MaskOf<V> used)
{
  const V one = number<V>(1), distance = root(dot(apart, apart));
  const V inverse = one / choose(used, distance, one);
  return {inverse * apart, distance};
}

/// Normal of a grain at a wall with normal n. `apart`: vector from a point of the wall to the
/// centre of the grain, m.
template <class V, std::size_t D>
HWY_INLINE Normal<D, V> normal_of_wall(const std::array<V, D>& apart, const std::array<V, D>& n)
{
  return {n, dot(apart, n)};
}

/// Effective masses 1/W_nn (from the sum of inverse masses; 0 if `used` is false) and 1/W_tt, kg;
/// W_nt = 0 for discs and spheres.
template <class V>
HWY_INLINE V normal_mass(V inverse_masses, MaskOf<V> used)
{
  const V one = number<V>(1);
  return choose(used, one / choose(used, inverse_masses, one));
}
template <class V>
HWY_INLINE V tangential_mass(V normal_mass, V kappa, double factor)
{
  return normal_mass / (number<V>(1) + number<V>(factor) * (kappa * kappa));
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

/// Ratio W_tt/W_nn of grains that may rotate.
template <int D, class V>
HWY_INLINE V w_ratio(V kappa)
{
  return number<V>(1) + number<V>(rim_factor<D>) * kappa * kappa;
}

// The following functions differ between discs and spheres. A tangential vector of discs has one
// component, along t = (-n_y, n_x).

/// The part of `velocity` in the tangent plane; `along_n` is its part along n.
template <class V>
HWY_INLINE Turning<2, V> tangential_part(const Along<2, V>& velocity, const Along<2, V>& n, V)
{
  return {velocity[1] * n[0] - velocity[0] * n[1]};
}
template <class V>
HWY_INLINE Turning<3, V> tangential_part(const Along<3, V>& velocity, const Along<3, V>& n,
                                         V along_n)
{
  return velocity - along_n * n;
}
/// rim x n: velocity of a surface point that rotates, in the tangent plane.
template <class V>
HWY_INLINE Turning<2, V> turned(const Turning<2, V>& rim, const Along<2, V>&)
{
  return rim;
}
template <class V>
HWY_INLINE Turning<3, V> turned(const Turning<3, V>& rim, const Along<3, V>& n)
{
  return cross(rim, n);
}
/// n x tangential. A tangential impulse changes the rim velocities of both bodies along this
/// vector, with a negative factor.
template <class V>
HWY_INLINE Turning<2, V> turning(const Along<2, V>&, const Turning<2, V>& tangential)
{
  return tangential;
}
template <class V>
HWY_INLINE Turning<3, V> turning(const Along<3, V>& n, const Turning<3, V>& tangential)
{
  return cross(n, tangential);
}
/// normal n + tangential, in space.
template <class V>
HWY_INLINE Along<2, V> in_space(const Along<2, V>& n, V normal, const Turning<2, V>& tangential)
{
  return {normal * n[0] - tangential[0] * n[1], normal * n[1] + tangential[0] * n[0]};
}
template <class V>
HWY_INLINE Along<3, V> in_space(const Along<3, V>& n, V normal, const Turning<3, V>& tangential)
{
  return normal * n + tangential;
}

/// `vector`, shortened to the length `most` if it is longer.
template <class V>
HWY_INLINE Turning<2, V> within(const Turning<2, V>& vector, V most)
{
  return {smaller(larger(vector[0], minus(most)), most)};
}
template <class V>
HWY_INLINE Turning<3, V> within(const Turning<3, V>& vector, V most)
{
  const V squared = dot(vector, vector), one = number<V>(1);
  const auto longer = squared > most * most;
  return choose(longer, most / root(choose(longer, squared, one)), one) * vector;
}

/// Removes from a tangential impulse its part along n. Impulses of the previous step lie in that
/// step's tangent plane, and rounding in single precision leaves the plane.
template <class V>
HWY_INLINE Turning<2, V> in_plane(const Turning<2, V>& t, const Along<2, V>&)
{
  return t;
}
template <class V>
HWY_INLINE Turning<3, V> in_plane(const Turning<3, V>& t, const Along<3, V>& n)
{
  return t - dot(t, n) * n;
}

/// Effect of impulses along the normal and the tangent. Multiplied by the inverse mass of the body,
/// `p` is added to the velocity of i and subtracted from the velocity of j, and `spin` is
/// subtracted from both rim velocities.
template <int D, class V>
struct Push {
  Along<D, V> p;
  Turning<D, V> spin;
};
template <Effects with, class V, std::size_t D, std::size_t T>
HWY_INLINE Push<D, V> push_of(const std::array<V, D>& n, V kappa, V normal,
                              const std::array<V, T>& tangential)
{
  if constexpr (!with.friction) return {normal * n, number<V>(0) * tangential};
  const auto p = in_space(n, normal, tangential);
  if constexpr (!with.rotation) return {p, number<V>(0) * tangential};
  return {p, (number<V>(rim_factor<D>) * kappa) * turning(n, tangential)};
}
template <Effects with, class Body, int D, class V>
HWY_INLINE void push(Body& a, Body& b, V weight_a, V weight_b, const Push<D, V>& p)
{
  if constexpr (with.friction && with.rotation) {
    a.rim = a.rim - weight_a * p.spin;
    b.rim = b.rim - weight_b * p.spin;
  }
  a.v = a.v + weight_a * p.p;
  b.v = b.v - weight_b * p.p;
}

/// Tangential velocity of the surface of i relative to the surface of j, m/s; friction opposes it.
/// `dv`: relative velocity of the centres, and `separation` its part along n.
template <Effects with, class Contacts, class Body, class V, std::size_t D>
HWY_INLINE Turning<D, V> sliding_of(const Contacts& c, const Body& a, const Body& b,
                                    const std::array<V, D>& dv, V separation)
{
  const auto sliding = tangential_part(dv, c.n, separation);
  if constexpr (!with.rotation) return sliding;
  return sliding - c.kappa * turned(a.rim + b.rim, c.n);
}

// The law for WholeImpulses, then for Increments. The order of each sum makes the chain of
// operations on velocities as short as possible.

/// Normal impulse that would make the separation velocity equal to the rebound.
template <Effects with, int D, class V>
HWY_INLINE V rebounding(const WholeImpulses<D, V>& c, V separation)
{
  const V excess = with.restitution ? separation - c.rebound : separation;
  return c.impulse_n - c.mass_n * excess;
}
template <int D, class V>
HWY_INLINE V least_impulse(const WholeImpulses<D, V>&)
{
  return number<V>(0);
}
/// Tangential impulse that would stop sliding; then that impulse within Coulomb's limit.
template <int D, class V>
HWY_INLINE Turning<D, V> sticking(const WholeImpulses<D, V>& c, const Turning<D, V>& sliding)
{
  return c.impulse_t - c.mass_t * sliding;
}
template <int D, class V>
HWY_INLINE Turning<D, V> within_cone(const WholeImpulses<D, V>& c, const Turning<D, V>& wanted,
                                     V friction)
{
  return within(wanted, friction * c.impulse_n);
}
template <Effects with, class Body, int D, class V>
HWY_INLINE void push(const WholeImpulses<D, V>&, Body& a, Body& b, const Push<D, V>& p)
{
  push<with>(a, b, a.inverse_mass, b.inverse_mass, p);
}
template <Effects with, class Body, int D, class V>
HWY_INLINE Relaxed<D, V> relaxed(const WholeImpulses<D, V>& c, const Body& a, const Body& b,
                                 V change_n, const Turning<D, V>& change_t)
{
  const V w_nn = a.inverse_mass + b.inverse_mass;
  const V w_tt = with.rotation ? w_nn * w_ratio<D>(c.kappa) : w_nn;
  return {magnitude(change_n) * w_nn, c.impulse_n * w_nn, w_tt * change_t, w_tt * c.impulse_t};
}

template <Effects with, int D, class V>
HWY_INLINE V rebounding(const Increments<D, V>& c, V separation)
{
  const V aim = with.restitution ? c.impulse_n + c.rebound : c.impulse_n;
  return aim - separation;
}
template <int D, class V>
HWY_INLINE V least_impulse(const Increments<D, V>& c)
{
  return minus(c.base_n);
}
template <int D, class V>
HWY_INLINE Turning<D, V> sticking(const Increments<D, V>& c, const Turning<D, V>& sliding)
{
  return c.impulse_t - c.mass_ratio * sliding;
}
template <int D, class V>
HWY_INLINE Turning<D, V> within_cone(const Increments<D, V>& c, const Turning<D, V>& wanted,
                                     V friction)
{
  const V held = friction * c.base_n, more = friction * c.impulse_n;
  if constexpr (D == 2) {
    const V base = c.base_t[0];
    return {smaller(larger(wanted[0], (minus(held) - base) - more), (held - base) + more)};
  } else {
    // A sticking contact returns `wanted` itself: adding the base and subtracting it again would
    // lose the last digits of the small increment.
    const auto whole = c.base_t + wanted;
    const V limit = held + more, squared = dot(whole, whole);
    const auto slips = squared > limit * limit;
    const auto kept = inverse_root(squared) * (limit * whole) - c.base_t;
    return components<3>([&](std::size_t k) HWY_ATTR { return choose(slips, kept[k], wanted[k]); });
  }
}
template <Effects with, class Body, int D, class V>
HWY_INLINE void push(const Increments<D, V>& c, Body& a, Body& b, const Push<D, V>& p)
{
  push<with>(a, b, c.weight_i, c.weight_j, p);
}
template <Effects with, class Body, int D, class V>
HWY_INLINE Relaxed<D, V> relaxed(const Increments<D, V>& c, const Body&, const Body&, V change_n,
                                 const Turning<D, V>& change_t)
{
  const auto level_t = c.base_t + c.impulse_t;
  const V level_n = c.base_n + c.impulse_n;
  if constexpr (!with.rotation) return {magnitude(change_n), level_n, change_t, level_t};
  const V ratio = w_ratio<D>(c.kappa);
  return {magnitude(change_n), level_n, ratio * change_t, ratio * level_t};
}

/// Makes the contact of a and b obey Signorini, Newton and Coulomb while all other contacts keep
/// their impulses. W_nt = 0, and W_tt is isotropic in the tangent plane, so both parts are solved
/// exactly, the normal one first.
template <Effects with, class Contacts, class Body, class V>
HWY_INLINE auto relax(Contacts& c, Body& a, Body& b, V friction)
{
  const auto dv = a.v - b.v;
  const V separation = dot(dv, c.n), before_n = c.impulse_n;
  const auto before_t = c.impulse_t;
  c.impulse_n = larger(rebounding<with>(c, separation), least_impulse(c));
  if constexpr (with.friction)
    c.impulse_t = within_cone(c, sticking(c, sliding_of<with>(c, a, b, dv, separation)), friction);
  const V change_n = c.impulse_n - before_n;
  const auto change_t = c.impulse_t - before_t;
  push<with>(c, a, b, push_of<with>(c.n, c.kappa, change_n, change_t));
  return relaxed<with>(c, a, b, change_n, change_t);
}

/// Loads as many contacts of a block as a vector has lanes, from `lane` on.
template <int D>
HWY_INLINE WholeImpulses<D, Vector> load(const ContactBlock<D>& b, std::size_t lane)
{
  return {load(b.n, lane),        load(b.kappa, lane),   load(b.mass_n, lane),
          load(b.mass_t, lane),   load(b.rebound, lane), load(b.impulse_n, lane),
          load(b.impulse_t, lane)};
}
template <int D>
HWY_INLINE Increments<D, hn::Vec<TagOf<float>>> load(const BlockOf<D, float>& b, std::size_t lane)
{
  return {load(b.n, lane),        load(b.kappa, lane),      load(b.weight_i, lane),
          load(b.weight_j, lane), load(b.mass_ratio, lane), load(b.rebound, lane),
          load(b.base_n, lane),   load(b.base_t, lane),     load(b.impulse_n, lane),
          load(b.impulse_t, lane)};
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
template <Effects with, int D>
HWY_INLINE void apply(const ContactBlock<D>& c, std::size_t lane, Vector normal,
                      const Turning<D, Vector>& tangential, double* motion)
{
  const auto p = push_of<with>(load(c.n, lane), load(c.kappa, lane), normal, tangential);
  push_bodies<D>(Doubles(), p.p, p.spin, motion, &c.i[lane], &c.j[lane]);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#endif
