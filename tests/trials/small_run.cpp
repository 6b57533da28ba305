// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a small run in which all numbers differ, which scripts/fault-trials and fuzz targets damage.
// Usage: small_run FILE COMPRESSION-LEVEL
#include "formats/trajectory/writer.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

using namespace grseg;

constexpr int grains = 6, frames = 4, contacts = 5;
constexpr double step = 1e-3, interval = 0.05, gravity = 9.81, slope = 23 * 3.14159265358979 / 180;

RunDescription description()
{
  RunDescription run;
  for (int g = 0; g < grains; ++g) {
    const auto species = g < 2 ? Species::boundary : g % 2 == 0 ? Species::small : Species::large;
    const double radius = species == Species::large ? 0.005 : 0.0025;
    run.grains.id.push_back(g + 1);
    run.grains.species.push_back(species);
    run.grains.radius.push_back(radius);
    run.grains.mass.push_back(3.14159265358979 * radius * radius);
    run.grains.fixed.push_back(species == Species::boundary ? 1 : 0);
  }
  run.box = {0.03, 0.04, true};
  run.parameters.numbers = {{"gravity", {gravity * std::sin(slope), -gravity * std::cos(slope)}},
                            {"step", {step}},
                            {"frame_interval", {interval}},
                            {"small_diameter", {0.005}},
                            {"large_diameter", {0.01}},
                            {"density", {1}},
                            {"friction", {0.5}},
                            {"restitution", {0.25}},
                            {"seed", {1}},
                            {"complete", {0}}};
  run.parameters.texts = {{"program", "small_run"},
                          {"command_line", "small_run"},
                          {"history", "small_run"},
                          {"scene", "geometry = chute\n"}};
  run.observables = {{"sweeps", ""}};
  return run;
}

/// Numbers between 0.5 and 1.5 that differ between frames.
double number(int frame, int entry)
{
  return 1 + 0.5 * std::sin(1.7 * frame + 0.9 * entry);
}

Frame<2> frame(int n)
{
  Frame<2> frame;
  frame.step = static_cast<std::int64_t>(n * interval / step);
  frame.time = (static_cast<double>(frame.step) + 0.5) * step;
  for (int g = 0; g < grains; ++g) {
    const bool fixed = g < 2;
    const int when = fixed ? 0 : n;
    frame.position.emplace_back(0.004 * g + 0.001 * number(when, g),
                                fixed ? -0.0025 : 0.003 * g + 0.001 * number(n, g + 9));
    frame.image.push_back({fixed ? 0 : n, 0});
    frame.velocity.emplace_back(fixed ? 0 : number(n, g), fixed ? 0 : 0.1 * number(n, g + 3));
    frame.angular_velocity.push_back(fixed ? 0 : number(n, g + 5));
    frame.force.emplace_back(number(n, g + 7), number(n, g + 8));
  }
  for (int c = 0; c < contacts; ++c) {
    frame.contacts.i.push_back(2 + c % 4);
    frame.contacts.j.push_back(c < 4 ? (c + 1) % 4 + 2 : 0);
    frame.contacts.force.emplace_back(0.1 * number(n, c), number(n, c + 2));
    frame.contacts.branch.emplace_back(0.003 * number(n, c + 4), 0.006 * number(n, c + 6));
    frame.contacts.gap.push_back(-1e-5 * number(n, c + 8));
  }
  return frame;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 3) {
    std::cerr << "small_run: FILE COMPRESSION-LEVEL\n";
    return 2;
  }
  TrajectoryWriter writer(
      argv[1], description(),
      {.compression = std::atoi(argv[2]), .contact_chunk = 8, .scalar_chunk = frames});
  for (int n = 0; n < frames; ++n) {
    const double sweeps = 8 + n;
    writer.append(frame(n), {&sweeps, 1});
  }
  writer.add_parameters({{{"complete", {1}}}, {}});
  writer.close();
  return 0;
}
