// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"

#include <string>
#include <vector>

/// A run of spheres of three species in which all numbers differ: a coarse, a middle and a fine
/// grain on one boundary grain and at two straight walls. The cell is longer along x than along z.
namespace grseg::spheres {

inline Grains grains()
{
  Grains all;
  all.id = {11, 12, 13, 20};
  all.species = {Species{2}, Species{1}, Species{0}, Species::boundary};
  all.radius = {0.006, 0.004, 0.0025, 0.005};
  for (const double r : all.radius) all.mass.push_back(2500 * grain_volume<3>(r));
  all.fixed = {0, 0, 0, 1};
  return all;
}

/// The coarse grain (row 0) lies on the boundary grain (row 3). The middle grain (row 1) leans on
/// the coarse one across the edge x = 0, the fine grain (row 2) on both. The fine grain also touches
/// wall 1, the coarse one wall 0. No branch or force is along an axis. Frame `number` is shifted by
/// that many millimetres along x and z.
inline Frame<3> frame(std::int64_t number)
{
  Frame<3> f;
  f.step = 500 * number;
  f.time = (static_cast<double>(f.step) + 0.5) * 1e-4;
  const double way = 0.001 * static_cast<double>(number);
  f.position = {{0.002 + way, 0.008, 0.010 + way},
                {0.095 + way, 0.014, 0.006 + way},
                {0.001 + way, 0.016, 0.012 + way},
                {0.005 + way, -0.002, 0.013 + way}};
  f.image = {{1, 0, -2}, {0, 0, 3}, {4, 0, 5}, {0, 0, 0}};
  f.velocity = {{0.11, 0.12, 0.13}, {-0.21, 0.22, -0.23}, {0.31, -0.32, 0.33}, {0, 0, 0}};
  f.angular_velocity = {{1, 2, 3}, {-4, 5, -6}, {7, -8, 9}, {0, 0, 0}};
  f.force = {{1e-6, 2e-6, 3e-6}, {4e-6, 5e-6, 6e-6}, {7e-6, 8e-6, 9e-6}, {0, 0, 0}};
  auto& contacts = f.contacts;
  contacts.i = {0, 1, 2, 2, 2, 0};
  contacts.j = {3, 0, 0, 1, -2, -1};
  contacts.force = {{-0.031, 0.101, -0.029},  {-0.017, 0.013, -0.011},   {-0.005, 0.019, 0.007},
                    {0.0061, 0.0023, 0.0067}, {0.0003, -0.0041, 0.0043}, {0.0007, 0.0053, 0.0009}};
  contacts.branch = {{-0.003, 0.010, -0.003}, {-0.007, 0.006, -0.004}, {-0.001, 0.008, 0.002},
                     {0.006, 0.002, 0.006},   {0, -0.0025, 0},         {0, 0.006, 0}};
  contacts.gap.clear();
  const auto all = grains();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto j = contacts.j[c];
    const double reach = all.radius[static_cast<std::size_t>(contacts.i[c])] +
                         (j < 0 ? 0 : all.radius[static_cast<std::size_t>(j)]);
    contacts.gap.push_back(contacts.branch[c].norm() - reach);
  }
  return f;
}

inline RunDescription description()
{
  RunDescription run;
  run.grains = grains();
  run.box = {0.1, 0.05, true, 3, 0.06, true};
  run.species = {{"fine", 0.005}, {"middle", 0.008}, {"coarse", 0.012}};
  auto& numbers = run.parameters.numbers;
  numbers["small_diameter"] = {0.005};
  numbers["large_diameter"] = {0.012};
  numbers["density"] = {2500};
  numbers["gravity"] = {3.8, -9.0, 0.2};
  numbers["step"] = {1e-4};
  numbers["frame_interval"] = {0.05};
  run.parameters.texts["history"] = "spheres by hand";
  run.observables = {{"sweeps", ""}};
  return run;
}

/// Writes a file of `frames` frames.
inline void write(const std::string& path, int frames, const StorageSettings& storage = {},
                  const RunDescription& run = description())
{
  TrajectoryWriter writer(path, run, storage);
  for (int k = 0; k < frames; ++k) writer.append(frame(k), std::vector<double>{8.0 + k});
  writer.close();
}

}  // namespace grseg::spheres
