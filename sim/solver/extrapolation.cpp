// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/extrapolation.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/solver/extrapolation.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/lanes-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// Sets now = now + factor (now - before), and before = the old `now`, in `rows` rows of `count`
/// numbers. Rows of `before` are contiguous; rows of `now` begin `apart` numbers from each other.
template <class Real>
HWY_INLINE void extrapolate_rows(Real* now, std::size_t apart, Real* before, std::size_t count,
                                 std::size_t rows, Real factor)
{
  const TagOf<Real> d;
  const auto f = hn::Set(d, factor);
  for (; rows > 0; --rows, now += apart, before += count) {
    std::size_t k = 0;
    for (; k + hn::MaxLanes(d) <= count; k += hn::MaxLanes(d)) {
      const auto n = hn::LoadU(d, now + k), way = n - hn::LoadU(d, before + k);
      hn::StoreU(n, d, before + k);
      hn::StoreU(n + f * way, d, now + k);
    }
    for (; k < count; ++k) {
      const Real n = now[k];
      now[k] = n + factor * (n - before[k]);
      before[k] = n;
    }
  }
  leave_vectors();
}

// Highway cannot dispatch templates.
void rows_of_doubles(double* now, std::size_t apart, double* before, std::size_t count,
                     std::size_t rows, double factor)
{
  extrapolate_rows(now, apart, before, count, rows, factor);
}
void rows_of_singles(float* now, std::size_t apart, float* before, std::size_t count,
                     std::size_t rows, float factor)
{
  extrapolate_rows(now, apart, before, count, rows, factor);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(rows_of_doubles);
HWY_EXPORT(rows_of_singles);

template <class Real>
void extrapolate_rows(Real* now, std::size_t apart, Real* before, std::size_t count,
                      std::size_t rows, Real factor)
{
  if constexpr (std::is_same_v<Real, double>)
    HWY_DYNAMIC_DISPATCH(rows_of_doubles)(now, apart, before, count, rows, factor);
  else
    HWY_DYNAMIC_DISPATCH(rows_of_singles)(now, apart, before, count, rows, factor);
}

template <int D, class Real, class Impulses>
void extrapolate_impulses(std::span<BlockOf<D, Real>> now, Impulses* before, Real factor)
{
  using Members = MembersOf<D, Real, LanesOf<Real>>;
  static_assert(offsetof(Members, impulse_t) ==
                offsetof(Members, impulse_n) + sizeof(LanesOf<Real>));
  if (!now.empty())
    extrapolate_rows(now[0].impulse_n.data(), sizeof(BlockOf<D, Real>) / sizeof(Real),
                     before->n.data(), sizeof(Impulses) / sizeof(Real), now.size(), factor);
}

template <int D, class Real>
void extrapolate_motion(std::span<MotionOf<D, Real>> now, MotionOf<D, Real>* before, Real factor)
{
  if (!now.empty())
    extrapolate_rows(now[0].v.data(), 0, before->v.data(), numbers_per_body<D> * now.size(), 1,
                     factor);
}

}  // namespace

template <int D, class Real>
void ExtrapolationOf<D, Real>::begin(std::span<const RunsOf<D, Real>> strips,
                                     std::span<const MotionOf<D, Real>> motion, int threads)
{
  weight_ = first_weight;
  last_change_ = std::numeric_limits<double>::infinity();
  remember(strips, motion, threads);
}

template <int D, class Real>
void ExtrapolationOf<D, Real>::remember(std::span<const RunsOf<D, Real>> strips,
                                        std::span<const MotionOf<D, Real>> motion, int threads)
{
  impulses_.resize(strips.size());
  for_each_part(threads, strips.size(), [&](std::size_t s) {
    const auto& blocks = strips[s].blocks;
    impulses_[s].resize(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
      impulses_[s][b] = {blocks[b].impulse_n, blocks[b].impulse_t};
  });
  motion_.resize(motion.size());
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    std::copy(motion.begin() + static_cast<std::ptrdiff_t>(begin),
              motion.begin() + static_cast<std::ptrdiff_t>(end),
              motion_.begin() + static_cast<std::ptrdiff_t>(begin));
  });
}

template <int D, class Real>
void ExtrapolationOf<D, Real>::extrapolate(std::span<const RunsOf<D, Real>> strips,
                                           std::span<MotionOf<D, Real>> motion, double change,
                                           int threads)
{
  if (change > last_change_) weight_ = 1;
  last_change_ = change;
  const auto factor = static_cast<Real>(next_factor());
  if (factor == 0) return remember(strips, motion, threads);
  for_each_part(threads, strips.size(), [&](std::size_t s) {
    extrapolate_impulses<D, Real>(strips[s].blocks, impulses_[s].data(), factor);
  });
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    extrapolate_motion<D, Real>(motion.subspan(begin, end - begin), &motion_[begin], factor);
  });
}

template <int D, class Real>
double ExtrapolationOf<D, Real>::next_factor()
{
  const double next = (1 + std::sqrt(1 + 4 * weight_ * weight_)) / 2;
  return (std::exchange(weight_, next) - 1) / next;
}

template <int D, class Real>
void ExtrapolationOf<D, Real>::extrapolate_strip(std::span<const RunsOf<D, Real>> strips,
                                                 std::size_t strip,
                                                 std::span<MotionOf<D, Real>> motion, double factor)
{
  const auto& [blocks, ends, bodies] = strips[strip];
  const auto f = static_cast<Real>(factor);
  extrapolate_impulses<D, Real>(blocks, impulses_[strip].data(), f);
  extrapolate_motion<D, Real>(motion.subspan(bodies.begin, bodies.end - bodies.begin),
                              motion_.data() + bodies.begin, f);
}

template class ExtrapolationOf<2, double>;
template class ExtrapolationOf<2, float>;
template class ExtrapolationOf<3, double>;
template class ExtrapolationOf<3, float>;

}  // namespace grseg
#endif  // HWY_ONCE
