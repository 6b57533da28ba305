// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/detection.hpp"
#include "sim/neighbours/pairs.hpp"

#include <span>

/// Carries the impulses of contacts from step to step: they are the first guesses of the next one.
namespace grseg {

/// Sums over the contacts after the solve.
template <int D>
struct ImpulseSums {
  std::size_t force_bearing = 0;  // number of contacts with an impulse
  double gap_bearing = 0;         // m, sum of |gap| over contacts with an impulse
  double largest = 0;             // kg m/s, largest p_n
  /// J, sum of p_n (approach - rebound)/2 over pairs whose approach is stored: the energy that
  /// they gave up in this step and may get back in the next one.
  double held_back = 0;
  Vector<D> on_base_side = Vector<D>::Zero();  // kg m/s, impulse of walls and base on mobile grains
};

/// Stores the impulses and approaches of the contacts in the memories of their pairs.
template <int D>
ImpulseSums<D> keep_impulses(std::span<const StripContacts<D>> contacts, Pairs<D>& pairs,
                             int threads = 1);
/// Clears the memories of pairs that acted in the previous step and do not act now. The pair list
/// must be the same in both steps.
template <int D>
void forget_impulses(std::span<const StripContacts<D>> contacts, Pairs<D>& pairs, int threads = 1);

}  // namespace grseg
