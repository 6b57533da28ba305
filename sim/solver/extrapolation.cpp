// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/extrapolation.hpp"

#include "sim/contact/parallel.hpp"

#include <cmath>
#include <limits>

// Highway compiles what follows once per instruction set.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSSE3)
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
HWY_INLINE void extrapolate_numbers(double* now, double* before, std::size_t count, double factor)
{
  const D d;
  const auto f = hn::Set(d, factor);
  std::size_t k = 0;
  for (; k + hn::MaxLanes(d) <= count; k += hn::MaxLanes(d)) {
    const auto n = hn::LoadU(d, now + k);
    const auto way = hn::Sub(n, hn::LoadU(d, before + k));
    hn::StoreU(n, d, before + k);
    hn::StoreU(hn::Add(n, hn::Mul(f, way)), d, now + k);
  }
  for (; k < count; ++k) {
    const double n = now[k];
    now[k] = n + factor * (n - before[k]);
    before[k] = n;
  }
}

void extrapolate_motion(Motion* now, Motion* before, std::size_t count, double factor)
{
  extrapolate_numbers(&now->vx, &before->vx, 4 * count, factor);
  leave_vectors();
}

void extrapolate_impulses(std::span<ContactBlock> now, double* before, double factor)
{
  static_assert(offsetof(ContactBlock, impulse_t) ==
                offsetof(ContactBlock, impulse_n) + sizeof(ContactBlock::Lanes));
  constexpr std::size_t per_block = std::size_t{2} * block_lanes;
  for (std::size_t b = 0; b < now.size(); ++b)
    extrapolate_numbers(now[b].impulse_n.data(), before + per_block * b, per_block, factor);
  leave_vectors();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(extrapolate_motion);
HWY_EXPORT(extrapolate_impulses);

}  // namespace

void Extrapolation::begin()
{
  weight_ = 1;
  last_change_ = std::numeric_limits<double>::infinity();
}

void Extrapolation::remember(std::span<const BlockRuns> strips, std::span<const Motion> motion,
                             int threads)
{
  impulses_.resize(strips.size());
  for_each_part(threads, strips.size(), [&](std::size_t s) {
    const auto& blocks = strips[s].blocks;
    impulses_[s].resize(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
      impulses_[s][b] = {blocks[b].impulse_n, blocks[b].impulse_t};
  });
  motion_.assign(motion.begin(), motion.end());
}

void Extrapolation::extrapolate(std::span<const BlockRuns> strips, std::span<Motion> motion,
                                double change, int threads)
{
  if (change > last_change_) weight_ = 1;
  last_change_ = change;
  const double next = (1 + std::sqrt(1 + 4 * weight_ * weight_)) / 2;
  const double factor = (weight_ - 1) / next;
  weight_ = next;
  if (factor == 0) return remember(strips, motion, threads);
  for_each_part(threads, strips.size(), [&](std::size_t s) {
    if (!strips[s].blocks.empty()) HWY_DYNAMIC_DISPATCH(extrapolate_impulses)
    (strips[s].blocks, impulses_[s][0].n.data(), factor);
  });
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(extrapolate_motion)(&motion[begin], &motion_[begin], end - begin, factor);
  });
}

}  // namespace grseg
#endif  // HWY_ONCE
