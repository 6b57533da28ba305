// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/impulse_memory.hpp"

#include "sim/contact/parallel.hpp"

#include <bit>

// Highway compiles the rest of this file once per instruction set.
#include "sim/contact/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/neighbours/impulse_memory.cpp"
// The order of these headers matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "sim/contact/contact_law-inl.hpp"
#include "sim/neighbours/pair_memories-inl.hpp"
// clang-format on

#ifndef GRSEG_SIM_KEEP
#define GRSEG_SIM_KEEP
namespace grseg {
namespace {
/// keep() below, compiled for an instruction set.
template <int D>
using Keep = void (*)(const StripContacts<D>&, Pairs<D>&, ImpulseSums<D>&);
}  // namespace
}  // namespace grseg
#endif

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

template <int D>
void keep(const StripContacts<D>& contacts, Pairs<D>& pairs, ImpulseSums<D>& total)
{
  const Doubles d;
  alignas(64) Lanes gaps{}, held_back{}, largest{};
  alignas(64) Along<D, Lanes> on_base{};
  for (std::size_t b = 0; b < contacts.size; ++b) {
    const auto& block = contacts.blocks[b];
    const auto& origin = contacts.origins[b];
    for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
      const auto add = [&](Lanes& to, Vector what)
                           HWY_ATTR { store(load(to, lane) + what, to, lane); };
      const auto n = load(block.impulse_n, lane);
      const auto t = load(block.impulse_t, lane);
      const auto bearing = n > hn::Zero(d);
      const auto approach = choose(bearing, load(origin.approach, lane));
      store_memories<D>({n, t, approach}, pairs, &origin.pair[lane]);
      add(gaps, choose(bearing, magnitude(load(origin.gap, lane))));
      add(held_back, choose(approach > hn::Zero(d), n * (approach - load(block.rebound, lane))));
      store(larger(load(largest, lane), n), largest, lane);
      total.force_bearing += hn::CountTrue(d, bearing);
      if (b < contacts.on_base) continue;
      const auto impulse = in_space(load(block.n, lane), n, t);
      for (std::size_t k = 0; k < D; ++k) add(on_base[k], impulse[k]);
    }
  }
  total.gap_bearing = sum(gaps);
  total.held_back = sum(held_back) / 2;
  total.largest = *std::max_element(largest.begin(), largest.end());
  for (std::size_t k = 0; k < D; ++k)
    total.on_base_side[static_cast<Eigen::Index>(k)] = sum(on_base[k]);
  leave_vectors();
}

// Dispatch accepts no templates.
Keep<2> keep_of_discs()
{
  return keep<2>;
}
Keep<3> keep_of_spheres()
{
  return keep<3>;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(keep_of_discs);
HWY_EXPORT(keep_of_spheres);

template <int D>
Keep<D> choose_keep()
{
  if constexpr (D == 2)
    return HWY_DYNAMIC_DISPATCH(keep_of_discs)();
  else
    return HWY_DYNAMIC_DISPATCH(keep_of_spheres)();
}

}  // namespace

template <int D>
ImpulseSums<D> keep_impulses(std::span<const StripContacts<D>> contacts, Pairs<D>& pairs,
                             int threads)
{
  std::vector<ImpulseSums<D>> sums(contacts.size());
  const auto keep = choose_keep<D>();
  for_each_part(threads, contacts.size(),
                [&](std::size_t s) { keep(contacts[s], pairs, sums[s]); });
  ImpulseSums<D> total;
  for (const auto& s : sums) {
    total.force_bearing += s.force_bearing;
    total.gap_bearing += s.gap_bearing;
    total.held_back += s.held_back;
    total.largest = std::max(total.largest, s.largest);
    total.on_base_side += s.on_base_side;
  }
  return total;
}

template <int D>
void forget_impulses(std::span<const StripContacts<D>> contacts, Pairs<D>& pairs, int threads)
{
  for_each_part(threads, contacts.size(), [&](std::size_t s) {
    const auto& strip = contacts[s];
    const std::size_t first = pairs.begin_of(s);
    for (std::size_t eight = 0; eight < strip.acted.size(); ++eight) {
      auto gone = static_cast<std::uint32_t>(strip.acted[eight] & ~strip.acting[eight]);
      for (; gone != 0; gone &= gone - 1) {
        const auto pair =
            first + eight * block_lanes + static_cast<unsigned>(std::countr_zero(gone));
        pairs.clear_memories(pair, pair + 1);
      }
    }
  });
}

template ImpulseSums<2> keep_impulses(std::span<const StripContacts<2>>, Pairs<2>&, int);
template void forget_impulses(std::span<const StripContacts<2>>, Pairs<2>&, int);
template ImpulseSums<3> keep_impulses(std::span<const StripContacts<3>>, Pairs<3>&, int);
template void forget_impulses(std::span<const StripContacts<3>>, Pairs<3>&, int);

}  // namespace grseg
#endif  // HWY_ONCE
