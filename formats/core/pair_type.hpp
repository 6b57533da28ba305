// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>

namespace grseg {

/// The partners of a contact: two small grains, a large and a small one, two large ones, or a small
/// or large grain and the base (boundary grains and straight walls).
enum class PairType { SS, LS, LL, Sb, Lb };
constexpr std::size_t pair_types = 5;
constexpr std::array<const char*, pair_types> pair_type_names{"SS", "LS", "LL", "Sb", "Lb"};

/// FormatError where the first grain of the contact is not mobile.
template <int D>
PairType pair_type(const Grains& grains, const Frame<D>& frame, std::size_t contact);

}  // namespace grseg
