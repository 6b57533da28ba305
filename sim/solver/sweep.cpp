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
template <int D, class Real, Measured measured>
struct alignas(64) LaneResults {
  using Tag = TagOf<Real>;
  using V = hn::Vec<Tag>;
  LanesOf<Real> largest{}, squares{}, reference{};
  LanesOf<Real> sliding{};  // largest square of a tangential change

  template <Effects with>
  HWY_INLINE void add(std::size_t lane, const Relaxed<D, V>& r)
  {
    const auto add_to = [lane](LanesOf<Real>& lanes, V normal, V tangential) HWY_ATTR {
      V sum = load(lanes, lane) + normal * normal;
      if constexpr (with.friction) sum = sum + tangential;
      store(sum, lanes, lane);
    };
    const V slide = dot(r.change_t, r.change_t);
    add_to(squares, r.change_n, slide);
    if constexpr (measured == Measured::squares) return;
    store(larger(load(largest, lane), r.change_n), largest, lane);
    if constexpr (with.friction) store(larger(load(sliding, lane), slide), sliding, lane);
    add_to(reference, r.level_n, dot(r.level_t, r.level_t));
  }
  HWY_INLINE SweepResult total() const
  {
    const auto most = [](const LanesOf<Real>& l) { return *std::max_element(l.begin(), l.end()); };
    return {std::max(most(largest), std::sqrt(most(sliding))), sum(squares), sum(reference)};
  }
};

/// Relaxes blocks that share no mobile body. The bodies of the next contacts are loaded before the
/// present contacts are relaxed. A relaxation is one long chain of operations, and the processor
/// does not look far enough ahead to fill its pauses with the next relaxation by itself.
template <Effects with, int D, class Real, class Results>
HWY_INLINE void sweep_run(BlockOf<D, Real>* block, const BlockOf<D, Real>* end, Real* motion,
                          hn::Vec<TagOf<Real>> friction, Results& results)
{
  const TagOf<Real> d;
  auto a = load_bodies<D>(d, motion, &block->i[0]), b = load_bodies<D>(d, motion, &block->j[0]);
  for (; block != end; ++block) {
    for (std::size_t lane = 0; lane < lanes_of<Real>; lane += hn::MaxLanes(d)) {
      const bool same = lane + hn::MaxLanes(d) < lanes_of<Real>;
      const auto* next = same || block + 1 == end ? block : block + 1;
      const std::size_t next_lane = same ? lane + hn::MaxLanes(d) : 0;
      const auto next_a = load_bodies<D>(d, motion, &next->i[next_lane]);
      const auto next_b = load_bodies<D>(d, motion, &next->j[next_lane]);
      auto contacts = load(*block, lane);
      const auto relaxed = relax<with>(contacts, a, b, friction);
      store(contacts.impulse_n, block->impulse_n, lane);
      if constexpr (with.friction) store(contacts.impulse_t, block->impulse_t, lane);
      results.template add<with>(lane, relaxed);
      store_bodies(d, a, motion, &block->i[lane]);
      store_bodies(d, b, motion, &block->j[lane]);
      a = next_a;
      b = next_b;
    }
  }
}

template <Effects with, int D, class Real, Measured measured>
SweepResult sweep(const RunsOf<D, Real>& contacts, MotionOf<D, Real>* motion, Real friction)
{
  LaneResults<D, Real, measured> results;
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

template <Effects with, int D>
void apply(std::span<const ContactBlock<D>> blocks, Motion<D>* motion)
{
  for (const auto& c : blocks) {
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(Doubles())) {
      apply<with>(c, lane, load(c.impulse_n, lane), load(c.impulse_t, lane), members(motion));
    }
  }
  leave_vectors();
}

/// Returns sweep() with the effects of the scene as template arguments.
template <int D, class Real>
SweepOf<D, Real> sweep_for(Effects e, Measured measured)
{
  return with_flags(
      []<bool friction, bool rotation, bool restitution, bool all>() -> SweepOf<D, Real> {
        constexpr auto what = all ? Measured::all : Measured::squares;
        return sweep<Effects{friction, rotation, restitution}, D, Real, what>;
      },
      e.friction, e.rotation, e.restitution, measured == Measured::all);
}
template <int D>
void apply_for(std::span<const ContactBlock<D>> blocks, Motion<D>* motion, Effects e)
{
  with_effects(e, [&]<Effects with>() { apply<with, D>(blocks, motion); });
}
// Dispatch accepts no templates.
SweepOf<2, double> discs_doubles(Effects e, Measured m)
{
  return sweep_for<2, double>(e, m);
}
SweepOf<2, float> discs_singles(Effects e, Measured m)
{
  return sweep_for<2, float>(e, m);
}
SweepOf<3, double> spheres_doubles(Effects e, Measured m)
{
  return sweep_for<3, double>(e, m);
}
SweepOf<3, float> spheres_singles(Effects e, Measured m)
{
  return sweep_for<3, float>(e, m);
}
void apply_to_discs(std::span<const ContactBlock<2>> blocks, Motion<2>* motion, Effects e)
{
  apply_for<2>(blocks, motion, e);
}
void apply_to_spheres(std::span<const ContactBlock<3>> blocks, Motion<3>* motion, Effects e)
{
  apply_for<3>(blocks, motion, e);
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

HWY_EXPORT(discs_doubles);
HWY_EXPORT(discs_singles);
HWY_EXPORT(spheres_doubles);
HWY_EXPORT(spheres_singles);
HWY_EXPORT(apply_to_discs);
HWY_EXPORT(apply_to_spheres);
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

template <int D, class Real>
SweepOf<D, Real> choose_sweep(Effects effects, Measured measured)
{
  constexpr bool doubles = std::is_same_v<Real, double>;
  if constexpr (D == 2 && doubles)
    return HWY_DYNAMIC_DISPATCH(discs_doubles)(effects, measured);
  else if constexpr (D == 2)
    return HWY_DYNAMIC_DISPATCH(discs_singles)(effects, measured);
  else if constexpr (doubles)
    return HWY_DYNAMIC_DISPATCH(spheres_doubles)(effects, measured);
  else
    return HWY_DYNAMIC_DISPATCH(spheres_singles)(effects, measured);
}

template <int D>
void apply_impulses(std::span<const ContactBlock<D>> blocks, Motion<D>* motion, Effects effects)
{
  if constexpr (D == 2)
    HWY_DYNAMIC_DISPATCH(apply_to_discs)(blocks, motion, effects);
  else
    HWY_DYNAMIC_DISPATCH(apply_to_spheres)(blocks, motion, effects);
}

template <int D>
Relax<D> choose_relax(Effects e)
{
  // Compiled for the instruction set that every processor has: with other sets g++ 12 fuses
  // products and sums of single numbers.
  return with_flags(
      []<bool friction, bool rotation>() -> Relax<D> {
        return HWY_NAMESPACE::relax<Effects{friction, rotation, true}, Contact<D>, Motion<D>,
                                    double>;
      },
      e.friction, e.rotation);
}

template SweepOf<2, double> choose_sweep(Effects, Measured);
template SweepOf<2, float> choose_sweep(Effects, Measured);
template SweepOf<3, double> choose_sweep(Effects, Measured);
template SweepOf<3, float> choose_sweep(Effects, Measured);
template void apply_impulses<2>(std::span<const ContactBlock<2>>, Motion<2>*, Effects);
template void apply_impulses<3>(std::span<const ContactBlock<3>>, Motion<3>*, Effects);
template Relax<2> choose_relax<2>(Effects);
template Relax<3> choose_relax<3>(Effects);

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
