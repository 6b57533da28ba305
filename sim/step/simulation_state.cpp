// SPDX-License-Identifier: GPL-3.0-or-later
// Saving and restoring a simulation.
#include "sim/step/simulation.hpp"

namespace grseg {
namespace {

World with_skin(World world, double skin)
{
  world.skin = skin;
  return world;
}

}  // namespace

Simulation::Simulation(const World& world, const State& state)
    : Simulation(with_skin(world, state.pairs.skin), state.position)
{
  for (std::size_t b = 0; b < state.row.size(); ++b) {
    const auto g = static_cast<std::size_t>(state.row[b]);
    state_.row[b] = state.row[b];
    state_.position[b] = state.position[g];
    state_.image[b] = state.image[g];
    state_.radius[b] = world_.grains.radius[g];
    const double inverse_mass = world_.grains.fixed[g] ? 0 : 1 / world_.grains.mass[g];
    state_.motion[b] = {state.velocity[g].x(), state.velocity[g].y(), state.rim_speed[g],
                        inverse_mass};
    body_of_[g] = static_cast<std::uint32_t>(b);
  }
  pairs_.restore(state_, state.pairs);
  restored_ = true;
  steps_done_ = state.steps_done;
}

Simulation::State Simulation::state() const
{
  State state;
  for (std::size_t g = 0; g < body_of_.size(); ++g) {
    const auto b = body_of_[g];
    state.position.push_back(state_.position[b]);
    state.image.push_back(state_.image[b]);
    state.velocity.push_back(velocity(g));
    state.rim_speed.push_back(state_.motion[b].rim_speed);
  }
  state.row = state_.row;
  state.pairs = pairs_.state();
  state.steps_done = steps_done_;
  return state;
}

}  // namespace grseg
