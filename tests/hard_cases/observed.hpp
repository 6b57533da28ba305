// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/step/energies.hpp"
#include "sim/step/simulation.hpp"

#include <cmath>
#include <vector>

/// Observable quantities of a step: the motion before and after it, and the contacts of its frame.
namespace grseg::hard_cases {

struct Velocities {
  std::vector<Vec2> velocity;     // m/s
  std::vector<double> rim_speed;  // radius times angular velocity, m/s

  explicit Velocities(const Simulation<2>& simulation)
  {
    const auto& radius = simulation.world().grains.radius;
    for (std::size_t g = 0; g < radius.size(); ++g) {
      velocity.push_back(simulation.velocity(g));
      rim_speed.push_back(simulation.angular_velocity(g) * radius[g]);
    }
  }
};

/// A contact of a frame, with normal, tangent and kappa as contact_law.hpp defines them.
struct SeenContact {
  std::size_t i;
  int j;           // negative for a wall
  Vec2 n, t;       // n points to i, t = (-n_y, n_x)
  double kappa;    // lever arms are kappa r
  Vec2 impulse;    // kg m/s, on i
  double overlap;  // m

  SeenContact(const World<2>& world, const ContactList<2>& list, std::size_t c)
      : i(static_cast<std::size_t>(list.i[c])),
        j(list.j[c]),
        n(list.branch[c].normalized()),
        t(-n.y(), n.x()),
        kappa(1),
        impulse(list.force[c] * world.step),
        overlap(-list.gap[c])
  {
    const auto& radius = world.grains.radius;
    if (j >= 0) kappa = list.branch[c].norm() / (radius[i] + radius[static_cast<std::size_t>(j)]);
  }

  /// Velocity of i relative to j at the contact point.
  Vec2 relative(const Velocities& v) const
  {
    Vec2 difference = v.velocity[i];
    double rims = v.rim_speed[i];
    if (j >= 0) {
      difference -= v.velocity[static_cast<std::size_t>(j)];
      rims += v.rim_speed[static_cast<std::size_t>(j)];
    }
    return difference - kappa * rims * t;
  }
};

inline double kinetic_energy(const Simulation<2>& simulation)
{
  return translational_energy(simulation) + rotational_energy(simulation);
}

}  // namespace grseg::hard_cases
