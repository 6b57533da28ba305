// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>

namespace grseg {

/// Contacts between a grain of the bed and one that has left it: removed, or kept, with the grain of
/// the bed as i. The other grain is then absent, and partners() has no j: it is outside, as the base.
enum class ContactsAcross { removed, kept };

/// Makes the grains absent that have left the bed through its base, as out of a hopper, and removes
/// the contacts among them. Returns the number of these grains. The centre of such a grain lies more
/// than the largest diameter of all mobile grains below y = 0, and below the centres of all boundary
/// grains. The grains of a rough base dip less far below y = 0, or lie above a boundary grain of a
/// base that is shaken.
template <int D>
std::size_t remove_grains_below(const Grains& grains, Frame<D>& frame, ContactsAcross across);

}  // namespace grseg
