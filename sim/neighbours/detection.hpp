// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"
#include "sim/neighbours/pairs.hpp"

#include <span>
#include <vector>

/// The listed pairs that act in a step (contact_law.hpp), as blocks for the solver. Vector
/// instructions as in sweep.hpp: all instruction sets give the same bytes.
namespace grseg {

/// Where the contacts of a block come from, and their gaps at mid-step.
struct alignas(64) BlockOrigin {
  ContactBlock::Lanes gap;                      // m
  ContactBlock::Lanes approach;                 // m/s, to be remembered, see Rebound
  std::array<std::uint32_t, block_lanes> pair;  // 4 times its entry; unused lanes: the neutral one

  std::size_t entry(std::size_t lane) const { return pair[lane] / 4; }  // in Pairs
};

/// The pairs of a class that act: scratch space of find_contacts.
struct NearPairs {
  std::vector<std::uint32_t> pair;  // twice the pair's index
  std::vector<std::uint32_t> i, j;  // as in Pairs
};

/// The contacts of a strip in one step.
struct StripContacts {
  std::vector<ContactBlock> blocks;  // `size` of them are in use; never shrinks
  std::vector<std::uint32_t> ends;   // as in BlockRuns
  std::vector<BlockOrigin> origins;
  NearPairs near;
  /// A byte per eight listed pairs, a bit per pair: which act in this step, and in the one before.
  std::vector<std::uint8_t> acting, acted;
  std::size_t size = 0;     // blocks in use
  std::size_t on_base = 0;  // first of the blocks whose partners j do not move
  std::size_t count = 0;    // contacts

  BlockRuns used(Range bodies) { return {std::span(blocks).first(size), ends, bodies}; }
};

/// The law of a step, and the state that it applies to.
struct DetectionRule {
  std::span<const Vec2> ahead;     // m, after the forecast: where a pair must touch to act
  std::span<const Vec2> middle;    // m, at mid-step: the geometry of the contacts
  std::span<const Motion> motion;  // at the beginning of the step
  std::span<const Wall> walls;
  double margin = 0;  // m
  double restitution = 0;
  double horizon = 0;  // s, LawParameters::horizon times the step
  double rim_factor = disc_rim_factor;
  /// Effects to compute. An effect left out equals its neutral coefficient to the last bit:
  /// restitution 0, rim_factor 0, shifts 0.
  Effects effects;
  bool periodic = true;
};

/// Sums over the contacts that were found.
struct DetectionSums {
  std::size_t touching = 0;     // gap <= 0 at mid-step
  double overlap = 0;           // m, sum of -gap over the touching pairs
  double largest_overlap = 0;   // m
  double fastest_approach = 0;  // m/s, at the beginning of the step
  double load = 0;              // kg m/s, sum of p_n of the step before
  double root_loads = 0;        // (kg m/s)^(1/2), sum of their roots
  double approaches = 0;        // (m/s)^2, sum of squares over the pairs that had no p_n
  bool coincident = false;      // the centres of a pair coincide
};

/// Finds the contacts of every strip. Sums are added strip by strip.
DetectionSums find_contacts(const Pairs& pairs, const DetectionRule& rule,
                            std::vector<StripContacts>& contacts, int threads = 1);

/// Undoes the last find_contacts: the same pairs act as in the step before.
void forget_search(std::vector<StripContacts>& contacts);

/// Sums over the contacts that were solved.
struct ImpulseSums {
  std::size_t force_bearing = 0;     // contacts that carry an impulse
  double gap_bearing = 0;            // m, sum of |gap| over them
  Vec2 on_base_side = Vec2::Zero();  // kg m/s, of walls and boundary grains on mobile grains
};

/// Writes the contacts' impulses, and what else they have to remember, to their pairs.
ImpulseSums keep_impulses(std::span<const StripContacts> contacts,
                          std::span<Pairs::Memory> memories, int threads = 1);
/// Lets pairs forget that acted in the step before and do not now; the list must be the same.
void forget_impulses(const Pairs& pairs, std::span<const StripContacts> contacts,
                     std::span<Pairs::Memory> memories, int threads = 1);

}  // namespace grseg
