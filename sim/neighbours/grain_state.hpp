// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace grseg {

/// Lengths of a periodic cell that a grain may travel; files count them in 32 bits.
constexpr std::int32_t most_periods = 1'000'000'000;

/// Variables of the grains, sorted along the cells of the pair list, so that neighbours in space
/// are near in memory. The entry after the last grain is a body that never moves; it stands for all
/// walls, and for both partners in unused lanes of a block.
struct GrainState {
  std::vector<Vec2> position;       // m; one more than there are grains
  std::vector<Motion> motion;       // one more than there are grains
  std::vector<double> radius;       // m
  std::vector<std::int32_t> image;  // periods to add to x
  std::vector<std::int32_t> row;    // of Grains

  std::size_t size() const { return row.size(); }
  /// Index of the body that never moves.
  std::size_t immobile() const { return row.size(); }
  /// Makes room for as many grains as `other` has.
  void resize_like(const GrainState& other)
  {
    position.resize(other.position.size(), Vec2::Zero());
    motion.resize(other.motion.size());
    radius.resize(other.radius.size());
    image.resize(other.image.size());
    row.resize(other.row.size());
  }
};

/// Grains at rest at `position`, m, in the order of their rows.
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
