// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours.hpp"

#include <algorithm>
#include <limits>

// Highway compiles what follows once per instruction set.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/neighbours.cpp"
// In this order.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/lanes-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Displacements of a group of four bodies or more: eight doubles at a time, the last of which may
/// be among the eight before, too.
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
      low[p] = hn::Min(low[p], displacement);
      high[p] = hn::Max(high[p], displacement);
    }
  }
  alignas(64) Lanes l, h;
  for (std::size_t p = 0; p < parts; ++p) {
    hn::Store(low[p], d, &l[p * lanes]);
    hn::Store(high[p], d, &h[p * lanes]);
  }
  const auto least = [&](std::size_t c) { return std::min({l[c], l[c + 2], l[c + 4], l[c + 6]}); };
  const auto most = [&](std::size_t c) { return std::max({h[c], h[c + 2], h[c + 4], h[c + 6]}); };
  return {{least(0), least(1)}, {most(0), most(1)}};
}

void measure(const double* from, const double* to, std::span<const Range> groups, Extent* moved)
{
  for (const auto& group : groups) {
    auto& extent = *moved++;
    if (group.end - group.begin >= block_lanes / 2) {
      extent = measure_group(from, to, group);
      continue;
    }
    extent = {Vec2::Constant(infinity), Vec2::Constant(-infinity)};
    for (auto b = group.begin; b < group.end; ++b) {
      const Vec2 displacement{to[2 * b] - from[2 * b], to[2 * b + 1] - from[2 * b + 1]};
      extent.low = extent.low.cwiseMin(displacement);
      extent.high = extent.high.cwiseMax(displacement);
    }
  }
  leave_vectors();
}

/// One body with those of a range.
template <bool periodic>
HWY_INLINE void find_with(const Discs& discs, std::size_t a, Range range, double skin,
                          double length, std::uint32_t* found, std::size_t& count)
{
  const D d;
  const auto x = hn::Set(d, discs.x[a]), y = hn::Set(d, discs.y[a]);
  const auto reach = hn::Set(d, discs.radius[a] + skin);
  const auto mass = hn::Set(d, discs.inverse_mass[a]);
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
      const auto either_moves = hn::Add(mass, hn::LoadU(d, &discs.inverse_mass[at]));
      const auto is_near =
          hn::And(hn::Le(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(near, near)),
                  hn::Gt(either_moves, hn::Zero(d)));
      bits |= bits_of(d, is_near) << lane;
    }
    const std::size_t left = range.end - b;
    if (left < block_lanes) bits &= (1U << left) - 1;
    store_set_bits<1>(bits, b, found + count);
    count += hwy::PopCount(std::uint64_t{bits});
  }
}

template <bool periodic>
void find_near_of(const Discs& discs, const Search& s, FoundPairs& found)
{
  std::size_t count = found.begin.back();
  for (auto a = s.cell.begin; a < s.cell.end; ++a) {
    find_with<periodic>(discs, a, {a + 1, s.end}, s.skin, s.length, found.b.data(), count);
    for (const auto& range : s.elsewhere)
      find_with<periodic>(discs, a, range, s.skin, s.length, found.b.data(), count);
    found.begin.push_back(static_cast<std::uint32_t>(count));
  }
  leave_vectors();
}

void find_near_for(const Discs& discs, const Search& search, FoundPairs& found)
{
  if (search.length > 0)
    find_near_of<true>(discs, search, found);
  else
    find_near_of<false>(discs, search, found);
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

}  // namespace

void measure_displacements(std::span<const Vec2> from, std::span<const Vec2> to,
                           std::span<const Range> groups, std::span<Extent> moved)
{
  HWY_DYNAMIC_DISPATCH(measure)
  (from.data()->data(), to.data()->data(), groups, moved.data());
}

void find_near(const Discs& discs, const Search& search, FoundPairs& found)
{
  // Vectors are stored whole: room for all that could be found, and for one more vector.
  const std::size_t bodies = search.cell.end - search.cell.begin;
  std::size_t partners = search.end - search.cell.begin;
  for (const auto& range : search.elsewhere) partners += range.end - range.begin;
  const std::size_t room = found.begin.back() + bodies * partners + block_lanes;
  if (found.b.size() < room) found.b.resize(2 * room);
  HWY_DYNAMIC_DISPATCH(find_near_for)(discs, search, found);
}

}  // namespace grseg
#endif  // HWY_ONCE
