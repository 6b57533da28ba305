// SPDX-License-Identifier: GPL-3.0-or-later

// Loads and stores the memories of pairs, one pair per lane. Compiled once per instruction set, by
// files that include themselves for that purpose (hwy/foreach_target.h).
#if defined(GRSEG_SIM_PAIR_MEMORIES) == defined(HWY_TARGET_TOGGLE)
#ifdef GRSEG_SIM_PAIR_MEMORIES
#undef GRSEG_SIM_PAIR_MEMORIES
#else
#define GRSEG_SIM_PAIR_MEMORIES
#endif

#include "sim/contact/bodies-inl.hpp"
#include "sim/neighbours/pairs.hpp"

HWY_BEFORE_NAMESPACE();
namespace grseg {
namespace HWY_NAMESPACE {
namespace {

template <int D>
struct Memories {
  Vector n;
  Turning<D, Vector> t;
  Vector approach;
};
/// `at`: offsets in Pairs::memory, in doubles.
template <int D>
HWY_INLINE Memories<D> load_memories(const Pairs<D>& pairs, const std::uint32_t* at)
{
  const Doubles d;
  const auto m = load_fours(d, &pairs.memory.data()->n, at);
  if constexpr (D == 2) {
    return {m[0], {m[1]}, m[2]};
  } else {
    alignas(64) Lanes approach;
    for (std::size_t lane = 0; lane < hn::MaxLanes(d); ++lane)
      approach[lane] = pairs.approach[at[lane] / memory_doubles];
    return {m[0], {m[1], m[2], m[3]}, load(approach, 0)};
  }
}
template <int D>
HWY_INLINE void store_memories(const Memories<D>& m, Pairs<D>& pairs, const std::uint32_t* at)
{
  const Doubles d;
  auto* memory = reinterpret_cast<double*>(pairs.memory.data());
  if constexpr (D == 2) {
    store_fours(d, Fours<Doubles>{m.n, m.t[0], m.approach, hn::Zero(d)}, memory, at);
  } else {
    store_fours(d, Fours<Doubles>{m.n, m.t[0], m.t[1], m.t[2]}, memory, at);
    alignas(64) Lanes approach;
    store(m.approach, approach, 0);
    for (std::size_t lane = 0; lane < hn::MaxLanes(d); ++lane)
      pairs.approach[at[lane] / memory_doubles] = approach[lane];
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grseg
HWY_AFTER_NAMESPACE();

#endif
