// SPDX-License-Identifier: GPL-3.0-or-later

// Loads bodies, whose members lie side by side in memory, into one vector per member, and stores
// them; loads four or two numbers likewise. Compiled once per instruction set, by files that
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

/// Four members of several structs, one vector per member, one struct per lane.
template <class Tag>
using Fours = std::array<hn::Vec<Tag>, 4>;

#if HWY_TARGET == HWY_SCALAR

template <class Tag, class Real>
HWY_INLINE Fours<Tag> load_fours(Tag d, const Real* from, const std::uint32_t* at)
{
  const Real* row = from + *at;
  return {hn::Load(d, row), hn::Load(d, row + 1), hn::Load(d, row + 2), hn::Load(d, row + 3)};
}

template <class Tag, class Real>
HWY_INLINE void store_fours(Tag d, const Fours<Tag>& members, Real* to, const std::uint32_t* at)
{
  for (std::size_t k = 0; k < 4; ++k) hn::Store(members[k], d, to + *at + k);
}

/// The members at i plus those at j, with opposite signs for the first `opposite` of j.
template <std::size_t opposite>
HWY_INLINE Fours<Doubles> load_sums(Doubles d, const double* from, const std::uint32_t* i,
                                    const std::uint32_t* j)
{
  const auto a = load_fours(d, from, i), b = load_fours(d, from, j);
  Fours<Doubles> sums;
  for (std::size_t k = 0; k < 4; ++k) sums[k] = k < opposite ? a[k] - b[k] : a[k] + b[k];
  return sums;
}

/// Adds `members` times the number at `factor` of each row to the rows at i, and with opposite
/// signs of the first `opposite` members to the rows at j. Rows begin `shift` numbers later.
template <std::size_t factor, std::size_t opposite>
HWY_INLINE void add_products(Doubles d, const Fours<Doubles>& members, std::size_t shift,
                             double* to, const std::uint32_t* i, const std::uint32_t* j)
{
  for (std::size_t k = 0; k < 4; ++k) {
    double *a = to + *i, *b = to + *j;
    const auto to_b = k < opposite ? minus(members[k]) : members[k];
    const auto sum_a = hn::Load(d, a + shift + k) + hn::Load(d, a + factor) * members[k];
    const auto sum_b = hn::Load(d, b + shift + k) + hn::Load(d, b + factor) * to_b;
    hn::Store(sum_a, d, a + shift + k);
    hn::Store(sum_b, d, b + shift + k);
  }
}

#else

/// Vector that contains a whole row of four doubles, or half of one on narrow instruction sets.
using Row = hn::CappedTag<double, 4>;

/// Members of the rows (four doubles each) that are given. row(k, from) is the part of row k that
/// begins at member `from`: the whole row, or half of it if vectors have two lanes.
template <class Tag, class RowOf>
HWY_INLINE Fours<Tag> sort_rows(Tag d, const RowOf& row)
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

/// Whole rows are loaded and their members sorted into vectors, which takes fewer operations than
/// gathering member by member.
template <class Tag>
HWY_INLINE Fours<Tag> load_fours(Tag d, const double* from, const std::uint32_t* at)
{
  return sort_rows(
      d, [&](int k, std::size_t part) HWY_ATTR { return hn::Load(Row(), from + at[k] + part); });
}

/// Bits that an exclusive or applies to a row to change the sign of the first `count` members.
template <std::size_t count>
alignas(32) constexpr double opposite_first[] = {-0.0, count > 1 ? -0.0 : 0, count > 2 ? -0.0 : 0,
                                                 0};

/// The members at i plus those at j, with opposite signs for the first `opposite` of j.
template <std::size_t opposite>
HWY_INLINE Fours<Doubles> load_sums(Doubles d, const double* from, const std::uint32_t* i,
                                    const std::uint32_t* j)
{
  return sort_rows(d, [&](int k, std::size_t part) HWY_ATTR {
    const auto other = hn::Load(Row(), from + j[k] + part);
    const auto sign = hn::Load(Row(), opposite_first<opposite> + part);
    return hn::Add(hn::Load(Row(), from + i[k] + part), hn::Xor(other, sign));
  });
}

/// Sorts members into rows. Calls use(part, from, k) with the part of
/// row k that begins at its member `from`: the whole row, or half of it if vectors have two lanes.
template <class Tag, class Use>
HWY_INLINE void for_each_row(Tag d, const Fours<Tag>& members, const Use& use)
{
  const auto v_low = hn::InterleaveLower(d, members[0], members[1]);
  const auto v_high = hn::InterleaveUpper(d, members[0], members[1]);
  const auto s_low = hn::InterleaveLower(d, members[2], members[3]);
  const auto s_high = hn::InterleaveUpper(d, members[2], members[3]);
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

/// Inverse of load_fours(). Two lanes with the same immobile body write the same numbers.
template <class Tag>
HWY_INLINE void store_fours(Tag d, const Fours<Tag>& members, double* to, const std::uint32_t* at)
{
  for_each_row(d, members, [&](auto row, std::size_t part, int k) HWY_ATTR {
    hn::Store(row, Row(), to + at[k] + part);
  });
}

/// Adds `members` times the number at `factor` of each row to the rows at i, and with opposite
/// signs of the first `opposite` members to the rows at j. Rows begin `shift` numbers later.
/// Sorting `members` into rows takes half as many operations as sorting the rows into members.
template <std::size_t factor, std::size_t opposite>
HWY_INLINE void add_products(Doubles d, const Fours<Doubles>& members, std::size_t shift,
                             double* to, const std::uint32_t* i, const std::uint32_t* j)
{
  const auto add = [&](auto row, std::size_t part, double* body) HWY_ATTR {
    const auto times = hn::Set(Row(), body[factor]);
    const auto now = hn::Load(Row(), body + shift + part);
    hn::Store(hn::Add(now, hn::Mul(times, row)), Row(), body + shift + part);
  };
  for_each_row(d, members, [&](auto row, std::size_t part, int k) HWY_ATTR {
    add(row, part, to + i[k]);
    if constexpr (opposite > 0)
      row = hn::Xor(row, hn::Load(Row(), opposite_first<opposite> + part));
    add(row, part, to + j[k]);
  });
}

/// Transposes four by four floats within each block of 128 bits of four vectors.
template <class Tag>
HWY_INLINE Fours<Tag> transpose(Tag d, hn::Vec<Tag> r0, hn::Vec<Tag> r1, hn::Vec<Tag> r2,
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
HWY_INLINE Fours<Tag> load_fours(Tag d, const float* from, const std::uint32_t* at)
{
  const auto body = [&](int k) HWY_ATTR { return hn::Load(FourFloats(), from + at[k]); };
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
  return transpose(d, row(0), row(1), row(2), row(3));
}

template <class Tag>
HWY_INLINE void store_fours(Tag d, const Fours<Tag>& members, float* to, const std::uint32_t* at)
{
  const auto rows = transpose(d, members[0], members[1], members[2], members[3]);
  const auto store = [&](auto part, int k) HWY_ATTR { hn::Store(part, FourFloats(), to + at[k]); };
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
  store_row(rows[0], 0);
  store_row(rows[1], 1);
  store_row(rows[2], 2);
  store_row(rows[3], 3);
}

/// Exchanges the odd blocks of 128 bits of `first` and the even ones of `second`. It is its own
/// inverse.
template <class V>
HWY_INLINE void exchange_blocks(V& first, V& second)
{
  const auto even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(second), first);
  second = hn::OddEvenBlocks(second, hn::SwapAdjacentBlocks(first));
  first = even;
}

/// Eight members of several structs in two vectors of four, one struct per lane. Loads whole
/// structs if vectors are wide enough.
template <class Tag>
HWY_INLINE void load_eights(Tag d, const float* from, const std::uint32_t* at, Fours<Tag>& first,
                            Fours<Tag>& second)
{
  if constexpr (hn::MaxLanes(d) == 4) {
    first = load_fours(d, from, at);
    second = load_fours(d, from + 4, at);
  } else {
    const hn::CappedTag<float, 8> eight;
    const auto row = [&](int k) HWY_ATTR {
      if constexpr (hn::MaxLanes(d) == 8)
        return hn::Load(eight, from + at[k]);
      else
        return hn::Combine(d, hn::Load(eight, from + at[k + 8]), hn::Load(eight, from + at[k]));
    };
    first = transpose(d, row(0), row(1), row(2), row(3));
    second = transpose(d, row(4), row(5), row(6), row(7));
    for (std::size_t k = 0; k < 4; ++k) exchange_blocks(first[k], second[k]);
  }
}

template <class Tag>
HWY_INLINE void store_eights(Tag d, Fours<Tag> first, Fours<Tag> second, float* to,
                             const std::uint32_t* at)
{
  if constexpr (hn::MaxLanes(d) == 4) {
    store_fours(d, first, to, at);
    store_fours(d, second, to + 4, at);
  } else {
    for (std::size_t k = 0; k < 4; ++k) exchange_blocks(first[k], second[k]);
    const hn::CappedTag<float, 8> eight;
    const auto store = [&](const Fours<Tag>& members, const std::uint32_t* place) HWY_ATTR {
      const auto rows = transpose(d, members[0], members[1], members[2], members[3]);
      for (std::size_t k = 0; k < 4; ++k) {
        if constexpr (hn::MaxLanes(d) == 8) {
          hn::Store(rows[k], eight, to + place[k]);
        } else {
          hn::Store(hn::LowerHalf(eight, rows[k]), eight, to + place[k]);
          hn::Store(hn::UpperHalf(eight, rows[k]), eight, to + place[k + 8]);
        }
      }
    };
    store(first, at);
    store(second, at + 4);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

/// Members of several MotionOf, one body per lane; with floats the inverse mass is 0.
template <int D, class V>
struct Bodies {
  Along<D, V> v;
  V inverse_mass;
  Turning<D, V> rim;
};

template <class Tag, class Real>
HWY_INLINE void load_eights(Tag d, const Real* from, const std::uint32_t* at, Fours<Tag>& first,
                            Fours<Tag>& second)
{
  first = load_fours(d, from, at);
  second = load_fours(d, from + 4, at);
}
template <class Tag, class Real>
HWY_INLINE void store_eights(Tag d, const Fours<Tag>& first, const Fours<Tag>& second, Real* to,
                             const std::uint32_t* at)
{
  store_fours(d, first, to, at);
  store_fours(d, second, to + 4, at);
}

/// `at`: offsets of the bodies, in numbers.
template <int D, class Tag, class Real>
HWY_INLINE Bodies<D, hn::Vec<Tag>> load_bodies(Tag d, const Real* motion, const std::uint32_t* at)
{
  Fours<Tag> first, second;
  if constexpr (D == 2)
    first = load_fours(d, motion, at);
  else
    load_eights(d, motion, at, first, second);
  // A constant, so that no register is needed.
  if constexpr (std::is_same_v<Real, float>) first[D] = hn::Zero(d);
  if constexpr (D == 2)
    return {{first[0], first[1]}, first[2], {first[3]}};
  else
    return {{first[0], first[1], first[2]}, first[3], {second[0], second[1], second[2]}};
}

template <int D, class Tag, class Real>
HWY_INLINE void store_bodies(Tag d, const Bodies<D, hn::Vec<Tag>>& b, Real* motion,
                             const std::uint32_t* at)
{
  if constexpr (D == 2) {
    store_fours(d, Fours<Tag>{b.v[0], b.v[1], b.inverse_mass, b.rim[0]}, motion, at);
  } else {
    store_eights(d, Fours<Tag>{b.v[0], b.v[1], b.v[2], b.inverse_mass},
                 Fours<Tag>{b.rim[0], b.rim[1], b.rim[2], hn::Zero(d)}, motion, at);
  }
}

/// Velocity of bodies i relative to bodies j, and the sum of their inverse masses.
template <int D>
struct Relative {
  Along<D, Vector> v;
  Vector inverse_mass;
};

template <int D>
HWY_INLINE Relative<D> load_relative(Doubles d, const double* motion, const std::uint32_t* i,
                                     const std::uint32_t* j)
{
  const auto sums = load_sums<D>(d, motion, i, j);
  return {components<D>([&](std::size_t k) HWY_ATTR { return sums[k]; }), sums[D]};
}

/// Applies the impulses p to bodies i and the opposite impulses to bodies j, and subtracts `spin`
/// times the inverse mass from both rim velocities.
template <int D>
HWY_INLINE void push_bodies(Doubles d, const Along<D, Vector>& p, const Turning<D, Vector>& spin,
                            double* motion, const std::uint32_t* i, const std::uint32_t* j)
{
  const auto zero = hn::Zero(d);
  if constexpr (D == 2) {
    add_products<2, 2>(d, {p[0], p[1], zero, minus(spin[0])}, 0, motion, i, j);
  } else {
    add_products<3, 3>(d, {p[0], p[1], p[2], zero}, 0, motion, i, j);
    add_products<3, 0>(d, {minus(spin[0]), minus(spin[1]), minus(spin[2]), zero}, 4, motion, i, j);
  }
}

/// Pairs of doubles that are neighbours in memory, one pair per lane.
struct Twos {
  Vector first, second;
};

#if HWY_TARGET == HWY_SCALAR

/// Loads two neighbouring doubles per lane, the first from `from + at[lane]`.
HWY_INLINE Twos load_twos(Doubles d, const double* from, const std::uint32_t* at)
{
  return {hn::Load(d, from + *at), hn::Load(d, from + *at + 1)};
}

/// Per lane, two doubles at `from + scale i` minus two doubles at `from + scale j`.
template <std::size_t scale>
HWY_INLINE Twos load_differences(Doubles d, const double* from, const std::uint32_t* i,
                                 const std::uint32_t* j)
{
  const double *a = from + scale * *i, *b = from + scale * *j;
  return {hn::Sub(hn::Load(d, a), hn::Load(d, b)), hn::Sub(hn::Load(d, a + 1), hn::Load(d, b + 1))};
}

/// Loads consecutive pairs of doubles, one pair per lane.
HWY_INLINE Twos load_next_twos(Doubles d, const double* from)
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
