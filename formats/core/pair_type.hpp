// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>

namespace grseg {

/// Who touches whom: two small, one large and one small, two large, and a small or large grain with
/// the base (boundary grains and straight walls).
enum class PairType { SS, LS, LL, Sb, Lb };
constexpr std::size_t pair_types = 5;
constexpr std::array<const char*, pair_types> pair_type_names{"SS", "LS", "LL", "Sb", "Lb"};

/// FormatError where the first grain of the contact is not mobile.
PairType pair_type(const Grains& grains, const Frame& frame, std::size_t contact);

}  // namespace grseg
