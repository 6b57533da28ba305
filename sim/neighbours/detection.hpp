// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pairs.hpp"

#include <span>
#include <vector>

/// Finds the listed pairs that act in a step (contact_law.hpp), and writes them as blocks for the
/// solver. As in sweep.hpp, all instruction sets produce the same bytes.
namespace grseg {

/// Gaps of the contacts of a block, and the pairs of the list that they belong to.
template <int D>
struct alignas(64) BlockOrigin {
  Lanes gap;       // m, at mid-step
  Lanes approach;  // m/s, stored for the next step, see Rebound
  /// Offset of the memory in Pairs::memory, in doubles; of the neutral pair in unused lanes.
  std::array<std::uint32_t, block_lanes> pair;

  std::size_t entry(std::size_t lane) const { return pair[lane] / memory_doubles; }  // in Pairs
};

/// Pairs of a class that act: scratch space of find_contacts.
struct NearPairs {
  std::vector<std::uint32_t> pair;  // twice the index of the pair in Pairs
  std::vector<std::uint32_t> i, j;  // as in Pairs
};

/// Contacts of a strip in one step.
template <int D>
struct StripContacts {
  std::vector<ContactBlock<D>> blocks;  // the first `size` are in use; never shrinks
  std::vector<std::uint32_t> ends;      // end of each run, as in BlockRuns
  std::vector<BlockOrigin<D>> origins;
  NearPairs near;
  /// One bit per listed pair, eight in a byte: the pair acts in this step; in the previous step.
  std::vector<std::uint8_t> acting, acted;
  std::size_t size = 0;     // number of blocks in use
  std::size_t on_base = 0;  // index of the first block whose partners j do not move
  std::size_t count = 0;    // number of contacts
  BlockRuns<D> used(Range bodies) { return {std::span(blocks).first(size), ends, bodies}; }
};

/// Contact law of a step, and the state to which it is applied.
template <int D>
struct DetectionRule {
  std::span<const Position<D>> ahead;  // m, positions after the forecast (LawParameters)
  /// m, positions at mid-step, which determine the geometry of contacts
  std::span<const Position<D>> middle;
  std::span<const Motion<D>> motion;  // velocities at the beginning of the step
  std::span<const Wall<D>> walls;
  double margin = 0;  // m, LawParameters::margin
  double restitution = 0;
  double horizon = 0;  // s, LawParameters::horizon times the step
  double rim_factor = grseg::rim_factor<D>;
  /// Effects to compute. Leaving out an effect has the same results to the last bit as its neutral
  /// coefficient: restitution 0, rim_factor 0, shifts 0.
  Effects effects;
  bool periodic = true;
  bool only_near = false;  // see PairList::only_near()
};

/// Sums and maxima over the contacts that were found.
struct DetectionSums {
  std::size_t touching = 0;     // number of pairs with gap <= 0 at mid-step
  double overlap = 0;           // m, sum of -gap over the touching pairs
  double largest_overlap = 0;   // m, largest -gap
  double fastest_approach = 0;  // m/s, largest approach at the beginning of the step
  double load = 0;              // kg m/s, sum of p_n of the previous step
  double root_loads = 0;        // (kg m/s)^(1/2), sum of sqrt(p_n) of the previous step
  double approaches = 0;        // (m/s)^2, sum of approach^2 over pairs whose p_n was 0
  double strain = 0;            // J, sum of W_nn p_n^2/2, p_n of the previous step
  bool coincident = false;      // true if the centres of a pair coincide
};

/// Finds the contacts of every strip; returns their sums, added strip by strip.
template <int D>
DetectionSums find_contacts(const Pairs<D>& pairs, const DetectionRule<D>& rule,
                            std::vector<StripContacts<D>>& contacts, int threads = 1);

/// Undoes the last find_contacts: the pairs of the previous step count as acting again.
template <int D>
void forget_search(std::vector<StripContacts<D>>& contacts);

}  // namespace grseg
