// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/detection.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/neighbours/detection.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
// clang-format on

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
  std::size_t touching = 0;
  bool coincident = false;
};

/// Data of a pair as an array of doubles: two of Geometry, four of Memory.
HWY_INLINE const double* numbers_of(const Pairs::Geometry* g)
{
  return &g->shift;
}
HWY_INLINE const double* numbers_of(const Pairs::Memory* g)
{
  return &g->n;
}

/// Writes the pairs of grains whose distance is below reach + margin to `near`, and one bit per
/// pair to `acting`; returns the number of these pairs.
template <bool periodic>
HWY_INLINE std::size_t find_near_pairs(const Pairs& pairs, const Pairs::Class& c,
                                       const DetectionRule& rule, NearPairs& near,
                                       std::uint8_t* acting)
{
  const D d;
  const auto* position = rule.ahead.data()->data();
  const auto margin = hn::Set(d, rule.margin);
  std::size_t count = 0;
  for (std::size_t k = c.begin; k < c.end; k += block_lanes) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const std::size_t at = k + lane;
      auto [x, y] = load_differences<1>(d, position, &pairs.i[at], &pairs.j[at]);
      const auto [shift, reach] = load_next_twos(d, numbers_of(&pairs.geometry[at]));
      if constexpr (periodic) x = x + shift;
      bits |= bits_of(d, acts(x, y, reach, margin)) << lane;
    }
    *acting++ = static_cast<std::uint8_t>(bits);
    store_set_bits<2>(bits, k, &near.pair[count]);
    store_chosen(bits, &pairs.i[k], &near.i[count]);
    store_chosen(bits, &pairs.j[k], &near.j[count]);
    count += hwy::PopCount(std::uint64_t{bits});
  }
  return count;
}

std::size_t find_near_wall(const Pairs& pairs, const Pairs::Class& c, const DetectionRule& rule,
                           NearPairs& near, std::uint8_t* acting)
{
  const auto& wall = rule.walls[static_cast<std::size_t>(c.wall)];
  std::fill_n(acting, (c.end - c.begin) / block_lanes, std::uint8_t{0});
  std::size_t count = 0;
  for (auto k = c.begin; k < c.end; ++k) {
    const auto& x = rule.ahead[pairs.i[k] / 2];
    const double distance = (x - wall.point).dot(wall.normal);
    if (!acts_on_wall(distance, pairs.geometry[k].reach, rule.margin)) continue;
    const auto at = k - c.begin;
    acting[at / block_lanes] |= static_cast<std::uint8_t>(1U << at % block_lanes);
    near.pair[count] = 2 * k;
    near.i[count] = pairs.i[k];
    near.j[count] = pairs.j[k];
    ++count;
  }
  return count;
}

template <bool periodic>
HWY_INLINE Normal<Vector> normal_of_grains(const DetectionRule& rule, const std::uint32_t* i,
                                           const std::uint32_t* j, Vector shift, hn::Mask<D> used,
                                           LaneSums& sums)
{
  const D d;
  auto [x, y] = load_differences<1>(d, rule.middle.data()->data(), i, j);
  if constexpr (periodic) x = x + shift;
  const auto normal = normal_of_discs(x, y, used);
  sums.coincident |= !hn::AllFalse(d, both(used, normal.distance == hn::Zero(d)));
  return normal;
}

HWY_INLINE Normal<Vector> normal_at_wall(const DetectionRule& rule, const Wall& wall,
                                         const std::uint32_t* i)
{
  const D d;
  const auto [x, y] = load_twos(d, rule.middle.data()->data(), i);
  return normal_of_wall(x - hn::Set(d, wall.point.x()), y - hn::Set(d, wall.point.y()),
                        hn::Set(d, wall.normal.x()), hn::Set(d, wall.normal.y()));
}

/// Sets the bodies of a block and the entries of its pairs from eight pairs of `near`.
HWY_INLINE void set_places(const NearPairs& near, std::size_t first, ContactBlock& block,
                           BlockOrigin& origin)
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

struct Geometries {
  Vector nx, ny, kappa, gap;
};

/// Geometries of as many pairs as a vector has lanes, from entry `at` of `near` on.
template <bool periodic>
HWY_INLINE Geometries geometry_of(const Pairs& pairs, const Pairs::Class& c, const NearPairs& near,
                                  std::size_t at, const DetectionRule& rule, hn::Mask<D> used,
                                  LaneSums& sums)
{
  const D d;
  const auto one = hn::Set(d, 1.0);
  const auto [shift, reach] = load_twos(d, numbers_of(pairs.geometry.data()), &near.pair[at]);
  const auto n =
      c.wall < 0 ? normal_of_grains<periodic>(rule, &near.i[at], &near.j[at], shift, used, sums)
                 : normal_at_wall(rule, rule.walls[static_cast<std::size_t>(c.wall)], &near.i[at]);
  const auto kappa = c.wall < 0 ? n.distance * (one / reach) : one;
  return {n.nx, n.ny, kappa, n.distance - reach};
}

HWY_INLINE void accumulate(Vector gap, Vector approach, Vector impulse_n, hn::Mask<D> used,
                           std::size_t lane, LaneSums& sums)
{
  const D d;
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
  const auto fresh = choose(impulse_n == hn::Zero(d), approach);
  add(sums.approaches, fresh * fresh);
}

/// Writes a block with eight pairs of a class, from entry `first` of `near` on, including the first
/// guesses of their impulses.
template <Variant with>
HWY_INLINE void set_block(const Pairs& pairs, const Pairs::Class& c, const NearPairs& near,
                          std::size_t first, const DetectionRule& rule, ContactBlock& block,
                          BlockOrigin& origin, LaneSums& sums)
{
  const D d;
  const auto* motion = reinterpret_cast<const double*>(rule.motion.data());
  set_places(near, first, block, origin);
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto store = [&](Vector what, Lanes& to) HWY_ATTR { hn::Store(what, d, &to[lane]); };
    const auto v = load_relative(d, motion, &block.i[lane], &block.j[lane]);
    const auto used = hn::Gt(v.inverse_mass, hn::Zero(d));
    const auto g = geometry_of<with.periodic>(pairs, c, near, first + lane, rule, used, sums);
    const auto mass = normal_mass(v.inverse_mass, used);
    store(g.nx, block.nx);
    store(g.ny, block.ny);
    store(g.kappa, block.kappa);
    store(mass, block.mass_n);
    store(with.rotation ? tangential_mass(mass, g.kappa, rule.rim_factor) : mass, block.mass_t);

    const auto separation = v.vx * g.nx + v.vy * g.ny;
    const auto [n, t, approach, unused] =
        load_bodies(d, numbers_of(pairs.memory.data()), &origin.pair[lane]);
    const auto remembered = with.horizon ? approach : hn::Zero(d);
    const auto rebound = rebound_of<with.restitution, with.horizon>(
        g.gap, separation, n * v.inverse_mass, remembered, rule.restitution, rule.horizon);
    store(rebound.velocity, block.rebound);
    store(n, block.impulse_n);
    store(t, block.impulse_t);
    store(g.gap, origin.gap);
    store(rebound.remembered, origin.approach);
    accumulate(g.gap, larger(minus(separation), hn::Zero(d)), n, used, lane, sums);
  }
}

/// Fills the last block of a class with the neutral pair. In a class of pairs without a colour each
/// pair becomes a block of its own; pairs are moved to their blocks from the last one on. Returns
/// the number of blocks.
std::size_t fill_up(const Pairs& pairs, bool alone, std::size_t count, NearPairs& near)
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

template <Variant with>
void find(const Pairs& pairs, std::size_t strip, const DetectionRule& rule, StripContacts& contacts,
          DetectionSums& total)
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
    const auto count = c.wall < 0 ? find_near_pairs<with.periodic>(pairs, c, rule, near, acting)
                                  : find_near_wall(pairs, c, rule, near, acting);
    const auto blocks = fill_up(pairs, c.alone, count, near);
    for (std::size_t b = 0; b < blocks; ++b)
      set_block<with>(pairs, c, near, b * block_lanes, rule, contacts.blocks[contacts.size + b],
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
      sum(sums.load), sum(sums.root_loads), sum(sums.approaches),       sums.coincident};
  leave_vectors();
}

/// Calls find() with the effects of the scene as template arguments.
void find_for(const Pairs& pairs, std::size_t strip, const DetectionRule& rule,
              StripContacts& contacts, DetectionSums& total)
{
  const auto find_it = with_flags(
      []<bool periodic, bool rotation, bool restitution, bool horizon>() {
        return &find<Variant{periodic, rotation, restitution, horizon}>;
      },
      rule.periodic, rule.effects.rotation, rule.effects.restitution, rule.horizon > 0);
  find_it(pairs, strip, rule, contacts, total);
}

void keep(const StripContacts& contacts, Pairs::Memory* memories, ImpulseSums& total)
{
  const D d;
  auto* memory = reinterpret_cast<double*>(memories);
  alignas(64) Lanes gaps{}, base_x{}, base_y{};
  for (std::size_t b = 0; b < contacts.size; ++b) {
    const auto& block = contacts.blocks[b];
    const auto& origin = contacts.origins[b];
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const auto add = [&](Lanes& to, Vector what)
                           HWY_ATTR { hn::Store(load(to, lane) + what, d, &to[lane]); };
      const auto n = load(block.impulse_n, lane), t = load(block.impulse_t, lane);
      const auto bearing = n > hn::Zero(d);
      const auto approach = choose(bearing, load(origin.approach, lane));
      store_bodies(d, Bodies<D>{n, t, approach, hn::Zero(d)}, memory, &origin.pair[lane]);
      add(gaps, choose(bearing, magnitude(load(origin.gap, lane))));
      total.force_bearing += hn::CountTrue(d, bearing);
      if (b < contacts.on_base) continue;
      const auto nx = load(block.nx, lane), ny = load(block.ny, lane);
      add(base_x, n * nx - t * ny);
      add(base_y, n * ny + t * nx);
    }
  }
  total.gap_bearing = sum(gaps);
  total.on_base_side = {sum(base_x), sum(base_y)};
  leave_vectors();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(find_for);
HWY_EXPORT(keep);

/// Resizes the arrays of a strip for the case that all its listed pairs act.
void make_room(std::span<const Pairs::Class> classes, StripContacts& contacts)
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

DetectionSums find_contacts(const Pairs& pairs, const DetectionRule& rule,
                            std::vector<StripContacts>& contacts, int threads)
{
  contacts.resize(pairs.strip_count());
  std::vector<DetectionSums> sums(contacts.size());
  for_each_part(threads, contacts.size(), [&](std::size_t s) {
    auto& strip = contacts[s];
    std::swap(strip.acting, strip.acted);
    strip.size = strip.count = 0;
    make_room(pairs.classes_of(s), strip);
    HWY_DYNAMIC_DISPATCH(find_for)(pairs, s, rule, strip, sums[s]);
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
    total.coincident |= s.coincident;
  }
  return total;
}

void forget_search(std::vector<StripContacts>& contacts)
{
  for (auto& strip : contacts) std::swap(strip.acting, strip.acted);
}

ImpulseSums keep_impulses(std::span<const StripContacts> contacts,
                          std::span<Pairs::Memory> memories, int threads)
{
  std::vector<ImpulseSums> sums(contacts.size());
  for_each_part(threads, contacts.size(), [&](std::size_t s) {
    HWY_DYNAMIC_DISPATCH(keep)(contacts[s], memories.data(), sums[s]);
  });
  ImpulseSums total;
  for (const auto& s : sums) {
    total.force_bearing += s.force_bearing;
    total.gap_bearing += s.gap_bearing;
    total.on_base_side += s.on_base_side;
  }
  return total;
}

void forget_impulses(const Pairs& pairs, std::span<const StripContacts> contacts,
                     std::span<Pairs::Memory> memories, int threads)
{
  for_each_part(threads, contacts.size(), [&](std::size_t s) {
    const auto& strip = contacts[s];
    const std::size_t first = pairs.begin_of(s);
    for (std::size_t eight = 0; eight < strip.acted.size(); ++eight) {
      auto gone = static_cast<std::uint32_t>(strip.acted[eight] & ~strip.acting[eight]);
      for (; gone != 0; gone &= gone - 1) {
        const auto pair =
            first + eight * block_lanes + static_cast<unsigned>(std::countr_zero(gone));
        memories[pair] = {};
      }
    }
  });
}

}  // namespace grseg
#endif  // HWY_ONCE
