// SPDX-License-Identifier: GPL-3.0-or-later

// Functions on vectors that several files share. Compiled once per instruction set, by files that
// include themselves for that purpose (hwy/foreach_target.h).
#if defined(GRSEG_SIM_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef GRSEG_SIM_LANES
#undef GRSEG_SIM_LANES
#else
#define GRSEG_SIM_LANES
#endif

#include "sim/contact/contact_blocks.hpp"
#include "sim/contact/targets.hpp"

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
using TagOf = hn::CappedTag<Real, lanes_of<Real>>;
using Doubles = TagOf<double>;
using Vector = hn::Vec<Doubles>;

// The following functions accept a number (double or float) or a vector.

template <class V>
constexpr bool is_number = std::is_floating_point_v<V>;
/// Result of a comparison: bool, or one bit for each lane of a vector.
template <class V>
using MaskOf = decltype(V() > V());

template <class V>
HWY_INLINE V number(double x)
{
  if constexpr (is_number<V>)
    return static_cast<V>(x);
  else
    return hn::Set(hn::DFromV<V>(), static_cast<hn::TFromV<V>>(x));
}
template <class V>
HWY_INLINE V choose(MaskOf<V> condition, V then, V otherwise)
{
  if constexpr (is_number<V>)
    return condition ? then : otherwise;
  else
    return hn::IfThenElse(condition, then, otherwise);
}
/// `then` if `condition` is true, otherwise 0.
template <class V>
HWY_INLINE V choose(MaskOf<V> condition, V then)
{
  if constexpr (is_number<V>)
    return condition ? then : 0;
  else
    return hn::IfThenElseZero(condition, then);
}
/// Larger and smaller of two numbers. If a and b are equal, also zeros of different sign, the
/// result is b, as in std::max(b, a) and std::min(b, a). NEON's own maximum would return +0.
template <class V>
HWY_INLINE V larger(V a, V b)
{
  if constexpr (is_number<V> || HWY_ARCH_ARM)
    return choose(a > b, a, b);
  else
    return hn::Max(a, b);
}
template <class V>
HWY_INLINE V smaller(V a, V b)
{
  if constexpr (is_number<V> || HWY_ARCH_ARM)
    return choose(a < b, a, b);
  else
    return hn::Min(a, b);
}
template <class V>
HWY_INLINE V magnitude(V a)
{
  if constexpr (is_number<V>)
    return std::abs(a);
  else
    return hn::Abs(a);
}
template <class V>
HWY_INLINE V minus(V a)
{
  if constexpr (is_number<V>)
    return -a;
  else
    return hn::Neg(a);
}
template <class V>
HWY_INLINE V root(V a)
{
  if constexpr (is_number<V>)
    return std::sqrt(a);
  else
    return hn::Sqrt(a);
}
/// 1/sqrt(x) of a vector of positive numbers in single precision, to 8e-7: Newton's method from a
/// guess by the exponent, with constants that make its error least (Moroz et al., Appl. Math.
/// Comput. 316, 245, 2018). A root and a division take longer. The estimates that processors offer
/// are not used, because they differ between processors.
template <class V>
HWY_INLINE V inverse_root(V x)
{
  constexpr std::uint32_t guess = 0x5f376908;
  const hn::DFromV<V> d;
  const hn::Repartition<std::uint32_t, decltype(d)> bits;
  V y = hn::BitCast(d, hn::Set(bits, guess) - hn::ShiftRight<1>(hn::BitCast(bits, x)));
  const V half = number<V>(0.5) * x;
  y = y * (number<V>(1.50087896) - (half * y) * y);
  return y * (number<V>(1.50000057) - (half * y) * y);
}
template <class Mask>
HWY_INLINE Mask both(Mask a, Mask b)
{
  if constexpr (std::is_same_v<Mask, bool>)
    return a && b;
  else
    return hn::And(a, b);
}
template <class Mask>
HWY_INLINE Mask but_not(Mask a, Mask b)
{
  if constexpr (std::is_same_v<Mask, bool>)
    return a && !b;
  else
    return hn::AndNot(b, a);
}

HWY_INLINE Vector load(const Lanes& lanes, std::size_t lane)
{
  return hn::Load(Doubles(), &lanes[lane]);
}
HWY_INLINE hn::Vec<TagOf<float>> load(const LanesOf<float>& lanes, std::size_t lane)
{
  return hn::Load(TagOf<float>(), &lanes[lane]);
}
HWY_INLINE void store(Vector numbers, Lanes& lanes, std::size_t lane)
{
  hn::Store(numbers, Doubles(), &lanes[lane]);
}
HWY_INLINE void store(hn::Vec<TagOf<float>> numbers, LanesOf<float>& lanes, std::size_t lane)
{
  hn::Store(numbers, TagOf<float>(), &lanes[lane]);
}
/// All bodies as one array of numbers.
template <int D, class Real>
HWY_INLINE Real* members(MotionOf<D, Real>* motion)
{
  return reinterpret_cast<Real*>(motion);
}

// Vectors of space, one component per entry: {f(0), f(1), ...}, and sums and products.

template <std::size_t n, class F>
HWY_INLINE auto components(const F& f) -> std::array<decltype(f(0)), n>
{
  if constexpr (n == 1)
    return {f(0)};
  else if constexpr (n == 2)
    return {f(0), f(1)};
  else
    return {f(0), f(1), f(2)};
}
template <class V, std::size_t n>
HWY_INLINE std::array<V, n> operator+(const std::array<V, n>& a, const std::array<V, n>& b)
{
  return components<n>([&](std::size_t k) HWY_ATTR { return a[k] + b[k]; });
}
template <class V, std::size_t n>
HWY_INLINE std::array<V, n> operator-(const std::array<V, n>& a, const std::array<V, n>& b)
{
  return components<n>([&](std::size_t k) HWY_ATTR { return a[k] - b[k]; });
}
template <class V, std::size_t n>
HWY_INLINE std::array<V, n> operator*(V factor, const std::array<V, n>& a)
{
  return components<n>([&](std::size_t k) HWY_ATTR { return factor * a[k]; });
}
template <class V, std::size_t n>
HWY_INLINE V dot(const std::array<V, n>& a, const std::array<V, n>& b)
{
  if constexpr (n == 1)
    return a[0] * b[0];
  else if constexpr (n == 2)
    return a[0] * b[0] + a[1] * b[1];
  else
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class V>
HWY_INLINE std::array<V, 3> cross(const std::array<V, 3>& a, const std::array<V, 3>& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Numbers, std::size_t n>
HWY_INLINE auto load(const std::array<Numbers, n>& lanes, std::size_t lane)
    -> std::array<decltype(load(lanes[0], lane)), n>
{
  return components<n>([&](std::size_t k) HWY_ATTR { return load(lanes[k], lane); });
}
template <class V, class Numbers, std::size_t n>
HWY_INLINE void store(const std::array<V, n>& numbers, std::array<Numbers, n>& lanes,
                      std::size_t lane)
{
  for (std::size_t k = 0; k < n; ++k) store(numbers[k], lanes[k], lane);
}

/// Mask as bits, the first lane in the lowest bit.
HWY_INLINE std::uint32_t bits_of(Doubles d, hn::Mask<Doubles> mask)
{
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// For each value of a byte: the indices of its set bits, ascending, one byte per index.
constexpr auto set_bits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte)
    for (std::uint8_t bit = 0, count = 0; bit < 8; ++bit)
      if ((byte >> bit & 1) != 0) table[byte][count++] = bit;
  return table;
}();

using D32 = hn::CappedTag<std::uint32_t, block_lanes>;

/// Writes `scale` (first + bit) for every set bit of `byte` to the first entries at `to`; the rest
/// of the eight entries is undefined. (With g++ 12, hn::Compress copies its tables to the stack in
/// each call.)
template <std::uint32_t scale>
HWY_INLINE void store_set_bits(std::uint32_t byte, std::size_t first, std::uint32_t* to)
{
  const D32 d;
  const hn::Rebind<std::uint8_t, D32> bytes;
  const auto begin = hn::Set(d, static_cast<std::uint32_t>(scale * first));
  for (std::size_t k = 0; k < block_lanes; k += hn::MaxLanes(d)) {
    const auto bits = hn::PromoteTo(d, hn::LoadU(bytes, &set_bits[byte][k]));
    hn::StoreU(hn::Add(begin, scale == 1 ? bits : hn::Add(bits, bits)), d, to + k);
  }
}

/// Copies each of the eight numbers at `from` whose bit of `byte` is set to the first free entry at
/// `to`; the rest of the eight entries at `to` is undefined.
HWY_INLINE void store_chosen(std::uint32_t byte, const std::uint32_t* from, std::uint32_t* to)
{
  const D32 d;
  if constexpr (hn::MaxLanes(d) == block_lanes) {
    const hn::Rebind<std::uint8_t, D32> bytes;
    const auto bits = hn::PromoteTo(d, hn::LoadU(bytes, set_bits[byte].data()));
    hn::StoreU(hn::TableLookupLanes(hn::LoadU(d, from), hn::IndicesFromVec(d, bits)), d, to);
  } else {
    for (std::size_t k = 0; k < block_lanes; ++k) to[k] = from[set_bits[byte][k]];
  }
}

/// Sum over lanes, in the same order on every instruction set.
HWY_INLINE double sum(const Lanes& s)
{
  static_assert(block_lanes == 8);
  return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}
HWY_INLINE double sum(const LanesOf<float>& s)
{
  Lanes pairs;
  for (std::size_t k = 0; k < block_lanes; ++k)
    pairs[k] = double{s[k]} + double{s[k + block_lanes]};
  return sum(pairs);
}

/// Clears the upper halves of vector registers, which would slow down code elsewhere that uses the
/// lower halves: without this the whole program was a quarter slower. Compilers usually clear them,
/// but g++ 12 did not if a function ended with a call.
HWY_INLINE void leave_vectors()
{
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  _mm256_zeroupper();
#endif
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#endif
