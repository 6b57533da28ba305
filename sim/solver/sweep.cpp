// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/sweep.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/solver/sweep.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

/// SweepResult, one number per lane.
template <class Real, Measured measured>
struct alignas(64) LaneResults {
  using Tag = TagOf<Real>;
  using V = hn::Vec<Tag>;
  typename BlockOf<Real>::Lanes largest{}, squares{}, reference{};

  template <Effects with>
  HWY_INLINE void add(std::size_t lane, const Relaxed<V>& r)
  {
    const auto update = [&](typename BlockOf<Real>::Lanes& lanes, auto next, V normal,
                            [[maybe_unused]] V tangential) HWY_ATTR {
      V found = next(load(lanes, lane), normal);
      if constexpr (with.friction) found = next(found, tangential);
      hn::Store(found, Tag(), &lanes[lane]);
    };
    const auto add_square = [](V sum, V x) HWY_ATTR { return sum + x * x; };
    update(squares, add_square, r.change_n, r.change_t);
    if constexpr (measured == Measured::squares) return;
    update(
        largest, [](V most, V x) HWY_ATTR { return larger(most, x); }, r.change_n, r.change_t);
    update(reference, add_square, r.level_n, r.level_t);
  }
  HWY_INLINE SweepResult total() const
  {
    return {*std::max_element(largest.begin(), largest.end()), sum(squares), sum(reference)};
  }
};

/// Relaxes blocks that share no mobile body. The bodies of the next contacts are loaded before the
/// present contacts are relaxed. A relaxation is one long chain of operations, and the processor
/// does not look far enough ahead to fill its pauses with the next relaxation by itself.
template <Effects with, class Real, class Results>
HWY_INLINE void sweep_run(BlockOf<Real>* block, const BlockOf<Real>* end, Real* motion,
                          hn::Vec<TagOf<Real>> friction, Results& results)
{
  const TagOf<Real> d;
  auto a = load_bodies(d, motion, &block->i[0]), b = load_bodies(d, motion, &block->j[0]);
  for (; block != end; ++block) {
    for (std::size_t lane = 0; lane < lanes_of<Real>; lane += hn::MaxLanes(d)) {
      const bool same = lane + hn::MaxLanes(d) < lanes_of<Real>;
      const auto* next = same || block + 1 == end ? block : block + 1;
      const std::size_t next_lane = same ? lane + hn::MaxLanes(d) : 0;
      const auto next_a = load_bodies(d, motion, &next->i[next_lane]);
      const auto next_b = load_bodies(d, motion, &next->j[next_lane]);
      auto contacts = load(*block, lane);
      const auto relaxed = relax<with>(contacts, a, b, friction);
      hn::Store(contacts.impulse_n, d, &block->impulse_n[lane]);
      if constexpr (with.friction) hn::Store(contacts.impulse_t, d, &block->impulse_t[lane]);
      results.template add<with>(lane, relaxed);
      store_bodies(d, a, motion, &block->i[lane]);
      store_bodies(d, b, motion, &block->j[lane]);
      a = next_a;
      b = next_b;
    }
  }
}

template <Effects with, class Real, Measured measured>
SweepResult sweep(const RunsOf<Real>& contacts, MotionOf<Real>* motion, Real friction)
{
  LaneResults<Real, measured> results;
  const auto coefficient = hn::Set(TagOf<Real>(), friction);
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
      apply<with>(c, lane, load(c.impulse_n, lane), load(c.impulse_t, lane), members(motion));
    }
  }
  leave_vectors();
}

/// Returns sweep() with the effects of the scene as template arguments.
template <class Real>
SweepOf<Real> sweep_for(Effects e, Measured measured)
{
  return with_flags(
      []<bool friction, bool rotation, bool restitution, bool all>() -> SweepOf<Real> {
        constexpr auto what = all ? Measured::all : Measured::squares;
        return sweep<Effects{friction, rotation, restitution}, Real, what>;
      },
      e.friction, e.rotation, e.restitution, measured == Measured::all);
}
// Highway cannot dispatch templates.
SweepOf<double> double_sweep_for(Effects e, Measured measured)
{
  return sweep_for<double>(e, measured);
}
SweepOf<float> single_sweep_for(Effects e, Measured measured)
{
  return sweep_for<float>(e, measured);
}

void apply_for(std::span<const ContactBlock> blocks, Motion* motion, Effects e)
{
  with_effects(e, [&]<Effects with>() { apply<with>(blocks, motion); });
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

HWY_EXPORT(double_sweep_for);
HWY_EXPORT(single_sweep_for);
HWY_EXPORT(apply_for);
HWY_EXPORT(target);

/// Highway's name of an instruction set in lower case; "avx512" for its AVX3.
std::string name_of(std::int64_t target)
{
  std::string name = hwy::TargetName(target);
  if (name == "AVX3") return "avx512";
  for (auto& letter : name) letter = static_cast<char>(std::tolower(letter));
  return name;
}

}  // namespace

template <>
SweepOf<double> choose_sweep<double>(Effects effects, Measured measured)
{
  return HWY_DYNAMIC_DISPATCH(double_sweep_for)(effects, measured);
}
template <>
SweepOf<float> choose_sweep<float>(Effects effects, Measured measured)
{
  return HWY_DYNAMIC_DISPATCH(single_sweep_for)(effects, measured);
}

void apply_impulses(std::span<const ContactBlock> blocks, Motion* motion, Effects effects)
{
  HWY_DYNAMIC_DISPATCH(apply_for)(blocks, motion, effects);
}

Relax choose_relax(Effects e)
{
  // Compiled for the instruction set that every processor has: for others, g++ 12 would fuse
  // products and sums of scalars.
  return with_flags(
      []<bool friction, bool rotation>() -> Relax {
        return HWY_NAMESPACE::relax<Effects{friction, rotation, true}, Contact, Motion, double>;
      },
      e.friction, e.rotation);
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
    throw UsageError(fmt::format("--isa: unknown instruction set '{}'; this machine has {}", name,
                                 fmt::join(instruction_sets(), ", ")));
  }
  hwy::SetSupportedTargetsForTest(chosen);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace grseg
#endif  // HWY_ONCE
