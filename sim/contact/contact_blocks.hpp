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

/// Number of contacts in a block: as many as the widest vector has numbers, on every instruction
/// set, so that sums over lanes are the same; narrower vectors process a block in parts.
template <class Real>
constexpr std::uint32_t lanes_of = 64 / sizeof(Real);
constexpr std::uint32_t block_lanes = lanes_of<double>;

/// Members of a contact: WholeImpulses in double precision, Increments in single precision.
template <int D, class Real, class Number>
using MembersOf = std::conditional_t<std::is_same_v<Real, double>, WholeImpulses<D, Number>,
                                     Increments<D, Number>>;

template <class Real>
using LanesOf = std::array<Real, lanes_of<Real>>;
using Lanes = LanesOf<double>;

/// Block of contacts, one per lane: eight in double, sixteen in single precision. No mobile body
/// appears in two contacts of a block, so all may be relaxed at the same time.
template <int D, class Real>
struct alignas(64) BlockOf : MembersOf<D, Real, LanesOf<Real>> {
  /// Offsets of the two bodies of each contact in the array of MotionOf<D, Real>, in numbers.
  std::array<std::uint32_t, lanes_of<Real>> i, j;
};
template <int D>
using ContactBlock = BlockOf<D, double>;

/// A vector of one contact of a block.
template <std::size_t n>
Eigen::Matrix<double, n, 1> at_lane(const std::array<Lanes, n>& components, std::size_t lane)
{
  Eigen::Matrix<double, n, 1> vector;
  for (std::size_t k = 0; k < n; ++k) vector[static_cast<Eigen::Index>(k)] = components[k][lane];
  return vector;
}

/// Impulse of a contact on i, kg m/s, or on j if `sign` is -1.
template <int D>
Vector<D> impulse_of(const ContactBlock<D>& block, std::size_t lane, double sign = 1)
{
  const Vector<D> n = sign * at_lane(block.n, lane);
  if constexpr (D == 2)
    return block.impulse_n[lane] * n + block.impulse_t[0][lane] * Vec2(-n.y(), n.x());
  else
    return block.impulse_n[lane] * n + sign * at_lane(block.impulse_t, lane);
}

/// Numbers of a body, in either precision.
template <int D>
constexpr std::uint32_t numbers_per_body = sizeof(Motion<D>) / sizeof(double);

/// Half-open range [begin, end) of indices of bodies.
struct Range {
  std::uint32_t begin, end;
};

/// Blocks in the order in which they are relaxed, divided into runs. No two blocks of a run share a
/// mobile body, so no block waits for results of another block of its run.
template <int D, class Real>
struct RunsOf {
  std::span<BlockOf<D, Real>> blocks;
  std::span<const std::uint32_t> ends;  // end of each run, index of a block
  /// Bodies of this strip (pair_search.hpp), if the scene is cut into strips. The ranges of all
  /// strips together include every body that contacts can move; contacts involve only bodies of
  /// their own strip and of its neighbours.
  Range bodies{};
};
template <int D>
using BlockRuns = RunsOf<D, double>;

}  // namespace grseg
