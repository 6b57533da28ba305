// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/extrapolation.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// Highway compiles what follows once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/solver/extrapolation.cpp"
// In this order.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/lanes-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// now += factor (now - before), and before = what now was.
template <class Real>
HWY_INLINE void extrapolate_numbers(Real* now, Real* before, std::size_t count, Real factor)
{
  const TagOf<Real> d;
  const auto f = hn::Set(d, factor);
  std::size_t k = 0;
  for (; k + hn::MaxLanes(d) <= count; k += hn::MaxLanes(d)) {
    const auto n = hn::LoadU(d, now + k);
    const auto way = hn::Sub(n, hn::LoadU(d, before + k));
    hn::StoreU(n, d, before + k);
    hn::StoreU(hn::Add(n, hn::Mul(f, way)), d, now + k);
  }
  for (; k < count; ++k) {
    const Real n = now[k];
    now[k] = n + factor * (n - before[k]);
    before[k] = n;
  }
}

template <class Real>
HWY_INLINE void extrapolate_blocks(std::span<BlockOf<Real>> now, Real* before, Real factor)
{
  using Numbers = typename BlockOf<Real>::Lanes;
  using Members = MembersOf<Real, Numbers>;
  static_assert(offsetof(Members, impulse_t) == offsetof(Members, impulse_n) + sizeof(Numbers));
  constexpr std::size_t per_block = std::size_t{2} * lanes_of<Real>;
  for (std::size_t b = 0; b < now.size(); ++b)
    extrapolate_numbers(now[b].impulse_n.data(), before + per_block * b, per_block, factor);
  leave_vectors();
}

template <class Real>
HWY_INLINE void extrapolate_bodies(MotionOf<Real>* now, MotionOf<Real>* before, std::size_t count,
                                   Real factor)
{
  extrapolate_numbers(&now->vx, &before->vx, 4 * count, factor);
  leave_vectors();
}

// Dispatch takes no templates.
void blocks_double(std::span<ContactBlock> now, double* before, double factor)
{
  extrapolate_blocks(now, before, factor);
}
void blocks_single(std::span<BlockOf<float>> now, float* before, float factor)
{
  extrapolate_blocks(now, before, factor);
}
void bodies_double(Motion* now, Motion* before, std::size_t count, double factor)
{
  extrapolate_bodies(now, before, count, factor);
}
void bodies_single(MotionOf<float>* now, MotionOf<float>* before, std::size_t count, float factor)
{
  extrapolate_bodies(now, before, count, factor);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(blocks_double);
HWY_EXPORT(blocks_single);
HWY_EXPORT(bodies_double);
HWY_EXPORT(bodies_single);

void extrapolate_impulses(std::span<ContactBlock> now, double* before, double factor)
{
  HWY_DYNAMIC_DISPATCH(blocks_double)(now, before, factor);
}
void extrapolate_impulses(std::span<BlockOf<float>> now, float* before, float factor)
{
  HWY_DYNAMIC_DISPATCH(blocks_single)(now, before, factor);
}
void extrapolate_motion(Motion* now, Motion* before, std::size_t count, double factor)
{
  HWY_DYNAMIC_DISPATCH(bodies_double)(now, before, count, factor);
}
void extrapolate_motion(MotionOf<float>* now, MotionOf<float>* before, std::size_t count,
                        float factor)
{
  HWY_DYNAMIC_DISPATCH(bodies_single)(now, before, count, factor);
}

}  // namespace

template <class Real>
void ExtrapolationOf<Real>::begin(std::span<const RunsOf<Real>> strips,
                                  std::span<const MotionOf<Real>> motion, int threads)
{
  weight_ = first_weight;
  last_change_ = std::numeric_limits<double>::infinity();
  remember(strips, motion, threads);
}

template <class Real>
void ExtrapolationOf<Real>::remember(std::span<const RunsOf<Real>> strips,
                                     std::span<const MotionOf<Real>> motion, int threads)
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

template <class Real>
void ExtrapolationOf<Real>::extrapolate(std::span<const RunsOf<Real>> strips,
                                        std::span<MotionOf<Real>> motion, double change,
                                        int threads)
{
  if (change > last_change_) weight_ = 1;
  last_change_ = change;
  const auto factor = static_cast<Real>(next_factor());
  if (factor == 0) return remember(strips, motion, threads);
  for_each_part(threads, strips.size(), [&](std::size_t s) {
    if (!strips[s].blocks.empty())
      extrapolate_impulses(strips[s].blocks, impulses_[s][0].n.data(), factor);
  });
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    extrapolate_motion(&motion[begin], &motion_[begin], end - begin, factor);
  });
}

template <class Real>
double ExtrapolationOf<Real>::next_factor()
{
  const double next = (1 + std::sqrt(1 + 4 * weight_ * weight_)) / 2;
  return (std::exchange(weight_, next) - 1) / next;
}

template <class Real>
void ExtrapolationOf<Real>::extrapolate_strip(std::span<const RunsOf<Real>> strips,
                                              std::size_t strip, std::span<MotionOf<Real>> motion,
                                              double factor)
{
  const auto& [blocks, ends, bodies] = strips[strip];
  const auto f = static_cast<Real>(factor);
  if (!blocks.empty()) extrapolate_impulses(blocks, impulses_[strip][0].n.data(), f);
  if (bodies.end > bodies.begin)
    extrapolate_motion(&motion[bodies.begin], &motion_[bodies.begin], bodies.end - bodies.begin, f);
}

template class ExtrapolationOf<double>;
template class ExtrapolationOf<float>;

}  // namespace grseg
#endif  // HWY_ONCE
