// SPDX-License-Identifier: GPL-3.0-or-later

// Loads bodies, whose four members lie side by side in memory, into one vector per member, and
// stores them; loads pairs of numbers likewise. Compiled once per instruction set, by files that
// include themselves for that purpose (hwy/foreach_target.h).
#if defined(GRSEG_SIM_BODIES) == defined(HWY_TARGET_TOGGLE)
#ifdef GRSEG_SIM_BODIES
#undef GRSEG_SIM_BODIES
#else
#define GRSEG_SIM_BODIES
#endif

#include "sim/contact/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// Members of several MotionOf, one vector per member, one body per lane; with floats the last
/// vector is 0. With doubles it also loads other structs of four doubles, such as Pairs::Memory.
template <class Tag>
struct Bodies {
  hn::Vec<Tag> vx, vy, rim_speed, inverse_mass;
};

/// Velocity of bodies i relative to bodies j, and the sum of their inverse masses.
struct Relative {
  Vector vx, vy, inverse_mass;
};

#if HWY_TARGET == HWY_SCALAR

template <class Tag, class Real>
HWY_INLINE Bodies<Tag> load_bodies(Tag d, const Real* motion, const std::uint32_t* at)
{
  const Real* body = motion + *at;
  return {hn::Load(d, body), hn::Load(d, body + 1), hn::Load(d, body + 2), hn::Load(d, body + 3)};
}

template <class Tag, class Real>
HWY_INLINE void store_bodies(Tag d, const Bodies<Tag>& b, Real* motion, const std::uint32_t* at)
{
  Real* body = motion + *at;
  hn::Store(b.vx, d, body);
  hn::Store(b.vy, d, body + 1);
  hn::Store(b.rim_speed, d, body + 2);
}

HWY_INLINE Relative load_relative(D d, const double* motion, const std::uint32_t* i,
                                  const std::uint32_t* j)
{
  const auto a = load_bodies(d, motion, i), b = load_bodies(d, motion, j);
  return {a.vx - b.vx, a.vy - b.vy, a.inverse_mass + b.inverse_mass};
}

HWY_INLINE void push_bodies(D d, Vector px, Vector py, Vector spin, double* motion,
                            const std::uint32_t* i, const std::uint32_t* j)
{
  auto a = load_bodies(d, motion, i), b = load_bodies(d, motion, j);
  a = {a.vx + a.inverse_mass * px, a.vy + a.inverse_mass * py, a.rim_speed - a.inverse_mass * spin,
       a.inverse_mass};
  b = {b.vx - b.inverse_mass * px, b.vy - b.inverse_mass * py, b.rim_speed - b.inverse_mass * spin,
       b.inverse_mass};
  store_bodies(d, a, motion, i);
  store_bodies(d, b, motion, j);
}

#else

/// Vector that contains a whole body (four doubles), or half of one on narrow instruction sets.
using Row = hn::CappedTag<double, 4>;

/// Members of the bodies whose rows (four doubles each) are given. row(k, from) is the part of row
/// k that begins at member `from`: the whole row, or half of it if vectors have two lanes.
template <class Tag, class RowOf>
HWY_INLINE Bodies<Tag> sort_rows(Tag d, const RowOf& row)
{
  if constexpr (hn::MaxLanes(d) == 8) {
    const auto r01 = hn::Combine(d, row(1, 0), row(0, 0));
    const auto r23 = hn::Combine(d, row(3, 0), row(2, 0));
    const auto r45 = hn::Combine(d, row(5, 0), row(4, 0));
    const auto r67 = hn::Combine(d, row(7, 0), row(6, 0));
    const auto even03 = hn::ConcatEven(d, r23, r01), odd03 = hn::ConcatOdd(d, r23, r01);
    const auto even47 = hn::ConcatEven(d, r67, r45), odd47 = hn::ConcatOdd(d, r67, r45);
    return {hn::ConcatEven(d, even47, even03), hn::ConcatEven(d, odd47, odd03),
            hn::ConcatOdd(d, even47, even03), hn::ConcatOdd(d, odd47, odd03)};
  } else if constexpr (hn::MaxLanes(d) == 4) {
    const auto r0 = row(0, 0), r1 = row(1, 0), r2 = row(2, 0), r3 = row(3, 0);
    const auto low01 = hn::InterleaveLower(d, r0, r1), high01 = hn::InterleaveUpper(d, r0, r1);
    const auto low23 = hn::InterleaveLower(d, r2, r3), high23 = hn::InterleaveUpper(d, r2, r3);
    return {hn::ConcatLowerLower(d, low23, low01), hn::ConcatLowerLower(d, high23, high01),
            hn::ConcatUpperUpper(d, low23, low01), hn::ConcatUpperUpper(d, high23, high01)};
  } else {
    static_assert(hn::MaxLanes(d) == 2);
    const auto v0 = row(0, 0), s0 = row(0, 2), v1 = row(1, 0), s1 = row(1, 2);
    return {hn::InterleaveLower(d, v0, v1), hn::InterleaveUpper(d, v0, v1),
            hn::InterleaveLower(d, s0, s1), hn::InterleaveUpper(d, s0, s1)};
  }
}

/// Whole bodies are loaded and their members sorted into vectors, which takes fewer operations
/// than gathering member by member.
template <class Tag>
HWY_INLINE Bodies<Tag> load_bodies(Tag d, const double* motion, const std::uint32_t* at)
{
  return sort_rows(
      d, [&](int k, std::size_t from) HWY_ATTR { return hn::Load(Row(), motion + at[k] + from); });
}

/// Bits that an exclusive or applies to a row to change the sign of the velocity only.
alignas(32) constexpr double opposite_velocity[] = {-0.0, -0.0, 0.0, 0.0};

HWY_INLINE Relative load_relative(D d, const double* motion, const std::uint32_t* i,
                                  const std::uint32_t* j)
{
  const auto sums = sort_rows(d, [&](int k, std::size_t from) HWY_ATTR {
    const auto other = hn::Load(Row(), motion + j[k] + from);
    const auto sign = hn::Load(Row(), opposite_velocity + from);
    return hn::Add(hn::Load(Row(), motion + i[k] + from), hn::Xor(other, sign));
  });
  return {sums.vx, sums.vy, sums.inverse_mass};
}

/// Sorts the members of bodies into rows, one per body. Calls use(part, from, k) with the part of
/// row k that begins at its member `from`: the whole row, or half of it if vectors have two lanes.
template <class Tag, class Use>
HWY_INLINE void for_each_row(Tag d, const Bodies<Tag>& b, const Use& use)
{
  const auto v_low = hn::InterleaveLower(d, b.vx, b.vy);
  const auto v_high = hn::InterleaveUpper(d, b.vx, b.vy);
  const auto s_low = hn::InterleaveLower(d, b.rim_speed, b.inverse_mass);
  const auto s_high = hn::InterleaveUpper(d, b.rim_speed, b.inverse_mass);
  if constexpr (hn::MaxLanes(d) == 8) {
    const hn::Half<Tag> h;
    const auto r04 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(s_low), v_low);
    const auto r15 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(s_high), v_high);
    const auto r26 = hn::OddEvenBlocks(s_low, hn::SwapAdjacentBlocks(v_low));
    const auto r37 = hn::OddEvenBlocks(s_high, hn::SwapAdjacentBlocks(v_high));
    use(hn::LowerHalf(h, r04), 0, 0), use(hn::LowerHalf(h, r15), 0, 1);
    use(hn::LowerHalf(h, r26), 0, 2), use(hn::LowerHalf(h, r37), 0, 3);
    use(hn::UpperHalf(h, r04), 0, 4), use(hn::UpperHalf(h, r15), 0, 5);
    use(hn::UpperHalf(h, r26), 0, 6), use(hn::UpperHalf(h, r37), 0, 7);
  } else if constexpr (hn::MaxLanes(d) == 4) {
    use(hn::ConcatLowerLower(d, s_low, v_low), 0, 0);
    use(hn::ConcatLowerLower(d, s_high, v_high), 0, 1);
    use(hn::ConcatUpperUpper(d, s_low, v_low), 0, 2);
    use(hn::ConcatUpperUpper(d, s_high, v_high), 0, 3);
  } else {
    use(v_low, 0, 0), use(s_low, 2, 0);
    use(v_high, 0, 1), use(s_high, 2, 1);
  }
}

/// Inverse of load_bodies(). Two lanes with the same immobile body write the same numbers.
template <class Tag>
HWY_INLINE void store_bodies(Tag d, const Bodies<Tag>& b, double* motion, const std::uint32_t* at)
{
  for_each_row(d, b, [&](auto part, std::size_t from, int k) HWY_ATTR {
    hn::Store(part, Row(), motion + at[k] + from);
  });
}

/// Applies the impulses (px, py) to bodies i and the opposite impulses to bodies j, and subtracts
/// `spin` times the inverse mass from both rim speeds. Sorting impulses into rows takes half as
/// many operations as sorting bodies into vectors.
HWY_INLINE void push_bodies(D d, Vector px, Vector py, Vector spin, double* motion,
                            const std::uint32_t* i, const std::uint32_t* j)
{
  const auto add = [&](auto part, std::size_t from, double* body) HWY_ATTR {
    const auto inverse_mass = hn::Set(Row(), body[3]);
    const auto now = hn::Load(Row(), body + from);
    hn::Store(hn::Add(now, hn::Mul(inverse_mass, part)), Row(), body + from);
  };
  for_each_row(d, Bodies<D>{px, py, hn::Neg(spin), hn::Zero(d)},
               [&](auto part, std::size_t from, int k) HWY_ATTR {
                 add(part, from, motion + i[k]);
                 add(hn::Xor(part, hn::Load(Row(), opposite_velocity + from)), from, motion + j[k]);
               });
}

/// Transposes four by four floats within each block of 128 bits of four vectors.
template <class Tag>
HWY_INLINE Bodies<Tag> transpose(Tag d, hn::Vec<Tag> r0, hn::Vec<Tag> r1, hn::Vec<Tag> r2,
                                 hn::Vec<Tag> r3)
{
  const hn::Repartition<double, Tag> twos;
  const auto low01 = hn::BitCast(twos, hn::InterleaveLower(d, r0, r1));
  const auto low23 = hn::BitCast(twos, hn::InterleaveLower(d, r2, r3));
  const auto high01 = hn::BitCast(twos, hn::InterleaveUpper(d, r0, r1));
  const auto high23 = hn::BitCast(twos, hn::InterleaveUpper(d, r2, r3));
  return {hn::BitCast(d, hn::InterleaveLower(twos, low01, low23)),
          hn::BitCast(d, hn::InterleaveUpper(twos, low01, low23)),
          hn::BitCast(d, hn::InterleaveLower(twos, high01, high23)),
          hn::BitCast(d, hn::InterleaveUpper(twos, high01, high23))};
}

using FourFloats = hn::FixedTag<float, 4>;

template <class Tag>
HWY_INLINE Bodies<Tag> load_bodies(Tag d, const float* motion, const std::uint32_t* at)
{
  const auto body = [&](int k) HWY_ATTR { return hn::Load(FourFloats(), motion + at[k]); };
  const auto row = [&](int k) HWY_ATTR {
    if constexpr (hn::MaxLanes(d) == 4) {
      return body(k);
    } else if constexpr (hn::MaxLanes(d) == 8) {
      return hn::Combine(d, body(k + 4), body(k));
    } else {
      static_assert(hn::MaxLanes(d) == 16);
      const hn::Half<Tag> h;
      return hn::Combine(d, hn::Combine(h, body(k + 12), body(k + 8)),
                         hn::Combine(h, body(k + 4), body(k)));
    }
  };
  auto bodies = transpose(d, row(0), row(1), row(2), row(3));
  bodies.inverse_mass = hn::Zero(d);  // a constant, so that no register is needed
  return bodies;
}

template <class Tag>
HWY_INLINE void store_bodies(Tag d, const Bodies<Tag>& b, float* motion, const std::uint32_t* at)
{
  const auto rows = transpose(d, b.vx, b.vy, b.rim_speed, b.inverse_mass);
  const auto store = [&](auto part, int k)
                         HWY_ATTR { hn::Store(part, FourFloats(), motion + at[k]); };
  const auto store_row = [&](hn::Vec<Tag> row, int k) HWY_ATTR {
    if constexpr (hn::MaxLanes(d) == 4) {
      store(row, k);
    } else if constexpr (hn::MaxLanes(d) == 8) {
      store(hn::LowerHalf(FourFloats(), row), k);
      store(hn::UpperHalf(FourFloats(), row), k + 4);
    } else {
      const hn::Half<Tag> h;
      const auto low = hn::LowerHalf(h, row), high = hn::UpperHalf(h, row);
      store(hn::LowerHalf(FourFloats(), low), k);
      store(hn::UpperHalf(FourFloats(), low), k + 4);
      store(hn::LowerHalf(FourFloats(), high), k + 8);
      store(hn::UpperHalf(FourFloats(), high), k + 12);
    }
  };
  store_row(rows.vx, 0);
  store_row(rows.vy, 1);
  store_row(rows.rim_speed, 2);
  store_row(rows.inverse_mass, 3);
}

#endif  // HWY_TARGET == HWY_SCALAR

/// Pairs of doubles that are neighbours in memory, one pair per lane.
struct Twos {
  Vector first, second;
};

#if HWY_TARGET == HWY_SCALAR

/// Loads two neighbouring doubles per lane, the first from `from + at[lane]`.
HWY_INLINE Twos load_twos(D d, const double* from, const std::uint32_t* at)
{
  return {hn::Load(d, from + *at), hn::Load(d, from + *at + 1)};
}

/// Per lane, two doubles at `from + scale i` minus two doubles at `from + scale j`.
template <std::size_t scale>
HWY_INLINE Twos load_differences(D d, const double* from, const std::uint32_t* i,
                                 const std::uint32_t* j)
{
  const double *a = from + scale * *i, *b = from + scale * *j;
  return {hn::Sub(hn::Load(d, a), hn::Load(d, b)), hn::Sub(hn::Load(d, a + 1), hn::Load(d, b + 1))};
}

/// Loads consecutive pairs of doubles, one pair per lane.
HWY_INLINE Twos load_next_twos(D d, const double* from)
{
  return {hn::Load(d, from), hn::Load(d, from + 1)};
}

#else

/// First and second members of the pairs that `two(lane)` returns.
template <class Tag, class Two>
HWY_INLINE Twos sort_twos(Tag d, const Two& two)
{
  auto even = two(0), odd = two(1);
  if constexpr (hn::MaxLanes(d) == 2) {
    return {hn::InterleaveLower(d, even, odd), hn::InterleaveUpper(d, even, odd)};
  } else if constexpr (hn::MaxLanes(d) == 4) {
    const auto e = hn::Combine(d, two(2), even), o = hn::Combine(d, two(3), odd);
    return {hn::InterleaveLower(d, e, o), hn::InterleaveUpper(d, e, o)};
  } else {
    static_assert(hn::MaxLanes(d) == 8);
    const hn::Half<Tag> h;
    const auto e = hn::Combine(d, hn::Combine(h, two(6), two(4)), hn::Combine(h, two(2), even));
    const auto o = hn::Combine(d, hn::Combine(h, two(7), two(5)), hn::Combine(h, two(3), odd));
    return {hn::InterleaveLower(d, e, o), hn::InterleaveUpper(d, e, o)};
  }
}

using TwoDoubles = hn::FixedTag<double, 2>;

/// Loads two neighbouring doubles per lane, the first from `from + at[lane]`.
template <class Tag>
HWY_INLINE Twos load_twos(Tag d, const double* from, const std::uint32_t* at)
{
  return sort_twos(d, [&](int k) HWY_ATTR { return hn::Load(TwoDoubles(), from + at[k]); });
}

/// Per lane, two doubles at `from + scale i` minus two doubles at `from + scale j`.
template <std::size_t scale, class Tag>
HWY_INLINE Twos load_differences(Tag d, const double* from, const std::uint32_t* i,
                                 const std::uint32_t* j)
{
  return sort_twos(d, [&](int k) HWY_ATTR {
    return hn::Sub(hn::Load(TwoDoubles(), from + scale * i[k]),
                   hn::Load(TwoDoubles(), from + scale * j[k]));
  });
}

/// Loads consecutive pairs of doubles, one pair per lane.
template <class Tag>
HWY_INLINE Twos load_next_twos(Tag d, const double* from)
{
  const auto low = hn::LoadU(d, from), high = hn::LoadU(d, from + hn::MaxLanes(d));
  return {hn::ConcatEven(d, high, low), hn::ConcatOdd(d, high, low)};
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#endif
