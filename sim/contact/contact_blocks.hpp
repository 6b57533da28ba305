// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_law.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// As many contacts as the widest vector has doubles. The number is the same on every instruction
/// set, so that sums over lanes are too; narrower vectors take a block in parts.
constexpr std::uint32_t block_lanes = 8;

/// Eight contacts of one colour, lane by lane: no mobile body appears in two of them, so they may
/// be relaxed at the same time. Members as in Contact.
struct alignas(64) ContactBlock {
  using Lanes = std::array<double, block_lanes>;
  Lanes nx, ny, kappa, mass_n, mass_t, rebound, impulse_n, impulse_t;
  /// Where the bodies' entries begin, counted in doubles from the first Motion.
  std::array<std::uint32_t, block_lanes> i, j;
};

/// Blocks in the order in which they are relaxed. They come in runs, one behind the other; no two
/// blocks of a run share a mobile body, so what one of them reads does not wait for the others.
struct BlockRuns {
  std::span<ContactBlock> blocks;
  std::span<const std::uint32_t> ends;  // of the runs, in blocks
};

}  // namespace grseg
