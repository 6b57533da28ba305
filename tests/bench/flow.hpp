// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/keys.hpp"

#include <cmath>
#include <map>
#include <string>
#include <vector>

/// Scenes in motion, for measurements; each is deposited when first requested.
namespace grseg {

/// Scene in sim/scenes with the name `name`.
inline Scene scene_called(const std::string& name, const std::string& accuracy = "standard")
{
  namespace po = boost::program_options;
  const std::vector<std::string> words{"--accuracy", accuracy};
  po::variables_map values;
  po::store(po::command_line_parser(words).options(scene_options()).run(), values);
  return resolve_scene(GRSEG_SCENES "/" + name + ".ini", values);
}

/// A scene `time` seconds after its begin. Callers that change it make a copy.
template <int D = 2>
const Simulation<D>& scene_at(double time, const std::string& name,
                              const std::string& accuracy = "standard")
{
  static std::map<std::string, Simulation<D>> made;
  const auto key = name + " " + accuracy;
  if (const auto found = made.find(key); found != made.end()) return found->second;
  const auto scene = scene_called(name, accuracy);
  auto simulation = release(deposit<D>(scene), scene);
  while (simulation.time() < time) simulation.advance();
  return made.emplace(key, simulation).first->second;
}

/// A chute in developed flow: the discs of Staron & Phillips after two seconds, spheres after four.
template <int D>
const Simulation<D>& flow(const std::string& accuracy)
{
  if constexpr (D == 2)
    return scene_at<2>(2, "chute", accuracy);
  else
    return scene_at<3>(4, "spheres", accuracy);
}

/// `copies` copies of the grains of `one` side by side, in motion, without the impulses of their
/// contacts, with the conditions of `world`; this function sets the grains and period of `world`.
template <int D>
Simulation<D> side_by_side(const Simulation<D>& one, World<D> world, int copies)
{
  const auto& grains = one.world().grains;
  const double length = one.world().box.length_x;
  world.grains = {};
  world.box.length_x = copies * length;
  std::vector<Vector<D>> position;
  for (int copy = 0; copy < copies; ++copy) {
    for (std::size_t g = 0; g < grains.size(); ++g) {
      auto& moved = position.emplace_back(one.position(g));
      moved.x() += (copy - std::floor(moved.x() / length)) * length;
      world.grains.id.push_back(static_cast<std::int32_t>(position.size()));
      world.grains.species.push_back(grains.species[g]);
      world.grains.radius.push_back(grains.radius[g]);
      world.grains.mass.push_back(grains.mass[g]);
      world.grains.fixed.push_back(grains.fixed[g]);
    }
  }
  Simulation<D> wide(world, position);
  for (std::size_t g = 0; g < position.size(); ++g)
    wide.set_velocity(g, one.velocity(g % grains.size()), one.angular_velocity(g % grains.size()));
  return wide;
}

}  // namespace grseg
