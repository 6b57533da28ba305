// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

/// A column of discs or spheres at rest. Its forces are the weights above each contact, so that all
/// its mechanics is known exactly.
namespace grseg::column {

inline constexpr double h = 1e-4, small = 0.005, radius = 0.005, length = 0.1, width = 0.06,
                        weight = 9.8;
inline constexpr std::size_t discs = 6;

/// Discs of 10 mm, small and large species in turn, on a boundary disc whose top is at y = 0. Row 0
/// is the boundary, row k the k-th disc from below; contact k-1 is the one below it. In three
/// dimensions: spheres of three species in turn.
template <int D>
struct ColumnOf {
  RunDescription description;
  std::vector<Frame<D>> frames;
  std::vector<std::vector<double>> observables;  // base_force_x, _y (and _z), energy_defect

  /// Gravity is (0, -weight) by default; `acceleration` is along x. Default: 20 frames, 500 steps apart.
  explicit ColumnOf(const Vector<D>& gravity = -weight * Vector<D>::Unit(1),
                    double acceleration = 0, int apart = 500)
  {
    auto& grains = description.grains;
    for (std::size_t g = 0; g <= discs; ++g) {
      grains.id.push_back(static_cast<std::int32_t>(g));
      grains.species.push_back(Species{static_cast<int>(D == 2 ? (g + 1) % 2 : g % 3)});
      grains.radius.push_back(radius);
      grains.mass.push_back(grain_volume<D>(radius));
      grains.fixed.push_back(g == 0 ? 1 : 0);
    }
    grains.species[0] = Species::boundary;
    description.box = {length, 0.2, true};
    if (D == 3) {
      description.box = {length, 0.2, true, 3, width, true};
      description.species = {{"A", small}, {"B", 1.5 * small}, {"C", 2 * small}};
    }
    auto& numbers = description.parameters.numbers;
    numbers = {{"small_diameter", {small}},
               {"large_diameter", {2 * small}},
               {"gravity", {gravity.begin(), gravity.end()}},
               {"step", {h}},
               {"frame_interval", {apart * h}},
               {"friction", {0.5}},
               {"restitution", {0.25}},
               {"rotation", {1}}};
    for (const char axis : std::string("xyz").substr(0, D))
      description.observables.push_back({std::string("base_force_") + axis, "N"});
    description.observables.push_back({"energy_defect", ""});
    for (int k = 0; k < 20; ++k) add_frame(k * apart, gravity, acceleration * Vector<D>::Unit(0));
  }

  static Spin<D> at_rest()
  {
    if constexpr (D == 2)
      return 0;
    else
      return Vec3::Zero();
  }

  void add_frame(int step, const Vector<D>& gravity, const Vector<D>& acceleration)
  {
    Frame<D> f;
    f.step = step;
    f.time = (step + 0.5) * h;
    const double mass = description.grains.mass[0];
    const double way = 0.03 + acceleration.x() * f.time * f.time / 2;
    const auto periods = static_cast<std::int32_t>(std::floor(way / length));
    for (std::size_t g = 0; g <= discs; ++g) {
      const bool mobile = g > 0;
      const Vector<D> moving = mobile ? acceleration : Vector<D>(Vector<D>::Zero());
      f.position.push_back((2.0 * static_cast<double>(g) - 1) * radius * Vector<D>::Unit(1));
      f.position.back()[0] = way - periods * length;
      f.image.push_back({periods});
      f.velocity.emplace_back(moving * (f.time + h / 2));
      f.angular_velocity.push_back(at_rest());
      f.force.emplace_back(mass * moving);
    }
    for (std::size_t g = 1; g <= discs; ++g) {
      const double above = mass * static_cast<double>(discs + 1 - g);
      f.contacts.i.push_back(static_cast<std::int32_t>(g));
      f.contacts.j.push_back(static_cast<std::int32_t>(g) - 1);
      f.contacts.force.emplace_back(above * (acceleration - gravity));
      f.contacts.branch.emplace_back(2 * radius * Vector<D>::Unit(1));
      f.contacts.gap.push_back(0);
    }
    observables.emplace_back(f.contacts.force[0].begin(), f.contacts.force[0].end());
    observables.back().push_back(0);
    frames.push_back(f);
  }

  /// Shifts the top disc along y by `way` (m), and its branch and gap.
  static void lift_top(Frame<D>& f, double way)
  {
    f.position[discs].y() += way;
    f.contacts.branch[discs - 1].y() += way;
    f.contacts.gap[discs - 1] += way;
  }
  /// Adds `more` to the force of a contact, and updates `force` of its two grains.
  static void push(Frame<D>& f, std::size_t contact, const Vector<D>& more)
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
using Column = ColumnOf<2>;

}  // namespace grseg::column
