// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/grain_state.hpp"

#include <numeric>

namespace grseg {

void GrainState::resize_like(const GrainState& other)
{
  position.resize(other.position.size(), Vec2::Zero());
  motion.resize(other.motion.size());
  radius.resize(other.radius.size());
  image.resize(other.image.size());
  row.resize(other.row.size());
}

GrainState make_state(const Grains& grains, const std::vector<Vec2>& position)
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
