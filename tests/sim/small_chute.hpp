// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/checkpoint.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/scene/keys/keys.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// A chute of about fifty grains, deposited in an instant, tilted by 25 degrees.
namespace grseg::small_chute {

/// Scene of Staron & Phillips' chute, changed by `words`; the first list with a key takes precedence.
inline Scene scene_of(const std::vector<std::vector<std::string>>& words)
{
  namespace po = boost::program_options;
  po::variables_map values;
  for (const auto& line : words)
    po::store(po::command_line_parser(line).options(scene_options()).run(), values);
  po::notify(values);
  return resolve_scene(values);
}

inline Scene paper_scene(const std::vector<std::string>& words = {})
{
  return scene_of({words});
}

/// Scene of the small chute; `words` take precedence over its own keys.
inline Scene scene(const std::vector<std::string>& words = {})
{
  const std::vector<std::string> own{"--depth", "8dS",     "--length", "8dL",        "--phi-large",
                                     "0.5",     "--slope", "25",       "--accuracy", "draft"};
  return scene_of({words, own});
}

inline Vec2 tilted_gravity(const Scene& scene)
{
  const double slope = scene.slope * std::numbers::pi / 180;
  return scene.gravity * Vec2(std::sin(slope), -std::cos(slope));
}

inline Simulation<2> bed(const Scene& scene)
{
  auto simulation = deposit<2>(scene);
  simulation.tilt(tilted_gravity(scene));
  return simulation;
}

inline Checkpoint<2> checkpoint_of(const Simulation<2>& simulation, const Scene& scene)
{
  const auto& world = simulation.world();
  const StepTotals since_frame{
      1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, {15, 1.0 / 3, 0}, 16, 17, 18, 19, true};
  StepTotals totals;
  totals.largest_residual = 0.1;
  auto state = simulation.state();
  state.held_back = 1.0 / 9;
  state.stored = 1.0 / 11;
  return {{to_text(scene),
           "a test",
           "first\nsecond",
           world.grains,
           world.box,
           1.0 / 7,
           {3, 0xfedcba9876543210, {since_frame, totals}, 0.25, 1.5}},
          world.walls,
          state};
}

}  // namespace grseg::small_chute
