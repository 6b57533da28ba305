// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/single_contacts.hpp"

#include "sim/contact/parallel.hpp"
#include "sim/solver/sweep.hpp"

#include <algorithm>
#include <cmath>

// Highway compiles what follows once per instruction set.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/solver/single_contacts.cpp"
// In this order.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

using SingleD = hn::Rebind<float, D>;

/// Writes `factor` times eight doubles.
HWY_INLINE void narrow(const Lanes& from, double factor, float* to)
{
  const D d;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto scaled = hn::Mul(hn::Load(d, &from[lane]), hn::Set(d, factor));
    hn::Store(hn::DemoteTo(SingleD(), scaled), SingleD(), to + lane);
  }
}

/// Half a block of contacts, from `lane` on.
void take_half(const ContactBlock& from, double per_mass_unit, std::size_t lane, BlockOf<float>& to)
{
  narrow(from.nx, 1, &to.nx[lane]);
  narrow(from.ny, 1, &to.ny[lane]);
  narrow(from.kappa, 1, &to.kappa[lane]);
  narrow(from.mass_n, per_mass_unit, &to.mass_n[lane]);
  narrow(from.mass_t, per_mass_unit, &to.mass_t[lane]);
  narrow(from.rebound, 1, &to.rebound[lane]);
  narrow(from.impulse_n, per_mass_unit, &to.base_n[lane]);
  narrow(from.impulse_t, per_mass_unit, &to.base_t[lane]);
  std::fill_n(to.impulse_n.begin() + lane, block_lanes, 0.0F);
  std::fill_n(to.impulse_t.begin() + lane, block_lanes, 0.0F);
  std::copy_n(from.i.begin(), block_lanes, to.i.begin() + lane);
  std::copy_n(from.j.begin(), block_lanes, to.j.begin() + lane);
}

/// Blocks that share no mobile body, two by two.
void take_run(std::span<const ContactBlock> run, const ContactBlock& neutral, double per_mass_unit,
              BlockOf<float>* to)
{
  for (std::size_t b = 0; b < run.size(); b += 2, ++to) {
    take_half(run[b], per_mass_unit, 0, *to);
    take_half(b + 1 < run.size() ? run[b + 1] : neutral, per_mass_unit, block_lanes, *to);
  }
  leave_vectors();
}

/// Eight contacts' increments, from `first` on.
template <Effects with>
HWY_INLINE void give_half(const BlockOf<float>& from, std::size_t first, double mass_unit,
                          double friction, ContactBlock& to, Motion* motion)
{
  const D d;
  const auto unit = hn::Set(d, mass_unit);
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto load = [&](const BlockOf<float>::Lanes& lanes) HWY_ATTR {
      return hn::Mul(hn::PromoteTo(d, hn::Load(SingleD(), &lanes[first + lane])), unit);
    };
    const auto more = load(from.impulse_n), before = hn::Load(d, &to.impulse_n[lane]);
    const auto opened = hn::Le(more, hn::Neg(load(from.base_n)));
    const auto sum = hn::Max(hn::Add(before, more), hn::Zero(d));
    const auto normal = hn::IfThenZeroElse(opened, sum);
    hn::Store(normal, d, &to.impulse_n[lane]);
    auto more_t = hn::Zero(d);
    if constexpr (with.friction) {
      const auto limit = hn::Mul(hn::Set(d, friction), normal);
      const auto before_t = hn::Load(d, &to.impulse_t[lane]);
      const auto sum_t = hn::Add(before_t, load(from.impulse_t));
      // Zeros are positive, whatever the sign of what single precision could not resolve.
      const auto tangential = hn::Add(hn::Min(hn::Max(sum_t, hn::Neg(limit)), limit), hn::Zero(d));
      hn::Store(tangential, d, &to.impulse_t[lane]);
      more_t = hn::Sub(tangential, before_t);
    }
    apply<with>(to, lane, hn::Sub(normal, before), more_t, members(motion));
  }
}

template <Effects with>
void give_run(const BlockOf<float>* from, double mass_unit, double friction,
              std::span<ContactBlock> run, Motion* motion)
{
  for (std::size_t b = 0; b < run.size(); b += 2, ++from) {
    give_half<with>(*from, 0, mass_unit, friction, run[b], motion);
    if (b + 1 < run.size())
      give_half<with>(*from, block_lanes, mass_unit, friction, run[b + 1], motion);
  }
  leave_vectors();
}

void give_run_for(const BlockOf<float>* from, double mass_unit, double friction,
                  std::span<ContactBlock> run, Motion* motion, Effects e)
{
  if (!e.friction)
    give_run<Effects{false, false, false}>(from, mass_unit, friction, run, motion);
  else if (!e.rotation)
    give_run<Effects{true, false, false}>(from, mass_unit, friction, run, motion);
  else
    give_run<Effects{true, true, false}>(from, mass_unit, friction, run, motion);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(take_run);
HWY_EXPORT(give_run_for);

constexpr std::size_t numbers_per_body = sizeof(Motion) / sizeof(double);

/// do_run(blocks, number of their first single block) for each run of a strip; returns how many
/// single blocks there are.
template <class Run>
std::uint32_t for_each_run(const BlockRuns& strip, const Run& do_run)
{
  std::uint32_t begin = 0, singles = 0;
  for (const auto end : strip.ends) {
    do_run(strip.blocks.subspan(begin, end - begin), singles);
    singles += (end - begin + 1) / 2;
    begin = end;
  }
  return singles;
}

/// The power of two below the mass of the first grain that moves, kg.
double unit_of_mass(std::span<const Motion> motion)
{
  for (const auto& m : motion)
    if (m.inverse_mass > 0) return std::exp2(-std::ilogb(m.inverse_mass));
  return 1;
}

}  // namespace

void SingleContacts::take(std::span<const BlockRuns> strips, std::span<Motion> motion,
                          Effects effects, int threads)
{
  mass_unit_ = unit_of_mass(motion);
  strips_.resize(strips.size());
  runs_.resize(strips.size());
  const auto idle = static_cast<std::uint32_t>(numbers_per_body * (motion.size() - 1));
  for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
    apply_impulses(strips[s].blocks, motion.data(), effects);
    take_strip(strips[s], idle, strips_[s]);
    runs_[s] = {
        std::span(strips_[s].blocks).first(strips_[s].ends.empty() ? 0 : strips_[s].ends.back()),
        strips_[s].ends, strips[s].bodies};
  });
  motion_.resize(motion.size());
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const auto& m = motion[b];
      motion_[b] = {static_cast<float>(m.vx), static_cast<float>(m.vy),
                    static_cast<float>(m.rim_speed),
                    static_cast<float>(m.inverse_mass * mass_unit_)};
    }
  });
}

void SingleContacts::take_strip(const BlockRuns& contacts, std::uint32_t idle, Strip& strip) const
{
  ContactBlock neutral{};
  neutral.i.fill(idle);
  neutral.j.fill(idle);
  strip.ends.clear();
  const auto count =
      for_each_run(contacts, [&](std::span<const ContactBlock> run, std::uint32_t first) {
        strip.ends.push_back(first + static_cast<std::uint32_t>((run.size() + 1) / 2));
      });
  if (strip.blocks.size() < count) strip.blocks.resize(count);
  for_each_run(contacts, [&](std::span<const ContactBlock> run, std::uint32_t first) {
    HWY_DYNAMIC_DISPATCH(take_run)(run, neutral, 1 / mass_unit_, &strip.blocks[first]);
  });
}

void SingleContacts::give_back(std::size_t strip, const BlockRuns& contacts, double friction,
                               Effects effects, Motion* motion) const
{
  const auto& blocks = strips_[strip].blocks;
  for_each_run(contacts, [&](std::span<ContactBlock> run, std::uint32_t first) {
    HWY_DYNAMIC_DISPATCH(give_run_for)
    (&blocks[first], mass_unit_, friction, run, motion, effects);
  });
}

}  // namespace grseg
#endif  // HWY_ONCE
