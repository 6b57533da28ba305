// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_law.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace grseg {

/// Number of contacts in a block: as many as the widest vector has numbers. It is the same on every
/// instruction set, so that sums over lanes are too; narrower vectors take a block in parts.
template <class Real>
constexpr std::uint32_t lanes_of = 64 / sizeof(Real);
constexpr std::uint32_t block_lanes = lanes_of<double>;

/// Members of a contact in double precision, and in single.
template <class Real, class Number>
using MembersOf =
    std::conditional_t<std::is_same_v<Real, double>, WholeImpulses<Number>, Increments<Number>>;

/// Contacts of one colour, lane by lane, eight in double and sixteen in single precision: no mobile
/// body appears in two of them, so they may be relaxed at the same time.
template <class Real>
struct alignas(64) BlockOf : MembersOf<Real, std::array<Real, lanes_of<Real>>> {
  using Lanes = std::array<Real, lanes_of<Real>>;
  /// Where the bodies' entries begin, counted in numbers from the first MotionOf<Real>.
  std::array<std::uint32_t, lanes_of<Real>> i, j;
};
using ContactBlock = BlockOf<double>;

/// Indices of bodies from `begin` on, up to but without `end`.
struct Range {
  std::uint32_t begin, end;
};

/// Blocks in the order in which they are relaxed, parted into runs: no two blocks of a run share a
/// mobile body, so no block has to wait for what another one writes.
template <class Real>
struct RunsOf {
  std::span<BlockOf<Real>> blocks;
  std::span<const std::uint32_t> ends;  // of the runs, in blocks
  /// Bodies of this strip, where several strips make up a scene. The ranges of all strips together
  /// hold every body that contacts can move; contacts touch only bodies of their own strip and its
  /// neighbours.
  Range bodies{};
};
using BlockRuns = RunsOf<double>;

}  // namespace grseg
