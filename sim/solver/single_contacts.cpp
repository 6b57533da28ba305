// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/single_contacts.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/solver/single_contacts.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

using SingleD = hn::Rebind<float, D>;

/// Applies the first guesses of a block of eight contacts, and copies it to half a block of
/// sixteen, from lane `first` on.
template <Effects with>
HWY_INLINE void take_half(const ContactBlock& from, std::size_t first, Motion* motion,
                          BlockOf<float>& to)
{
  const D d;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto store = [&](Vector numbers, BlockOf<float>::Lanes& lanes) HWY_ATTR {
      hn::Store(hn::DemoteTo(SingleD(), numbers), SingleD(), &lanes[first + lane]);
    };
    const auto c = load(from, lane);
    auto a = load_bodies(d, members(motion), &from.i[lane]);
    auto b = load_bodies(d, members(motion), &from.j[lane]);
    push<with>(c, a, b, push_of<with>(c.nx, c.ny, c.kappa, c.impulse_n, c.impulse_t));
    store_bodies(d, a, members(motion), &from.i[lane]);
    store_bodies(d, b, members(motion), &from.j[lane]);

    const auto w_nn = a.inverse_mass + b.inverse_mass;
    store(c.nx, to.nx);
    store(c.ny, to.ny);
    store(c.kappa, to.kappa);
    store(c.mass_n * a.inverse_mass, to.weight_i);
    store(c.mass_n * b.inverse_mass, to.weight_j);
    store(c.mass_t * w_nn, to.mass_ratio);
    store(c.rebound, to.rebound);
    store(c.impulse_n * w_nn, to.base_n);
    store(c.impulse_t * w_nn, to.base_t);
  }
  std::fill_n(to.impulse_n.begin() + first, block_lanes, 0.0F);
  std::fill_n(to.impulse_t.begin() + first, block_lanes, 0.0F);
  std::copy_n(from.i.begin(), block_lanes, to.i.begin() + first);
  std::copy_n(from.j.begin(), block_lanes, to.j.begin() + first);
}

/// Copies the blocks of a run, two blocks of eight contacts into one of sixteen.
template <Effects with>
void take_run(std::span<const ContactBlock> run, const ContactBlock& neutral, Motion* motion,
              BlockOf<float>* to)
{
  for (std::size_t b = 0; b < run.size(); b += 2, ++to) {
    take_half<with>(run[b], 0, motion, *to);
    take_half<with>(b + 1 < run.size() ? run[b + 1] : neutral, block_lanes, motion, *to);
  }
  leave_vectors();
}

void take_run_for(std::span<const ContactBlock> run, const ContactBlock& neutral, Motion* motion,
                  BlockOf<float>* to, Effects e)
{
  with_effects(e, [&]<Effects with>() { take_run<with>(run, neutral, motion, to); });
}

void take_motion(std::span<const Motion> from, MotionOf<float>* to)
{
  const hn::CappedTag<double, 4> d;
  const hn::Rebind<float, decltype(d)> single;
  alignas(32) static constexpr double without_mass[] = {1, 1, 1, 0};
  for (const auto& body : from) {
    auto* number = members(to++);
    for (std::size_t k = 0; k < 4; k += hn::MaxLanes(d)) {
      const auto kept = hn::Mul(hn::Load(d, &body.vx + k), hn::Load(d, without_mass + k));
      hn::Store(hn::DemoteTo(single, kept), single, number + k);
    }
  }
  leave_vectors();
}

/// Adds the increments of eight contacts, from lane `first` on, to a block and its bodies.
template <Effects with>
HWY_INLINE void give_half(const BlockOf<float>& from, std::size_t first, double friction,
                          ContactBlock& to, Motion* motion)
{
  const D d;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto single = [&](const BlockOf<float>::Lanes& lanes) HWY_ATTR {
      return hn::PromoteTo(d, hn::Load(SingleD(), &lanes[first + lane]));
    };
    const auto c = load(to, lane);
    const auto more = single(from.impulse_n), sum = c.impulse_n + more * c.mass_n;
    const auto opened = more <= minus(single(from.base_n));
    const auto normal = hn::IfThenZeroElse(opened, larger(sum, hn::Zero(d)));
    hn::Store(normal, d, &to.impulse_n[lane]);
    auto more_t = hn::Zero(d);
    if constexpr (with.friction) {
      const auto limit = hn::Set(d, friction) * normal;
      const auto sum_t = c.impulse_t + single(from.impulse_t) * c.mass_n;
      // Adding zero turns -0 into 0: the sign of an unresolved increment has no meaning.
      const auto tangential = smaller(larger(sum_t, minus(limit)), limit) + hn::Zero(d);
      hn::Store(tangential, d, &to.impulse_t[lane]);
      more_t = tangential - c.impulse_t;
    }
    apply<with>(to, lane, normal - c.impulse_n, more_t, members(motion));
  }
}

template <Effects with>
void give_run(const BlockOf<float>* from, double friction, std::span<ContactBlock> run,
              Motion* motion)
{
  for (std::size_t b = 0; b < run.size(); b += 2, ++from) {
    give_half<with>(*from, 0, friction, run[b], motion);
    if (b + 1 < run.size()) give_half<with>(*from, block_lanes, friction, run[b + 1], motion);
  }
  leave_vectors();
}

void give_run_for(const BlockOf<float>* from, double friction, std::span<ContactBlock> run,
                  Motion* motion, Effects e)
{
  with_effects(e, [&]<Effects with>() { give_run<with>(from, friction, run, motion); });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(take_run_for);
HWY_EXPORT(take_motion);
HWY_EXPORT(give_run_for);

constexpr std::size_t numbers_per_body = sizeof(Motion) / sizeof(double);

/// Calls do_run(blocks of the run, index of its first block in single precision) for each run of a
/// strip; returns the number of blocks in single precision.
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

}  // namespace

void SingleContacts::take(std::span<const BlockRuns> strips, std::span<Motion> motion,
                          Effects effects, int threads)
{
  strips_.resize(strips.size());
  runs_.resize(strips.size());
  const auto idle = static_cast<std::uint32_t>(numbers_per_body * (motion.size() - 1));
  for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
    take_strip(strips[s], motion.data(), idle, effects, strips_[s]);
    runs_[s] = {
        std::span(strips_[s].blocks).first(strips_[s].ends.empty() ? 0 : strips_[s].ends.back()),
        strips_[s].ends, strips[s].bodies};
  });
  motion_.resize(motion.size());
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(take_motion)(motion.subspan(begin, end - begin), &motion_[begin]);
  });
}

void SingleContacts::take_strip(const BlockRuns& contacts, Motion* motion, std::uint32_t idle,
                                Effects effects, Strip& strip)
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
    HWY_DYNAMIC_DISPATCH(take_run_for)(run, neutral, motion, &strip.blocks[first], effects);
  });
}

void SingleContacts::give_back(std::size_t strip, const BlockRuns& contacts, double friction,
                               Effects effects, Motion* motion) const
{
  const auto& blocks = strips_[strip].blocks;
  for_each_run(contacts, [&](std::span<ContactBlock> run, std::uint32_t first) {
    HWY_DYNAMIC_DISPATCH(give_run_for)
    (&blocks[first], friction, run, motion, effects);
  });
}

}  // namespace grseg
#endif  // HWY_ONCE
