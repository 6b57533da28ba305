// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/sweep.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>

// Highway compiles what follows once per instruction set.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/solver/sweep.cpp"
// In this order.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// SweepResult, lane by lane.
struct alignas(64) LaneResults {
  Lanes largest{}, squares{}, reference{};

  HWY_INLINE void add(std::size_t lane, Vector change, Vector level)
  {
    const D d;
    hn::Store(hn::Max(hn::Load(d, &largest[lane]), change), d, &largest[lane]);
    hn::Store(hn::Add(hn::Load(d, &squares[lane]), hn::Mul(change, change)), d, &squares[lane]);
    hn::Store(hn::Add(hn::Load(d, &reference[lane]), hn::Mul(level, level)), d, &reference[lane]);
  }
  HWY_INLINE SweepResult total() const
  {
    return {*std::max_element(largest.begin(), largest.end()), sum(squares), sum(reference)};
  }
};

/// Relaxes blocks that share no mobile body. The bodies of the next contacts are loaded before the
/// present ones are relaxed: a relaxation is one long chain of operations, and the processor does
/// not look far enough ahead to fill its pauses with the next one by itself.
template <Effects with>
HWY_INLINE void sweep_run(ContactBlock* block, const ContactBlock* end, double* motion,
                          Vector friction, LaneResults& results)
{
  const D d;
  auto a = load_bodies(d, motion, &block->i[0]), b = load_bodies(d, motion, &block->j[0]);
  for (; block != end; ++block) {
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const bool same = lane + hn::MaxLanes(d) < block_lanes;
      const auto* next = same || block + 1 == end ? block : block + 1;
      const std::size_t next_lane = same ? lane + hn::MaxLanes(d) : 0;
      const auto next_a = load_bodies(d, motion, &next->i[next_lane]);
      const auto next_b = load_bodies(d, motion, &next->j[next_lane]);
      relax<with>(*block, lane, a, b, friction, results);
      store_bodies(d, a, motion, &block->i[lane]);
      store_bodies(d, b, motion, &block->j[lane]);
      a = next_a;
      b = next_b;
    }
  }
}

template <Effects with>
SweepResult sweep(const BlockRuns& contacts, Motion* motion, double friction)
{
  const D d;
  LaneResults results;
  const auto coefficient = hn::Set(d, friction);
  auto* blocks = contacts.blocks.data();
  std::uint32_t begin = 0;
  for (const auto end : contacts.ends) {
    sweep_run<with>(blocks + begin, blocks + end, members(motion), coefficient, results);
    begin = end;
  }
  const auto total = results.total();
  leave_vectors();
  return total;
}

template <Effects with>
void apply(std::span<const ContactBlock> blocks, Motion* motion)
{
  const D d;
  for (const auto& c : blocks) {
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      auto a = load_bodies(d, members(motion), &c.i[lane]),
           b = load_bodies(d, members(motion), &c.j[lane]);
      const auto nx = hn::Load(d, &c.nx[lane]), ny = hn::Load(d, &c.ny[lane]);
      const auto normal = hn::Load(d, &c.impulse_n[lane]);
      auto px = hn::Mul(normal, nx), py = hn::Mul(normal, ny), spin = hn::Zero(d);
      if constexpr (with.friction) {
        const auto tangential = hn::Load(d, &c.impulse_t[lane]);
        px = hn::Sub(px, hn::Mul(tangential, ny));
        py = hn::Add(py, hn::Mul(tangential, nx));
        const auto lever = hn::Mul(hn::Set(d, disc_rim_factor), hn::Load(d, &c.kappa[lane]));
        spin = hn::Mul(lever, tangential);
      }
      push<with>(a, b, px, py, spin);
      store_bodies(d, a, members(motion), &c.i[lane]);
      store_bodies(d, b, members(motion), &c.j[lane]);
    }
  }
  leave_vectors();
}

/// The only place where a scene's effects become a compile-time choice.
Sweep sweep_for(Effects e)
{
  // [friction][rotation][restitution]
  static constexpr Sweep table[2][2][2] = {
      {{sweep<Effects{false, false, false}>, sweep<Effects{false, false, true}>},
       {sweep<Effects{false, true, false}>, sweep<Effects{false, true, true}>}},
      {{sweep<Effects{true, false, false}>, sweep<Effects{true, false, true}>},
       {sweep<Effects{true, true, false}>, sweep<Effects{true, true, true}>}}};
  return table[e.friction][e.rotation][e.restitution];
}

void apply_for(std::span<const ContactBlock> blocks, Motion* motion, Effects e)
{
  if (!e.friction)
    apply<Effects{false, false, false}>(blocks, motion);
  else if (!e.rotation)
    apply<Effects{true, false, false}>(blocks, motion);
  else
    apply<Effects{true, true, false}>(blocks, motion);
}

std::int64_t target()
{
  return HWY_TARGET;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(sweep_for);
HWY_EXPORT(apply_for);
HWY_EXPORT(target);

std::string name_of(std::int64_t target)
{
  switch (target) {
    case HWY_AVX3:
      return "avx512";
    case HWY_AVX2:
      return "avx2";
    case HWY_SSE4:
      return "sse4";
    case HWY_SCALAR:
    case HWY_EMU128:
      return "scalar";
    default:
      return hwy::TargetName(target);
  }
}

}  // namespace

Sweep choose_sweep(Effects effects)
{
  return HWY_DYNAMIC_DISPATCH(sweep_for)(effects);
}

void apply_impulses(std::span<const ContactBlock> blocks, Motion* motion, Effects effects)
{
  HWY_DYNAMIC_DISPATCH(apply_for)(blocks, motion, effects);
}

std::vector<std::string> instruction_sets()
{
  std::vector<std::string> names;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) names.push_back(name_of(target));
  return names;
}

std::string instruction_set()
{
  return name_of(HWY_DYNAMIC_DISPATCH(target)());
}

void use_instruction_set(const std::string& name)
{
  hwy::SetSupportedTargetsForTest(0);
  std::int64_t chosen = 0;
  for (const auto target : hwy::SupportedAndGeneratedTargets())
    if (name == name_of(target)) chosen = target;
  if (chosen == 0 && !name.empty()) {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    throw UsageError(fmt::format("unknown instruction set '{}'; this machine has {}", name,
                                 fmt::join(instruction_sets(), ", ")));
  }
  hwy::SetSupportedTargetsForTest(chosen);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace grseg
#endif  // HWY_ONCE
