// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

/// A column of discs at rest, whose forces are the weights above: all that mechanics says of it is
/// known.
namespace grseg::column {

inline constexpr double h = 1e-4, small = 0.005, radius = 0.005, length = 0.1, weight = 9.8;
inline constexpr std::size_t discs = 6;

/// Discs of 10 mm, every other one of the species of small grains, on a boundary disc whose top is
/// at y = 0. Row 0 is the boundary, row k the k-th disc from below; contact k-1 is that below it.
struct Column {
  RunDescription description;
  std::vector<Frame<2>> frames;
  std::vector<std::vector<double>> observables;  // base_force_x, base_force_y, energy_defect

  /// `acceleration` is along x; 20 frames, 500 steps apart unless told otherwise.
  explicit Column(const Vec2& gravity = {0, -weight}, double acceleration = 0, int apart = 500)
  {
    auto& grains = description.grains;
    for (std::size_t g = 0; g <= discs; ++g) {
      grains.id.push_back(static_cast<std::int32_t>(g));
      grains.species.push_back(g % 2 == 0 ? Species::large : Species::small);
      grains.radius.push_back(radius);
      grains.mass.push_back(std::numbers::pi * radius * radius);
      grains.fixed.push_back(g == 0 ? 1 : 0);
    }
    grains.species[0] = Species::boundary;
    description.box = {length, 0.2, true};
    auto& numbers = description.parameters.numbers;
    numbers = {{"small_diameter", {small}},
               {"large_diameter", {2 * small}},
               {"gravity", {gravity.x(), gravity.y()}},
               {"step", {h}},
               {"frame_interval", {apart * h}},
               {"friction", {0.5}},
               {"restitution", {0.25}},
               {"rotation", {1}}};
    description.observables = {{"base_force_x", "N"}, {"base_force_y", "N"}, {"energy_defect", ""}};
    for (int k = 0; k < 20; ++k) add_frame(k * apart, gravity, {acceleration, 0});
  }

  void add_frame(int step, const Vec2& gravity, const Vec2& acceleration)
  {
    Frame<2> f;
    f.step = step;
    f.time = (step + 0.5) * h;
    const double mass = description.grains.mass[0];
    const double way = 0.03 + acceleration.x() * f.time * f.time / 2;
    const auto periods = static_cast<std::int32_t>(std::floor(way / length));
    for (std::size_t g = 0; g <= discs; ++g) {
      const bool mobile = g > 0;
      f.position.emplace_back(way - periods * length, (2.0 * static_cast<double>(g) - 1) * radius);
      f.image.push_back({periods, 0});
      f.velocity.emplace_back(mobile ? Vec2(acceleration * (f.time + h / 2)) : Vec2(0, 0));
      f.angular_velocity.push_back(0);
      f.force.emplace_back(mobile ? Vec2(mass * acceleration) : Vec2(0, 0));
    }
    for (std::size_t g = 1; g <= discs; ++g) {
      const double above = mass * static_cast<double>(discs + 1 - g);
      f.contacts.i.push_back(static_cast<std::int32_t>(g));
      f.contacts.j.push_back(static_cast<std::int32_t>(g) - 1);
      f.contacts.force.emplace_back(above * (acceleration - gravity));
      f.contacts.branch.emplace_back(0, 2 * radius);
      f.contacts.gap.push_back(0);
    }
    observables.push_back({f.contacts.force[0].x(), f.contacts.force[0].y(), 0});
    frames.push_back(f);
  }

  /// Shifts the top disc along y, with branch and gap.
  static void lift_top(Frame<2>& f, double way)
  {
    f.position[discs].y() += way;
    f.contacts.branch[discs - 1].y() += way;
    f.contacts.gap[discs - 1] += way;
  }
  /// Changes a contact's force, and the `force` of the two grains with it.
  static void push(Frame<2>& f, std::size_t contact, const Vec2& more)
  {
    f.contacts.force[contact] += more;
    f.force[contact + 1] += more;
    if (contact > 0) f.force[contact] -= more;
  }

  void write(const std::string& path) const
  {
    TrajectoryWriter writer(path, description);
    for (std::size_t k = 0; k < frames.size(); ++k) writer.append(frames[k], observables[k]);
    writer.close();
  }
};

}  // namespace grseg::column
