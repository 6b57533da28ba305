// SPDX-License-Identifier: GPL-3.0-or-later

// contact_law.hpp for as many pairs at a time as a vector has lanes. A function here does what the
// one of the same name does there, operation by operation: to change the law, change both.
// Compiled once per instruction set, by files that include themselves so (hwy/foreach_target.h).
#if defined(GRSEG_SIM_CONTACT_LAW) == defined(HWY_TARGET_TOGGLE)
#ifdef GRSEG_SIM_CONTACT_LAW
#undef GRSEG_SIM_CONTACT_LAW
#else
#define GRSEG_SIM_CONTACT_LAW
#endif

#include "sim/contact/contact_law.hpp"
#include "sim/contact/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

using Mask = hn::Mask<D>;

HWY_INLINE Mask acts(Vector dx, Vector dy, Vector reach, Vector margin)
{
  const auto squared = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
  const auto limit = hn::Add(reach, margin);
  return hn::Le(squared, hn::Mul(limit, limit));
}

struct Normals {
  Vector nx, ny, distance;
};

/// Where `used` is false the normal is anything finite.
HWY_INLINE Normals normal_of_discs(Vector dx, Vector dy, Mask used)
{
  const D d;
  const auto distance = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
  const auto one = hn::Set(d, 1.0);
  const auto inverse = hn::Div(one, hn::IfThenElse(used, distance, one));
  return {hn::Mul(dx, inverse), hn::Mul(dy, inverse), distance};
}

HWY_INLINE Normals normal_of_wall(Vector dx, Vector dy, Vector nx, Vector ny)
{
  return {nx, ny, hn::Add(hn::Mul(dx, nx), hn::Mul(dy, ny))};
}

/// From the sum of inverse masses; 0 where `used` is false.
HWY_INLINE Vector normal_mass(Vector inverse_masses, Mask used)
{
  const D d;
  const auto one = hn::Set(d, 1.0);
  return hn::IfThenElseZero(used, hn::Div(one, hn::IfThenElse(used, inverse_masses, one)));
}

HWY_INLINE Vector tangential_mass(Vector normal_mass, Vector kappa, double rim_factor)
{
  const D d;
  const auto lever = hn::Mul(hn::Set(d, rim_factor), hn::Mul(kappa, kappa));
  return hn::Div(normal_mass, hn::Add(hn::Set(d, 1.0), lever));
}

HWY_INLINE Vector approach_of(Vector separation)
{
  return larger(hn::Neg(separation), hn::Zero(D()));
}

struct Rebounds {
  Vector velocity, remembered;
};

HWY_INLINE Vector fresh_approach(Vector separation, Vector load)
{
  const D d;
  const auto part = hn::IfThenElse(hn::Gt(separation, hn::Zero(d)), hn::Set(d, parting_error),
                                   hn::Set(d, solver_error));
  return hn::IfThenElseZero(hn::Gt(hn::Abs(separation), hn::Mul(part, load)), hn::Neg(separation));
}

/// Without `with_restitution` as for e = 0, without `with_horizon` as for horizon 0.
template <bool with_restitution, bool with_horizon>
HWY_INLINE Rebounds rebound_of(Vector gap, Vector separation, Vector load, Vector remembered,
                               double restitution, double horizon)
{
  const D d;
  const auto zero = hn::Zero(d);
  const auto already_slowed_down = hn::Gt(remembered, zero);
  auto approach = fresh_approach(separation, load);
  if constexpr (with_horizon)
    approach = hn::IfThenElse(already_slowed_down, larger(remembered, approach), approach);
  // The sum is never -0, which e = 0 would make.
  const auto newton =
      with_restitution ? hn::Add(hn::Mul(hn::Set(d, restitution), approach), zero) : zero;
  if constexpr (!with_horizon) return {newton, zero};
  const auto closing = hn::Div(hn::Neg(gap), hn::Set(d, horizon));
  const auto slowed_down_now = hn::AndNot(already_slowed_down, hn::Gt(gap, zero));
  const auto newcomer = hn::And(hn::Eq(load, zero), hn::Lt(separation, closing));
  return {hn::IfThenElse(slowed_down_now, smaller(closing, newton), newton),
          hn::IfThenElseZero(hn::And(slowed_down_now, newcomer), approach)};
}

/// Adds the impulse (px, py) times their weights to a and takes it from b; `spin` is taken from both.
template <Effects with, class Tag, class V = hn::Vec<Tag>>
HWY_INLINE void push(Bodies<Tag>& a, Bodies<Tag>& b, V weight_a, V weight_b, V px, V py, V spin)
{
  if constexpr (with.friction && with.rotation) {
    a.rim_speed = hn::Sub(a.rim_speed, hn::Mul(weight_a, spin));
    b.rim_speed = hn::Sub(b.rim_speed, hn::Mul(weight_b, spin));
  }
  a.vx = hn::Add(a.vx, hn::Mul(weight_a, px));
  a.vy = hn::Add(a.vy, hn::Mul(weight_a, py));
  b.vx = hn::Sub(b.vx, hn::Mul(weight_b, px));
  b.vy = hn::Sub(b.vy, hn::Mul(weight_b, py));
}

/// use<with>() for the effects that matter where impulses are applied: restitution does not.
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

/// What impulses along the normals and tangents of contacts do to their bodies, as push() takes it.
struct Pushes {
  Vector px, py, spin;
};
template <Effects with>
HWY_INLINE Pushes pushes_of(const ContactBlock& c, std::size_t lane, Vector normal,
                            Vector tangential)
{
  const D d;
  const auto nx = hn::Load(d, &c.nx[lane]), ny = hn::Load(d, &c.ny[lane]);
  Pushes p{hn::Mul(normal, nx), hn::Mul(normal, ny), hn::Zero(d)};
  if constexpr (with.friction) {
    p.px = hn::Sub(p.px, hn::Mul(tangential, ny));
    p.py = hn::Add(p.py, hn::Mul(tangential, nx));
  }
  if constexpr (with.friction && with.rotation) {
    const auto lever = hn::Mul(hn::Set(d, disc_rim_factor), hn::Load(d, &c.kappa[lane]));
    p.spin = hn::Mul(lever, tangential);
  }
  return p;
}

/// Applies impulses along the normals and tangents of the lanes of a block that begin at `lane`.
template <Effects with>
HWY_INLINE void apply(const ContactBlock& c, std::size_t lane, Vector normal, Vector tangential,
                      double* motion)
{
  const auto p = pushes_of<with>(c, lane, normal, tangential);
  push_bodies(D(), p.px, p.py, p.spin, motion, &c.i[lane], &c.j[lane]);
}

/// What relaxing changed along one direction, and its level: W times the impulse, m/s.
template <class Tag>
struct Relaxed {
  hn::Vec<Tag> change, level;
};

/// Relaxes the lanes of a block that begin at `lane`, whose bodies are a and b.
/// `results.add(lane, normal)` or `results.add(lane, normal, tangential)` is given what changed.
template <Effects with, class Results>
HWY_INLINE void relax(ContactBlock& c, std::size_t lane, Bodies<D>& a, Bodies<D>& b,
                      Vector friction, Results& results)
{
  const D d;
  const auto nx = hn::Load(d, &c.nx[lane]), ny = hn::Load(d, &c.ny[lane]);
  const auto w_nn = hn::Add(a.inverse_mass, b.inverse_mass);
  const auto dvx = hn::Sub(a.vx, b.vx), dvy = hn::Sub(a.vy, b.vy);

  auto excess = hn::Add(hn::Mul(dvx, nx), hn::Mul(dvy, ny));
  if constexpr (with.restitution) excess = hn::Sub(excess, hn::Load(d, &c.rebound[lane]));
  const auto before_n = hn::Load(d, &c.impulse_n[lane]);
  const auto relaxed_n = hn::Sub(before_n, hn::Mul(hn::Load(d, &c.mass_n[lane]), excess));
  const auto impulse_n = larger(relaxed_n, hn::Zero(d));
  hn::Store(impulse_n, d, &c.impulse_n[lane]);
  const auto change_n = hn::Sub(impulse_n, before_n);
  const Relaxed<D> normal{hn::Mul(hn::Abs(change_n), w_nn), hn::Mul(impulse_n, w_nn)};

  auto px = hn::Mul(change_n, nx), py = hn::Mul(change_n, ny), spin = hn::Zero(d);
  if constexpr (with.friction) {
    auto sliding = hn::Sub(hn::Mul(dvy, nx), hn::Mul(dvx, ny));
    auto w_tt = w_nn;
    const auto kappa = hn::Load(d, &c.kappa[lane]);
    const auto lever = hn::Mul(hn::Set(d, disc_rim_factor), kappa);
    if constexpr (with.rotation) {
      sliding = hn::Sub(sliding, hn::Mul(kappa, hn::Add(a.rim_speed, b.rim_speed)));
      w_tt = hn::Mul(w_nn, hn::Add(hn::Set(d, 1.0), hn::Mul(lever, kappa)));
    }
    const auto limit = hn::Mul(friction, impulse_n);
    const auto before_t = hn::Load(d, &c.impulse_t[lane]);
    const auto sticking = hn::Sub(before_t, hn::Mul(hn::Load(d, &c.mass_t[lane]), sliding));
    const auto impulse_t = smaller(larger(sticking, hn::Neg(limit)), limit);
    hn::Store(impulse_t, d, &c.impulse_t[lane]);
    const auto change_t = hn::Sub(impulse_t, before_t);
    px = hn::Sub(px, hn::Mul(change_t, ny));
    py = hn::Add(py, hn::Mul(change_t, nx));
    if constexpr (with.rotation) spin = hn::Mul(lever, change_t);
    results.add(lane, normal,
                Relaxed<D>{hn::Mul(hn::Abs(change_t), w_tt), hn::Mul(impulse_t, w_tt)});
  } else {
    results.add(lane, normal);
  }
  push<with, D>(a, b, a.inverse_mass, b.inverse_mass, px, py, spin);
}

/// The same in single precision, see ContactOf<float>.
template <Effects with, class Results, class Single = TagOf<float>>
HWY_INLINE void relax(BlockOf<float>& c, std::size_t lane, Bodies<Single>& a, Bodies<Single>& b,
                      hn::Vec<Single> friction, Results& results)
{
  const Single d;
  const auto nx = hn::Load(d, &c.nx[lane]), ny = hn::Load(d, &c.ny[lane]);
  const auto dvx = hn::Sub(a.vx, b.vx), dvy = hn::Sub(a.vy, b.vy);

  const auto separation = hn::Add(hn::Mul(dvx, nx), hn::Mul(dvy, ny));
  const auto before_n = hn::Load(d, &c.impulse_n[lane]), base_n = hn::Load(d, &c.base_n[lane]);
  auto aim = before_n;
  if constexpr (with.restitution) aim = hn::Add(before_n, hn::Load(d, &c.rebound[lane]));
  const auto impulse_n = larger(hn::Sub(aim, separation), hn::Neg(base_n));
  hn::Store(impulse_n, d, &c.impulse_n[lane]);
  const auto change_n = hn::Sub(impulse_n, before_n);
  const Relaxed<Single> normal{hn::Abs(change_n), hn::Add(base_n, impulse_n)};

  auto px = hn::Mul(change_n, nx), py = hn::Mul(change_n, ny), spin = hn::Zero(d);
  if constexpr (with.friction) {
    auto sliding = hn::Sub(hn::Mul(dvy, nx), hn::Mul(dvx, ny));
    const auto kappa = hn::Load(d, &c.kappa[lane]);
    const auto lever = hn::Mul(hn::Set(d, float{disc_rim_factor}), kappa);
    if constexpr (with.rotation)
      sliding = hn::Sub(sliding, hn::Mul(kappa, hn::Add(a.rim_speed, b.rim_speed)));
    const auto base_t = hn::Load(d, &c.base_t[lane]), before_t = hn::Load(d, &c.impulse_t[lane]);
    const auto held = hn::Mul(friction, base_n), more = hn::Mul(friction, impulse_n);
    const auto lowest = hn::Sub(hn::Sub(hn::Neg(held), base_t), more);
    const auto highest = hn::Add(hn::Sub(held, base_t), more);
    const auto sticking = hn::Sub(before_t, hn::Mul(hn::Load(d, &c.mass_ratio[lane]), sliding));
    const auto impulse_t = smaller(larger(sticking, lowest), highest);
    hn::Store(impulse_t, d, &c.impulse_t[lane]);
    const auto change_t = hn::Sub(impulse_t, before_t);
    px = hn::Sub(px, hn::Mul(change_t, ny));
    py = hn::Add(py, hn::Mul(change_t, nx));
    Relaxed<Single> tangential{hn::Abs(change_t), hn::Add(base_t, impulse_t)};
    if constexpr (with.rotation) {
      spin = hn::Mul(lever, change_t);
      const auto w_ratio = hn::Add(hn::Set(d, 1.0F), hn::Mul(lever, kappa));
      tangential = {hn::Mul(tangential.change, w_ratio), hn::Mul(tangential.level, w_ratio)};
    }
    results.add(lane, normal, tangential);
  } else {
    results.add(lane, normal);
  }
  const auto weight_a = hn::Load(d, &c.weight_i[lane]), weight_b = hn::Load(d, &c.weight_j[lane]);
  push<with, Single>(a, b, weight_a, weight_b, px, py, spin);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#endif
