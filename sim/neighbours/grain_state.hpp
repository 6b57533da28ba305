// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace grseg {

/// Largest number of cell lengths that a grain may travel; files store the number in 32 bits.
constexpr std::int32_t most_periods = 1'000'000'000;

/// Variables of the grains, sorted along the cells of the pair list, so that neighbours in space
/// are near in memory. The entry after the last grain is the immobile body, which never moves: the
/// partner j of contacts at walls, and both partners in unused lanes of a block.
struct GrainState {
  std::vector<Vec2> position;       // m, per grain, then the immobile body
  std::vector<Motion> motion;       // per grain, then the immobile body
  std::vector<double> radius;       // m, per grain
  std::vector<std::int32_t> image;  // number of periods to add to x
  std::vector<std::int32_t> row;    // row of the grain in Grains

  std::size_t size() const { return row.size(); }
  /// Index of the immobile body.
  std::size_t immobile() const { return row.size(); }
  /// Resizes all arrays to the sizes of those in `other`.
  void resize_like(const GrainState& other)
  {
    position.resize(other.position.size(), Vec2::Zero());
    motion.resize(other.motion.size());
    radius.resize(other.radius.size());
    image.resize(other.image.size());
    row.resize(other.row.size());
  }
};

/// State of grains at rest at `position`, m, in the order of their rows.
inline GrainState make_state(const Grains& grains, const std::vector<Vec2>& position)
{
  const std::size_t count = position.size();
  GrainState state;
  state.position = position;
  state.position.resize(count + 1, Vec2::Zero());
  state.motion.resize(count + 1);
  for (std::size_t g = 0; g < count; ++g)
    state.motion[g].inverse_mass = grains.fixed[g] ? 0 : 1 / grains.mass[g];
  state.radius = grains.radius;
  state.image.assign(count, 0);
  state.row.resize(count);
  std::iota(state.row.begin(), state.row.end(), 0);
  return state;
}

}  // namespace grseg
