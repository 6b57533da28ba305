// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_list_lanes.hpp"

#include <algorithm>
#include <limits>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/neighbours/pair_list_lanes.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/bodies-inl.hpp"
// clang-format on

#ifndef GRSEG_SIM_PAIR_LOOPS
#define GRSEG_SIM_PAIR_LOOPS
namespace grseg {
namespace {
/// The loops below, compiled for an instruction set.
template <int D>
struct PairLoops {
  void (*measure)(std::span<const Position<D>> from, std::span<const Position<D>> to,
                  std::span<const Range>, Extent<D>*);
  void (*find_near)(const Members<D>&, const Search<D>&, double skin, FoundPairs&);
  void (*carry_over)(const CarryOver<D>&, std::uint32_t first, std::uint32_t last);
};
}  // namespace
}  // namespace grseg
#endif

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Extent of the displacements of a group with at least eight numbers, which are processed eight at
/// a time; the last eight may include bodies that were already processed.
template <int D>
HWY_INLINE Extent<D> measure_group(const double* from, const double* to, Range group)
{
  const Doubles d;
  constexpr std::size_t lanes = hn::MaxLanes(Doubles()), parts = block_lanes / lanes;
  constexpr std::size_t per_body = position_doubles<D>;
  Vector low[parts], high[parts];
  for (std::size_t p = 0; p < parts; ++p) {
    low[p] = hn::Set(d, infinity);
    high[p] = hn::Set(d, -infinity);
  }
  const std::size_t end = per_body * std::size_t{group.end};
  for (std::size_t k = per_body * std::size_t{group.begin}; k < end; k += block_lanes) {
    const std::size_t at = std::min(k, end - block_lanes);
    for (std::size_t p = 0; p < parts; ++p) {
      const auto displacement =
          hn::Sub(hn::LoadU(d, to + at + p * lanes), hn::LoadU(d, from + at + p * lanes));
      low[p] = smaller(low[p], displacement);
      high[p] = larger(high[p], displacement);
    }
  }
  alignas(64) Lanes l, h;
  for (std::size_t p = 0; p < parts; ++p) {
    store(low[p], l, p * lanes);
    store(high[p], h, p * lanes);
  }
  Extent<D> extent;
  for (std::size_t k = 0; k < block_lanes; k += per_body)
    for (std::size_t c = 0; c < D; ++c) {
      const auto row = static_cast<Eigen::Index>(c);
      extent.min()[row] = std::min(extent.min()[row], l[k + c]);
      extent.max()[row] = std::max(extent.max()[row], h[k + c]);
    }
  return extent;
}

template <int D>
void measure(std::span<const Position<D>> from, std::span<const Position<D>> to,
             std::span<const Range> groups, Extent<D>* moved)
{
  for (const auto& group : groups) {
    auto& extent = *moved++;
    if ((group.end - group.begin) * position_doubles<D> >= block_lanes) {
      extent = measure_group<D>(from.data()->data(), to.data()->data(), group);
      continue;
    }
    extent.setEmpty();
    for (std::size_t b = group.begin; b < group.end; ++b) extent.extend(point<D>(to[b] - from[b]));
  }
  leave_vectors();
}

/// Partners of a body: an array with room for eight more than there are, and their number.
struct Partners {
  std::uint32_t* body;
  std::size_t count;

  /// Adds first + bit for each set bit.
  HWY_INLINE void add(std::uint32_t bits, std::size_t first)
  {
    store_set_bits<1>(bits, first, body + count);
    count += hwy::PopCount(std::uint64_t{bits});
  }
};

/// Finds the partners of body `a` in a range of bodies, to whose x and z `shift` is added.
/// Appends them to `near` or, if their gap is above near_part of the skin, to `far`.
template <bool periodic, int D>
HWY_INLINE void find_with(const Members<D>& members, std::size_t a, Range bodies,
                          const Horizontal<D>& shift, double skin, const Horizontal<D>& period,
                          Partners& near, Partners& far)
{
  const Doubles d;
  constexpr auto periodic_axis = [](std::size_t axis) { return axis / 2; };  // x or z
  const auto own = components<D>([&](std::size_t k) HWY_ATTR {
    return hn::Set(d, k == 1 ? members.x[k][a] : members.x[k][a] - shift[periodic_axis(k)]);
  });
  const auto reach = hn::Set(d, members.radius[a] + skin);
  const auto beyond = hn::Set(d, (1 - near_part<D>)*skin);
  for (std::size_t b = bodies.begin; b < bodies.end; b += block_lanes) {
    std::uint32_t bits = 0, near_bits = 0;
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const std::size_t at = b + lane;
      const auto apart = components<D>([&](std::size_t k) HWY_ATTR {
        const auto difference = hn::Sub(own[k], hn::LoadU(d, &members.x[k][at]));
        if (!periodic || k == 1) return difference;
        const double length = period[periodic_axis(k)];
        const auto periods =
            hn::Round(hn::Mul(difference, hn::Set(d, length > 0 ? 1 / length : 0)));
        return hn::Sub(difference, hn::Mul(hn::Set(d, length), periods));
      });
      const auto squared = dot(apart, apart);
      const auto within = [&](Vector distance) HWY_ATTR {
        return bits_of(d, squared <= distance * distance) << lane;
      };
      const auto farthest = hn::Add(reach, hn::LoadU(d, &members.radius[at]));
      bits |= within(farthest);
      if constexpr (near_part<D> < 1) near_bits |= within(farthest - beyond);
    }
    const std::size_t left = bodies.end - b;
    if (left < block_lanes) bits &= (1U << left) - 1;
    if constexpr (near_part<D> < 1) {
      far.add(bits & ~near_bits, b);
      bits &= near_bits;
    }
    near.add(bits, b);
  }
}

/// The partners of body `a` in a part, without the partners that borders of cells keep out of reach.
template <int D>
HWY_INLINE Range within_reach(const Members<D>& members, std::size_t a, const Search<D>& search,
                              const typename Search<D>::Part& part, double skin)
{
  // A little more, because borders are rounded.
  const double reach = (1 + 1e-6) * (members.radius[a] + members.largest_radius + skin);
  double left = reach * reach;  // m^2, square of the reach along x
  const auto square = [](double away) { return away > 0 ? away * away : 0; };
  for (std::size_t k = 0; k + 1 < D; ++k)
    left -= square(part.signs[k] * (part.border[k] - members.x[k + 1][a]));
  if (left < 0) return {0, 0};
  const double x = members.x[0][a];
  return {square(x - search.left) > left ? part.column.begin : part.bodies.begin,
          square(search.right - x) > left ? part.column.end : part.bodies.end};
}

template <bool periodic, int D>
HWY_INLINE void find_near_of(const Members<D>& members, const Search<D>& s, double skin,
                             FoundPairs& found)
{
  Partners near{found.b.data(), found.begin.back()};
  for (auto a = s.cell.begin; a < s.cell.end; ++a) {
    Partners far{found.scratch.data(), 0};
    auto own = within_reach(members, a, s,
                            {.bodies = {a + 1, s.end}, .column = {a + 1, s.cell.end}}, skin);
    find_with<periodic, D>(members, a, own, {}, skin, s.period, near, far);
    for (std::size_t p = 0; p < s.count; ++p)
      find_with<periodic, D>(members, a, within_reach(members, a, s, s.parts[p], skin),
                             s.parts[p].shift, skin, s.period, near, far);
    found.far.push_back(static_cast<std::uint32_t>(near.count));
    std::copy_n(far.body, far.count, near.body + near.count);
    near.count += far.count;
    found.begin.push_back(static_cast<std::uint32_t>(near.count));
  }
  leave_vectors();
}

template <int D>
void find_near_for(const Members<D>& members, const Search<D>& search, double skin,
                   FoundPairs& found)
{
  if (std::any_of(search.period.begin(), search.period.end(), [](double p) { return p > 0; }))
    find_near_of<true, D>(members, search, skin, found);
  else
    find_near_of<false, D>(members, search, skin, found);
}

/// One bit for each of eight memories: 1 if it has an impulse.
template <int D>
HWY_INLINE std::uint32_t bearing(const double* memory)
{
  const Doubles d;
  static constexpr auto rows = [] {
    std::array<std::uint32_t, block_lanes> offsets{};
    for (std::uint32_t k = 0; k < block_lanes; ++k) offsets[k] = memory_doubles * k;
    return offsets;
  }();
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto memories = load_fours(d, memory, &rows[lane]);
    auto none = memories[0] == hn::Zero(d);
    for (std::size_t k = 1; k < 1 + std::tuple_size_v<Turning<D, double>>; ++k)
      none = both(none, memories[k] == hn::Zero(d));
    bits |= bits_of(d, hn::Not(none)) << lane;
  }
  return bits;
}

/// Index of the pair (a, b) in `found`; found.size() if it is not there.
HWY_INLINE std::size_t find_pair(const FoundPairs& found, std::uint32_t a, std::uint32_t b)
{
  const D32 d;
  const std::size_t end = found.begin[a + 1];
  for (std::size_t f = found.begin[a]; f < end; f += hn::MaxLanes(d)) {
    const auto same = hn::Eq(hn::LoadU(d, &found.b[f]), hn::Set(d, b));
    const auto first = hn::FindFirstTrue(d, same);
    if (first >= 0 && f + static_cast<std::size_t>(first) < end)
      return f + static_cast<std::size_t>(first);
  }
  return found.size();
}

template <int D>
void carry_all(const CarryOver<D>& task, std::uint32_t first, std::uint32_t last)
{
  const auto& [old, place, found, number, pairs] = task;
  for (std::size_t eight = first; eight < last; eight += block_lanes) {
    for (auto bits = bearing<D>(&old.memory[eight].n); bits != 0; bits &= bits - 1) {
      const std::size_t k = eight + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      const auto i = place[old.i[k] / position_doubles<D>],
                 j = place[old.j[k] / position_doubles<D>];
      auto f = find_pair(found, std::min(i, j), std::max(i, j));
      if (f == found.size()) f = find_pair(found, std::max(i, j), std::min(i, j));
      if (f == found.size()) continue;
      const auto n = number[f];
      pairs.memory[n] = old.memory[k];
      if constexpr (D == 3) {
        pairs.approach[n] = old.approach[k];
        // The friction of spheres is a vector on i, which may have been j. (t turns with n.)
        if (pairs.i[n] != position_doubles<D> * i)
          for (auto& t : pairs.memory[n].t) t = -t;
      }
    }
  }
  leave_vectors();
}

// Dispatch accepts no templates.
PairLoops<2> loops_for_discs()
{
  return {measure<2>, find_near_for<2>, carry_all<2>};
}
PairLoops<3> loops_for_spheres()
{
  return {measure<3>, find_near_for<3>, carry_all<3>};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(loops_for_discs);
HWY_EXPORT(loops_for_spheres);

template <int D>
PairLoops<D> loops()
{
  if constexpr (D == 2)
    return HWY_DYNAMIC_DISPATCH(loops_for_discs)();
  else
    return HWY_DYNAMIC_DISPATCH(loops_for_spheres)();
}

}  // namespace

template <int D>
void measure_displacements(std::span<const Position<D>> from, std::span<const Position<D>> to,
                           std::span<const Range> groups, std::span<Extent<D>> moved)
{
  loops<D>().measure(from, to, groups, moved.data());
}

template <int D>
void find_near(const Members<D>& members, const Search<D>& search, double skin, FoundPairs& found)
{
  // Vectors are stored whole: room for all that could be found, and for one more vector.
  const auto size = [](Range range) { return std::size_t{range.end} - range.begin; };
  std::size_t partners = search.end - search.cell.begin;
  for (std::size_t p = 0; p < search.count; ++p) partners += size(search.parts[p].bodies);
  const std::size_t room = found.begin.back() + size(search.cell) * partners + block_lanes;
  if (found.b.size() < room) found.b.resize(2 * room);
  if (found.scratch.size() < partners + block_lanes)
    found.scratch.resize(2 * partners + block_lanes);
  loops<D>().find_near(members, search, skin, found);
}

template <int D>
void carry_over(const CarryOver<D>& task, std::uint32_t first, std::uint32_t last)
{
  loops<D>().carry_over(task, first, last);
}

template void measure_displacements<2>(std::span<const Position<2>>, std::span<const Position<2>>,
                                       std::span<const Range>, std::span<Extent<2>>);
template void measure_displacements<3>(std::span<const Position<3>>, std::span<const Position<3>>,
                                       std::span<const Range>, std::span<Extent<3>>);
template void find_near(const Members<2>&, const Search<2>&, double, FoundPairs&);
template void find_near(const Members<3>&, const Search<3>&, double, FoundPairs&);
template void carry_over(const CarryOver<2>&, std::uint32_t, std::uint32_t);
template void carry_over(const CarryOver<3>&, std::uint32_t, std::uint32_t);

}  // namespace grseg
#endif  // HWY_ONCE
