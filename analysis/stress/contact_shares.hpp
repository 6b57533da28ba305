// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>

namespace grseg {

/// The parts of a contact's force (x) branch that belong to its grains i and j. They add up to 1,
/// but where `drop` leaves a mixed contact out, and at the base, whose part is nobody's.
struct ContactShares {
  double i = 0, j = 0;
};

/// A mixed contact is shared by `rule`; one of two grains of a species is cut where they touch; at
/// the base (boundary grains and straight walls) the grain has the part up to the contact point.
/// FormatError where the contact's first grain is not mobile.
template <int D>
ContactShares contact_shares(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                             const PartitionRule& rule);

}  // namespace grseg
