// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace grseg {

/// The rows of the grains of a contact; no second one at the base (boundary grains and walls).
/// FormatError where the first is not mobile.
struct Partners {
  std::size_t i;
  std::optional<std::size_t> j;
};
template <int D>
Partners partners(const Grains& grains, const Frame<D>& frame, std::size_t contact);

/// The kinds of contacts of two species: two small grains, a large and a small one, two large ones, or a small
/// or large grain and the base (boundary grains and straight walls).
enum class PairType { SS, LS, LL, Sb, Lb };
constexpr std::size_t pair_types = 5;
constexpr std::array<const char*, pair_types> pair_type_names{"SS", "LS", "LL", "Sb", "Lb"};

/// FormatError where the first grain of the contact is not mobile.
template <int D>
PairType pair_type(const Grains& grains, const Frame<D>& frame, std::size_t contact);

}  // namespace grseg
