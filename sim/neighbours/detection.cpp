// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/detection.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/neighbours/detection.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
#include "sim/neighbours/pair_memories-inl.hpp"
// clang-format on

#ifndef GRSEG_SIM_DETECTION_LOOPS
#define GRSEG_SIM_DETECTION_LOOPS
namespace grseg {
namespace {
/// find() below, compiled for an instruction set.
template <int D>
using Find = void (*)(const Pairs<D>&, std::size_t strip, const DetectionRule<D>&,
                      StripContacts<D>&, DetectionSums&);
}  // namespace
}  // namespace grseg
#endif

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// Effects of a scene, as a template argument, so that an absent effect costs no time.
struct Variant {
  bool periodic, rotation, restitution, horizon;
};

/// DetectionSums, one number per lane.
struct alignas(64) LaneSums {
  Lanes overlap{}, largest_overlap{}, fastest_approach{}, load{}, root_loads{}, approaches{};
  Lanes strain{};  // twice the sum
  std::size_t touching = 0;
  bool coincident = false;
};

/// Geometries of pairs as an array of doubles, two per pair.
template <int D>
HWY_INLINE const double* numbers_of(const PairGeometry<D>* g)
{
  return &g->shift;
}

/// Vectors between the centres of pairs, m, and the distances at which they touch.
template <int D>
struct Apart {
  Along<D, Vector> x;
  Vector reach;
};
/// `geometry`: the two doubles of PairGeometry. Shifts of spheres are always added: they also mark
/// entries that are not listed.
template <bool periodic, int D>
HWY_INLINE Apart<D> apart_of(std::span<const Position<D>> position, const std::uint32_t* i,
                             const std::uint32_t* j, const Twos& geometry)
{
  const Doubles d;
  const auto* numbers = position.data()->data();
  if constexpr (D == 2) {
    const auto [x, y] = load_differences<1>(d, numbers, i, j);
    if constexpr (periodic) return {{x + geometry.first, y}, geometry.second};
    return {{x, y}, geometry.second};
  } else {
    const auto [x, y, z, reach] = load_sums<3>(d, numbers, i, j);
    return {{x + geometry.first, y, z + geometry.second}, reach};
  }
}

/// Writes the pairs of grains whose forecast distance is at most reach + margin to `near`, and one
/// bit per pair to `acting`; returns the number of these pairs.
template <bool periodic, int D>
HWY_INLINE std::size_t find_near_pairs(const Pairs<D>& pairs, const PairClass& c,
                                       const DetectionRule<D>& rule, NearPairs& near,
                                       std::uint8_t* acting)
{
  const Doubles d;
  const auto margin = hn::Set(d, rule.margin);
  std::size_t count = 0;
  const auto end = rule.only_near ? c.near_end : c.end;
  std::fill_n(acting + (end - c.begin) / block_lanes, (c.end - end) / block_lanes, std::uint8_t{0});
  for (std::size_t k = c.begin; k < end; k += block_lanes) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const std::size_t at = k + lane;
      const auto geometry = load_next_twos(d, numbers_of(&pairs.geometry[at]));
      const auto apart = apart_of<periodic, D>(rule.ahead, &pairs.i[at], &pairs.j[at], geometry);
      bits |= bits_of(d, acts(apart.x, apart.reach, margin)) << lane;
    }
    *acting++ = static_cast<std::uint8_t>(bits);
    store_set_bits<2>(bits, k, &near.pair[count]);
    store_chosen(bits, &pairs.i[k], &near.i[count]);
    store_chosen(bits, &pairs.j[k], &near.j[count]);
    count += hwy::PopCount(std::uint64_t{bits});
  }
  return count;
}

template <int D>
std::size_t find_near_wall(const Pairs<D>& pairs, const PairClass& c, const DetectionRule<D>& rule,
                           NearPairs& near, std::uint8_t* acting)
{
  const auto& wall = rule.walls[static_cast<std::size_t>(c.wall)];
  std::fill_n(acting, (c.end - c.begin) / block_lanes, std::uint8_t{0});
  std::size_t count = 0;
  for (auto k = c.begin; k < c.end; ++k) {
    if (!pairs.listed(k)) continue;
    const auto& position = rule.ahead[pairs.i[k] / position_doubles<D>];
    double reach = 0;
    if constexpr (D == 2)
      reach = pairs.geometry[k].reach;
    else
      reach = position[3];
    if (!acts_on_wall(distance_to<D>(wall, point<D>(position)), reach, rule.margin)) continue;
    const auto at = k - c.begin;
    acting[at / block_lanes] |= static_cast<std::uint8_t>(1U << at % block_lanes);
    near.pair[count] = 2 * k;
    near.i[count] = pairs.i[k];
    near.j[count] = pairs.j[k];
    ++count;
  }
  return count;
}

/// Vectors from the point of a wall to the centres of grains, m, and their radii.
template <int D>
HWY_INLINE Apart<D> apart_from_wall(std::span<const Position<D>> position, const Wall<D>& wall,
                                    const std::uint32_t* i, const Twos& geometry)
{
  const Doubles d;
  const auto* numbers = position.data()->data();
  const auto from_wall = [&](const auto& x) HWY_ATTR {
    return components<D>([&](std::size_t k) HWY_ATTR {
      return x[k] - hn::Set(d, wall.point[static_cast<Eigen::Index>(k)]);
    });
  };
  if constexpr (D == 2) {
    const auto [x, y] = load_twos(d, numbers, i);
    return {from_wall(Along<2, Vector>{x, y}), geometry.second};
  } else {
    const auto x = load_fours(d, numbers, i);
    return {from_wall(x), x[3]};
  }
}

/// Sets the bodies of a block and the entries of its pairs from eight pairs of `near`.
template <int D>
HWY_INLINE void set_places(const NearPairs& near, std::size_t first, ContactBlock<D>& block,
                           BlockOrigin<D>& origin)
{
  const D32 d;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto i = hn::LoadU(d, &near.i[first + lane]);
    const auto j = hn::LoadU(d, &near.j[first + lane]);
    hn::Store(hn::Add(i, i), d, &block.i[lane]);
    hn::Store(hn::Add(j, j), d, &block.j[lane]);
    const auto pair = hn::LoadU(d, &near.pair[first + lane]);
    hn::Store(hn::Add(pair, pair), d, &origin.pair[lane]);
  }
}

template <int D>
struct Geometries {
  Along<D, Vector> n;
  Vector kappa, gap;
};

/// Geometries of as many pairs as a vector has lanes, from entry `at` of `near` on.
template <bool periodic, int D>
HWY_INLINE Geometries<D> contact_geometry(const Pairs<D>& pairs, const PairClass& c,
                                          const NearPairs& near, std::size_t at,
                                          const DetectionRule<D>& rule, hn::Mask<Doubles> used,
                                          LaneSums& sums)
{
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  const auto geometry = load_twos(d, numbers_of(pairs.geometry.data()), &near.pair[at]);
  if (c.wall >= 0) {
    const auto& wall = rule.walls[static_cast<std::size_t>(c.wall)];
    const auto apart = apart_from_wall<D>(rule.middle, wall, &near.i[at], geometry);
    const auto n = normal_of_wall(apart.x, components<D>([&](std::size_t k) HWY_ATTR {
                                    return hn::Set(d, wall.normal[static_cast<Eigen::Index>(k)]);
                                  }));
    return {n.n, one, n.distance - apart.reach};
  }
  const auto apart = apart_of<periodic, D>(rule.middle, &near.i[at], &near.j[at], geometry);
  const auto n = normal_of_grains(apart.x, used);
  sums.coincident |= !hn::AllFalse(d, both(used, n.distance == hn::Zero(d)));
  const auto reach = D == 2 ? apart.reach : choose(used, apart.reach, one);
  return {n.n, n.distance * (one / reach), n.distance - reach};
}

HWY_INLINE void accumulate(Vector gap, Vector approach, Vector impulse_n, Vector w_nn,
                           hn::Mask<Doubles> used, std::size_t lane, LaneSums& sums)
{
  const Doubles d;
  const auto add = [&](Lanes& to, Vector what)
                       HWY_ATTR { hn::Store(load(to, lane) + what, d, &to[lane]); };
  const auto keep_most = [&](Lanes& of, Vector what)
                             HWY_ATTR { hn::Store(larger(load(of, lane), what), d, &of[lane]); };
  const auto touching = both(used, gap <= hn::Zero(d));
  const auto overlap = choose(touching, minus(gap));
  sums.touching += hn::CountTrue(d, touching);
  add(sums.overlap, overlap);
  keep_most(sums.largest_overlap, overlap);
  keep_most(sums.fastest_approach, approach);
  add(sums.load, impulse_n);
  add(sums.root_loads, root(impulse_n));
  add(sums.strain, impulse_n * impulse_n * w_nn);
  const auto fresh = choose(impulse_n == hn::Zero(d), approach);
  add(sums.approaches, fresh * fresh);
}

/// Writes a block with eight pairs of a class, from entry `first` of `near` on, including the first
/// guesses of their impulses.
template <Variant with, int D>
HWY_INLINE void set_block(const Pairs<D>& pairs, const PairClass& c, const NearPairs& near,
                          std::size_t first, const DetectionRule<D>& rule, ContactBlock<D>& block,
                          BlockOrigin<D>& origin, LaneSums& sums)
{
  const Doubles d;
  const auto* motion = reinterpret_cast<const double*>(rule.motion.data());
  set_places(near, first, block, origin);
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto v = load_relative<D>(d, motion, &block.i[lane], &block.j[lane]);
    const auto used = hn::Gt(v.inverse_mass, hn::Zero(d));
    const auto g =
        contact_geometry<with.periodic, D>(pairs, c, near, first + lane, rule, used, sums);
    const auto mass = normal_mass(v.inverse_mass, used);
    store(g.n, block.n, lane);
    store(g.kappa, block.kappa, lane);
    store(mass, block.mass_n, lane);
    store(with.rotation ? tangential_mass(mass, g.kappa, rule.rim_factor) : mass, block.mass_t,
          lane);

    const auto separation = dot(v.v, g.n);
    const auto remembered_of = load_memories<D>(pairs, &origin.pair[lane]);
    const auto n = remembered_of.n;
    const auto remembered = with.horizon ? remembered_of.approach : hn::Zero(d);
    const auto rebound = rebound_of<with.restitution, with.horizon>(
        g.gap, separation, n * v.inverse_mass, remembered, rule.restitution, rule.horizon);
    store(rebound.velocity, block.rebound, lane);
    store(n, block.impulse_n, lane);
    store(in_plane(remembered_of.t, g.n), block.impulse_t, lane);
    store(g.gap, origin.gap, lane);
    store(rebound.remembered, origin.approach, lane);
    accumulate(g.gap, larger(minus(separation), hn::Zero(d)), n, v.inverse_mass, used, lane, sums);
  }
}

/// Fills the last block of a class with the neutral pair. In a class of pairs without a colour each
/// pair becomes a block of its own; pairs are moved to their blocks from the last one on. Returns
/// the number of blocks.
template <int D>
std::size_t fill_up(const Pairs<D>& pairs, bool alone, std::size_t count, NearPairs& near)
{
  const auto neutral = static_cast<std::uint32_t>(2 * pairs.size()), nobody = pairs.i.back();
  const auto clear = [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      near.pair[k] = neutral, near.i[k] = nobody, near.j[k] = nobody;
  };
  if (!alone) {
    const std::size_t blocks = (count + block_lanes - 1) / block_lanes;
    clear(count, blocks * block_lanes);
    return blocks;
  }
  for (std::size_t k = count; k-- > 0;) {
    for (auto* numbers : {&near.pair, &near.i, &near.j})
      (*numbers)[k * block_lanes] = (*numbers)[k];
    clear(k * block_lanes + 1, (k + 1) * block_lanes);
  }
  return count;
}

template <Variant with, int D>
void find(const Pairs<D>& pairs, std::size_t strip, const DetectionRule<D>& rule,
          StripContacts<D>& contacts, DetectionSums& total)
{
  LaneSums sums;
  auto& near = contacts.near;
  const auto first = pairs.begin_of(strip);
  bool base_seen = false;
  contacts.ends.clear();
  for (const auto& c : pairs.classes_of(strip)) {
    if (c.on_base && !base_seen) contacts.on_base = contacts.size;
    base_seen |= c.on_base;
    auto* acting = &contacts.acting[(c.begin - first) / block_lanes];
    const auto count = c.wall < 0 ? find_near_pairs<with.periodic, D>(pairs, c, rule, near, acting)
                                  : find_near_wall<D>(pairs, c, rule, near, acting);
    const auto blocks = fill_up(pairs, c.alone, count, near);
    for (std::size_t b = 0; b < blocks; ++b)
      set_block<with, D>(pairs, c, near, b * block_lanes, rule, contacts.blocks[contacts.size + b],
                         contacts.origins[contacts.size + b], sums);
    for (std::size_t b = 0; b < blocks; ++b)
      if (c.alone || b + 1 == blocks)
        contacts.ends.push_back(static_cast<std::uint32_t>(contacts.size + b + 1));
    contacts.size += blocks;
    contacts.count += count;
  }
  if (!base_seen) contacts.on_base = contacts.size;
  const auto most = [](const Lanes& l) { return *std::max_element(l.begin(), l.end()); };
  total = {
      sums.touching,  sum(sums.overlap),    most(sums.largest_overlap), most(sums.fastest_approach),
      sum(sums.load), sum(sums.root_loads), sum(sums.approaches),       sum(sums.strain) / 2,
      sums.coincident};
  leave_vectors();
}

/// Chooses find() for the effects of the scene, its template arguments.
template <int D>
Find<D> find_for(const DetectionRule<D>& rule)
{
  return with_flags(
      []<bool periodic, bool rotation, bool restitution, bool horizon>() -> Find<D> {
        return &find<Variant{periodic || D == 3, rotation, restitution, horizon}, D>;
      },
      rule.periodic, rule.effects.rotation, rule.effects.restitution, rule.horizon > 0);
}
// Dispatch accepts no templates.
Find<2> find_discs(const DetectionRule<2>& rule)
{
  return find_for(rule);
}
Find<3> find_spheres(const DetectionRule<3>& rule)
{
  return find_for(rule);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(find_discs);
HWY_EXPORT(find_spheres);

template <int D>
Find<D> choose_find(const DetectionRule<D>& rule)
{
  if constexpr (D == 2)
    return HWY_DYNAMIC_DISPATCH(find_discs)(rule);
  else
    return HWY_DYNAMIC_DISPATCH(find_spheres)(rule);
}

/// Resizes the arrays of a strip for the case that all its listed pairs act.
template <int D>
void make_room(std::span<const PairClass> classes, StripContacts<D>& contacts)
{
  std::size_t most = 0, largest_class = 0;
  for (const auto& c : classes) {
    const std::size_t size = c.end - c.begin;
    most += c.alone ? size : size / block_lanes;
    largest_class = std::max(largest_class, c.alone ? size * block_lanes : size);
  }
  if (contacts.blocks.size() < most) contacts.blocks.resize(most);
  if (contacts.origins.size() < most) contacts.origins.resize(most);
  const std::size_t listed = classes.empty() ? 0 : classes.back().end - classes.front().begin;
  contacts.acting.resize(listed / block_lanes);
  for (auto* numbers : {&contacts.near.pair, &contacts.near.i, &contacts.near.j})
    numbers->resize(largest_class + block_lanes);
}

}  // namespace

template <int D>
DetectionSums find_contacts(const Pairs<D>& pairs, const DetectionRule<D>& rule,
                            std::vector<StripContacts<D>>& contacts, int threads)
{
  contacts.resize(pairs.strip_count());
  std::vector<DetectionSums> sums(contacts.size());
  const auto find = choose_find(rule);
  for_each_part(threads, contacts.size(), [&](std::size_t s) {
    auto& strip = contacts[s];
    std::swap(strip.acting, strip.acted);
    strip.size = strip.count = 0;
    make_room(pairs.classes_of(s), strip);
    find(pairs, s, rule, strip, sums[s]);
  });
  DetectionSums total;
  for (const auto& s : sums) {
    total.touching += s.touching;
    total.overlap += s.overlap;
    total.largest_overlap = std::max(total.largest_overlap, s.largest_overlap);
    total.fastest_approach = std::max(total.fastest_approach, s.fastest_approach);
    total.load += s.load;
    total.root_loads += s.root_loads;
    total.approaches += s.approaches;
    total.strain += s.strain;
    total.coincident |= s.coincident;
  }
  return total;
}

template <int D>
void forget_search(std::vector<StripContacts<D>>& contacts)
{
  for (auto& strip : contacts) std::swap(strip.acting, strip.acted);
}

template DetectionSums find_contacts(const Pairs<2>&, const DetectionRule<2>&,
                                     std::vector<StripContacts<2>>&, int);
template void forget_search(std::vector<StripContacts<2>>&);
template DetectionSums find_contacts(const Pairs<3>&, const DetectionRule<3>&,
                                     std::vector<StripContacts<3>>&, int);
template void forget_search(std::vector<StripContacts<3>>&);

}  // namespace grseg
#endif  // HWY_ONCE
