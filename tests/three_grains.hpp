// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/writer.hpp"

#include <numbers>

/// A run so small that all its numbers are known: a large and a small grain on one boundary grain.
namespace grseg::three_grains {

inline Grains grains()
{
  Grains all;
  all.id = {7, 8, 9};
  all.species = {Species::large, Species::small, Species::boundary};
  all.radius = {0.005, 0.0025, 0.005};
  for (const double r : all.radius) all.mass.push_back(std::numbers::pi * r * r);
  all.fixed = {0, 0, 1};
  return all;
}

/// The large grain (row 0) lies on the boundary grain (row 2), the small one (row 1) on the large
/// one. Frame `number` is shifted by that many millimetres along x.
inline Frame<2> frame(std::int64_t number)
{
  Frame<2> f;
  f.step = 500 * number;
  f.time = (static_cast<double>(f.step) + 0.5) * 1e-4;
  const double x = 0.05 + 0.001 * static_cast<double>(number);
  f.position = {{x, 0.005}, {x, 0.0125}, {x, -0.005}};
  f.image = {{1, 0}, {0, 0}, {0, 0}};
  f.velocity = {{0.1, 0.2}, {0.3, -0.4}, {0, 0}};
  f.angular_velocity = {1, -2, 0};
  f.force = {{1e-6, 2e-6}, {3e-6, 4e-6}, {0, 0}};
  f.contacts.i = {0, 0};
  f.contacts.j = {1, 2};
  f.contacts.force = {{1e-4, -2e-4}, {-3e-4, 1e-3}};
  f.contacts.branch = {{0, -0.0075}, {0, 0.01}};
  f.contacts.gap = {0, 0};
  return f;
}

inline RunDescription description()
{
  RunDescription run;
  run.grains = grains();
  run.box = {0.35, 0.5, true};
  auto& numbers = run.parameters.numbers;
  numbers["small_diameter"] = {0.005};
  numbers["large_diameter"] = {0.01};
  numbers["density"] = {1};
  numbers["gravity"] = {3.8, -9.0};
  numbers["step"] = {1e-4};
  numbers["frame_interval"] = {0.05};
  run.parameters.texts["history"] = "three grains by hand";
  run.observables = {{"translational_energy", "J"}};
  return run;
}

/// Writes a file of `frames` frames.
inline void write(const std::string& path, int frames, const StorageSettings& storage = {})
{
  TrajectoryWriter writer(path, description(), storage);
  for (int k = 0; k < frames; ++k) writer.append(frame(k), std::vector<double>{0.5 * k});
  writer.close();
}

}  // namespace grseg::three_grains
