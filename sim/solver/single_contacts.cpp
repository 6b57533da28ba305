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

#ifndef GRSEG_SIM_SINGLE_FUNCTIONS
#define GRSEG_SIM_SINGLE_FUNCTIONS
namespace grseg {
namespace {
/// The functions below, compiled for an instruction set.
template <int D>
struct SingleFunctions {
  void (*take_run)(std::span<const ContactBlock<D>>, const ContactBlock<D>& neutral, Motion<D>*,
                   BlockOf<D, float>*, Effects);
  void (*take_motion)(std::span<const Motion<D>>, MotionOf<D, float>*);
  void (*give_run)(const BlockOf<D, float>*, double friction, std::span<ContactBlock<D>>,
                   Motion<D>*, Effects);
};
}  // namespace
}  // namespace grseg
#endif

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

using Singles = hn::Rebind<float, Doubles>;

/// Applies the first guesses of a block of eight contacts, and copies it to half a block of
/// sixteen, from lane `first` on.
template <Effects with, int D>
HWY_INLINE void take_half(const ContactBlock<D>& from, std::size_t first, Motion<D>* motion,
                          BlockOf<D, float>& to)
{
  const Doubles d;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto store = [&](Vector numbers, LanesOf<float>& lanes) HWY_ATTR {
      hn::Store(hn::DemoteTo(Singles(), numbers), Singles(), &lanes[first + lane]);
    };
    const auto store_all = [&](const auto& vectors, auto& lanes) HWY_ATTR {
      for (std::size_t k = 0; k < lanes.size(); ++k) store(vectors[k], lanes[k]);
    };
    const auto c = load<D>(from, lane);
    auto a = load_bodies<D>(d, members(motion), &from.i[lane]);
    auto b = load_bodies<D>(d, members(motion), &from.j[lane]);
    push<with>(c, a, b, push_of<with>(c.n, c.kappa, c.impulse_n, c.impulse_t));
    store_bodies<D>(d, a, members(motion), &from.i[lane]);
    store_bodies<D>(d, b, members(motion), &from.j[lane]);

    const auto w_nn = a.inverse_mass + b.inverse_mass;
    store_all(c.n, to.n);
    store(c.kappa, to.kappa);
    store(c.mass_n * a.inverse_mass, to.weight_i);
    store(c.mass_n * b.inverse_mass, to.weight_j);
    store(c.mass_t * w_nn, to.mass_ratio);
    store(c.rebound, to.rebound);
    store(c.impulse_n * w_nn, to.base_n);
    store_all(w_nn * c.impulse_t, to.base_t);
  }
  const auto clear = [&](LanesOf<float>& lanes) {
    std::fill_n(lanes.begin() + first, block_lanes, 0.0F);
  };
  clear(to.impulse_n);
  for (auto& lanes : to.impulse_t) clear(lanes);
  std::copy_n(from.i.begin(), block_lanes, to.i.begin() + first);
  std::copy_n(from.j.begin(), block_lanes, to.j.begin() + first);
}

/// Copies the blocks of a run, two blocks of eight contacts into one of sixteen.
template <Effects with, int D>
void take_run(std::span<const ContactBlock<D>> run, const ContactBlock<D>& neutral,
              Motion<D>* motion, BlockOf<D, float>* to)
{
  for (std::size_t b = 0; b < run.size(); b += 2, ++to) {
    take_half<with, D>(run[b], 0, motion, *to);
    take_half<with, D>(b + 1 < run.size() ? run[b + 1] : neutral, block_lanes, motion, *to);
  }
  leave_vectors();
}

template <int D>
void take_run_for(std::span<const ContactBlock<D>> run, const ContactBlock<D>& neutral,
                  Motion<D>* motion, BlockOf<D, float>* to, Effects e)
{
  with_effects(e, [&]<Effects with>() { take_run<with, D>(run, neutral, motion, to); });
}

template <int D>
void take_motion(std::span<const Motion<D>> from, MotionOf<D, float>* to)
{
  const hn::CappedTag<double, 4> d;
  const hn::Rebind<float, decltype(d)> single;
  const auto* numbers = reinterpret_cast<const double*>(from.data());
  for (std::size_t k = 0; k < numbers_per_body<D> * from.size(); k += hn::MaxLanes(d))
    hn::Store(hn::DemoteTo(single, hn::Load(d, numbers + k)), single, members(to) + k);
  for (std::size_t k = 0; k < from.size(); ++k) to[k].inverse_mass = 0;
  leave_vectors();
}

/// Adds the increments of eight contacts, from lane `first` on, to a block and its bodies.
template <Effects with, int D>
HWY_INLINE void give_half(const BlockOf<D, float>& from, std::size_t first, double friction,
                          ContactBlock<D>& to, Motion<D>* motion)
{
  const Doubles d;
  for (std::size_t lane = 0; lane < block_lanes; lane += hn::MaxLanes(d)) {
    const auto single = [&](const LanesOf<float>& lanes) HWY_ATTR {
      return hn::PromoteTo(d, hn::Load(Singles(), &lanes[first + lane]));
    };
    const auto c = load<D>(to, lane);
    const auto more = single(from.impulse_n), sum = c.impulse_n + more * c.mass_n;
    const auto opened = more <= minus(single(from.base_n));
    const auto normal = hn::IfThenZeroElse(opened, larger(sum, hn::Zero(d)));
    store(normal, to.impulse_n, lane);
    auto more_t = hn::Zero(d) * c.impulse_t;
    if constexpr (with.friction) {
      const auto limit = hn::Set(d, friction) * normal;
      const auto wanted =
          components<std::tuple_size_v<Turning<D, Vector>>>([&](std::size_t k) HWY_ATTR {
            return c.impulse_t[k] + single(from.impulse_t[k]) * c.mass_n;
          });
      auto tangential = within(in_plane(wanted, c.n), limit);
      // Adding zero turns -0 into 0: the sign of an unresolved increment has no meaning.
      for (auto& t : tangential) t = t + hn::Zero(d);
      store(tangential, to.impulse_t, lane);
      more_t = tangential - c.impulse_t;
    }
    apply<with, D>(to, lane, normal - c.impulse_n, more_t, members(motion));
  }
}

template <Effects with, int D>
void give_run(const BlockOf<D, float>* from, double friction, std::span<ContactBlock<D>> run,
              Motion<D>* motion)
{
  for (std::size_t b = 0; b < run.size(); b += 2, ++from) {
    give_half<with, D>(*from, 0, friction, run[b], motion);
    if (b + 1 < run.size()) give_half<with, D>(*from, block_lanes, friction, run[b + 1], motion);
  }
  leave_vectors();
}

template <int D>
void give_run_for(const BlockOf<D, float>* from, double friction, std::span<ContactBlock<D>> run,
                  Motion<D>* motion, Effects e)
{
  with_effects(e, [&]<Effects with>() { give_run<with, D>(from, friction, run, motion); });
}

// Dispatch accepts no templates.
SingleFunctions<2> functions_for_discs()
{
  return {take_run_for<2>, take_motion<2>, give_run_for<2>};
}
SingleFunctions<3> functions_for_spheres()
{
  return {take_run_for<3>, take_motion<3>, give_run_for<3>};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grseg {
namespace {

HWY_EXPORT(functions_for_discs);
HWY_EXPORT(functions_for_spheres);

template <int D>
SingleFunctions<D> functions()
{
  if constexpr (D == 2)
    return HWY_DYNAMIC_DISPATCH(functions_for_discs)();
  else
    return HWY_DYNAMIC_DISPATCH(functions_for_spheres)();
}

/// Calls do_run(blocks of the run, index of its first block in single precision) for each run of a
/// strip; returns the number of blocks in single precision.
template <int D, class Run>
std::uint32_t for_each_run(const BlockRuns<D>& strip, const Run& do_run)
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

template <int D>
void SingleContacts<D>::take(std::span<const BlockRuns<D>> strips, std::span<Motion<D>> motion,
                             Effects effects, int threads)
{
  strips_.resize(strips.size());
  runs_.resize(strips.size());
  const auto idle = static_cast<std::uint32_t>(numbers_per_body<D> * (motion.size() - 1));
  for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
    take_strip(strips[s], motion.data(), idle, effects, strips_[s]);
    runs_[s] = {
        std::span(strips_[s].blocks).first(strips_[s].ends.empty() ? 0 : strips_[s].ends.back()),
        strips_[s].ends, strips[s].bodies};
  });
  motion_.resize(motion.size());
  for_ranges(threads, motion.size(), [&](std::size_t begin, std::size_t end) {
    functions<D>().take_motion(motion.subspan(begin, end - begin), &motion_[begin]);
  });
}

template <int D>
void SingleContacts<D>::take_strip(const BlockRuns<D>& contacts, Motion<D>* motion,
                                   std::uint32_t idle, Effects effects, Strip& strip)
{
  ContactBlock<D> neutral{};
  neutral.i.fill(idle);
  neutral.j.fill(idle);
  strip.ends.clear();
  const auto count =
      for_each_run(contacts, [&](std::span<const ContactBlock<D>> run, std::uint32_t first) {
        strip.ends.push_back(first + static_cast<std::uint32_t>((run.size() + 1) / 2));
      });
  if (strip.blocks.size() < count) strip.blocks.resize(count);
  for_each_run(contacts, [&](std::span<const ContactBlock<D>> run, std::uint32_t first) {
    functions<D>().take_run(run, neutral, motion, &strip.blocks[first], effects);
  });
}

template <int D>
void SingleContacts<D>::give_back(std::size_t strip, const BlockRuns<D>& contacts, double friction,
                                  Effects effects, Motion<D>* motion) const
{
  const auto& blocks = strips_[strip].blocks;
  for_each_run(contacts, [&](std::span<ContactBlock<D>> run, std::uint32_t first) {
    functions<D>().give_run(&blocks[first], friction, run, motion, effects);
  });
}

template class SingleContacts<2>;
template class SingleContacts<3>;

}  // namespace grseg
#endif  // HWY_ONCE
