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

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Extent of the displacements of a group of at least four bodies. Eight doubles (four bodies) are
/// processed at a time; the last eight may include bodies that were already processed.
HWY_INLINE Extent measure_group(const double* from, const double* to, Range group)
{
  const D d;
  constexpr std::size_t lanes = hn::MaxLanes(D()), parts = block_lanes / lanes;
  Vector low[parts], high[parts];
  for (std::size_t p = 0; p < parts; ++p) {
    low[p] = hn::Set(d, infinity);
    high[p] = hn::Set(d, -infinity);
  }
  const std::size_t end = 2 * std::size_t{group.end};
  for (std::size_t k = 2 * std::size_t{group.begin}; k < end; k += block_lanes) {
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
    hn::Store(low[p], d, &l[p * lanes]);
    hn::Store(high[p], d, &h[p * lanes]);
  }
  const auto least = [&](std::size_t c) { return std::min({l[c], l[c + 2], l[c + 4], l[c + 6]}); };
  const auto most = [&](std::size_t c) { return std::max({h[c], h[c + 2], h[c + 4], h[c + 6]}); };
  return {Vec2(least(0), least(1)), Vec2(most(0), most(1))};
}

void measure(const double* from, const double* to, std::span<const Range> groups, Extent* moved)
{
  for (const auto& group : groups) {
    auto& extent = *moved++;
    if (group.end - group.begin >= block_lanes / 2) {
      extent = measure_group(from, to, group);
      continue;
    }
    extent.setEmpty();
    for (std::size_t b = group.begin; b < group.end; ++b)
      extent.extend(Vec2(to[2 * b] - from[2 * b], to[2 * b + 1] - from[2 * b + 1]));
  }
  leave_vectors();
}

/// Finds the partners of body `a` in a range of bodies, to whose x `offset` is added. Writes them
/// to `found` after the `count` partners found so far, and adds to `count`.
template <bool periodic>
HWY_INLINE void find_with(const Discs& discs, std::size_t a, Range range, double skin,
                          double offset, double length, std::uint32_t* found, std::size_t& count)
{
  const D d;
  const auto x = hn::Set(d, discs.x[a] - offset), y = hn::Set(d, discs.y[a]);
  const auto reach = hn::Set(d, discs.radius[a] + skin);
  for (std::size_t b = range.begin; b < range.end; b += block_lanes) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const std::size_t at = b + lane;
      auto dx = hn::Sub(x, hn::LoadU(d, &discs.x[at]));
      if constexpr (periodic) {
        const auto periods = hn::Round(hn::Mul(dx, hn::Set(d, 1 / length)));
        dx = hn::Sub(dx, hn::Mul(hn::Set(d, length), periods));
      }
      const auto dy = hn::Sub(y, hn::LoadU(d, &discs.y[at]));
      const auto near = hn::Add(reach, hn::LoadU(d, &discs.radius[at]));
      const auto squared = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
      bits |= bits_of(d, hn::Le(squared, hn::Mul(near, near))) << lane;
    }
    const std::size_t left = range.end - b;
    if (left < block_lanes) bits &= (1U << left) - 1;
    store_set_bits<1>(bits, b, found + count);
    count += hwy::PopCount(std::uint64_t{bits});
  }
}

template <bool periodic>
HWY_INLINE void find_near_of(const Discs& discs, const Search& s, double skin, FoundPairs& found)
{
  auto* b = found.b.data();
  std::size_t count = found.begin.back();
  for (auto a = s.cell.begin; a < s.cell.end; ++a) {
    find_with<periodic>(discs, a, {a + 1, s.end}, skin, 0, s.length, b, count);
    find_with<periodic>(discs, a, s.above, skin, 0, s.length, b, count);
    find_with<periodic>(discs, a, s.across, skin, s.offset, s.length, b, count);
    find_with<periodic>(discs, a, s.across_above, skin, s.offset, s.length, b, count);
    found.begin.push_back(static_cast<std::uint32_t>(count));
  }
  leave_vectors();
}

void find_near_for(const Discs& discs, const Search& search, double skin, FoundPairs& found)
{
  if (search.length > 0)
    find_near_of<true>(discs, search, skin, found);
  else
    find_near_of<false>(discs, search, skin, found);
}

/// One bit for each of eight memories: 1 if it has an impulse.
HWY_INLINE std::uint32_t bearing(const double* memory)
{
  const D d;
  static constexpr std::uint32_t rows[block_lanes] = {0, 4, 8, 12, 16, 20, 24, 28};
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto [n, t, approach, unused] = load_bodies(d, memory, rows + lane);
    bits |= bits_of(d, hn::Not(both(n == hn::Zero(d), t == hn::Zero(d)))) << lane;
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

void carry_all(const CarryOver& task, std::uint32_t first, std::uint32_t last)
{
  const auto& found = *task.found;
  for (std::size_t eight = first; eight < last; eight += block_lanes) {
    for (auto bits = bearing(task.memory + 4 * eight); bits != 0; bits &= bits - 1) {
      const std::size_t k = eight + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      const auto i = task.place[task.i[k] / 2], j = task.place[task.j[k] / 2];
      auto f = find_pair(found, std::min(i, j), std::max(i, j));
      if (f == found.size()) f = find_pair(found, std::max(i, j), std::min(i, j));
      if (f == found.size()) continue;
      std::copy_n(task.memory + 4 * k, 4, task.to_memory + 4 * std::size_t{task.number[f]});
    }
  }
  leave_vectors();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(measure);
HWY_EXPORT(find_near_for);
HWY_EXPORT(carry_all);

}  // namespace

void measure_displacements(std::span<const Vec2> from, std::span<const Vec2> to,
                           std::span<const Range> groups, std::span<Extent> moved)
{
  HWY_DYNAMIC_DISPATCH(measure)
  (from.data()->data(), to.data()->data(), groups, moved.data());
}

void find_near(const Discs& discs, const Search& search, double skin, FoundPairs& found)
{
  // Space for all possible pairs and one vector more, because only whole vectors are stored.
  const auto size = [](Range range) { return std::size_t{range.end} - range.begin; };
  const std::size_t partners = search.end - search.cell.begin + size(search.above) +
                               size(search.across) + size(search.across_above);
  const std::size_t room = found.begin.back() + size(search.cell) * partners + block_lanes;
  if (found.b.size() < room) found.b.resize(2 * room);
  HWY_DYNAMIC_DISPATCH(find_near_for)(discs, search, skin, found);
}

void carry_over(const CarryOver& task, std::uint32_t first, std::uint32_t last)
{
  HWY_DYNAMIC_DISPATCH(carry_all)(task, first, last);
}

}  // namespace grseg
#endif  // HWY_ONCE
