// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/step/simulation.hpp"

#include <vector>

namespace grseg::hard_cases {

/// The contact problem of one step by itself: contacts in the order of the frame (grain ids),
/// without an initial guess, and the motion that gravity alone would have caused.
struct ContactProblem {
  std::vector<Contact<2>> contacts;
  std::vector<Motion<2>> motion;  // motion of the grains, followed by that of the walls
};

/// The contact problem of the step that `frame` records, under the touching law.
inline ContactProblem contact_problem(const Simulation<2>& simulation, const Frame<2>& frame)
{
  const auto& world = simulation.world();
  ContactProblem problem;
  problem.motion = simulation.before();
  for (auto& m : problem.motion) {
    if (!(m.inverse_mass > 0)) continue;
    m.v[0] += world.step * world.gravity.x();
    m.v[1] += world.step * world.gravity.y();
  }
  problem.motion.emplace_back();
  const auto& list = frame.contacts;
  const double spin = world.rotation ? rim_factor<2> : 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto i = static_cast<std::size_t>(list.i[k]);
    const auto j = list.j[k] < 0 ? problem.motion.size() - 1 : static_cast<std::size_t>(list.j[k]);
    const Vec2 n = list.branch[k].normalized();
    Contact<2> c{};
    c.i = static_cast<std::int32_t>(i);
    c.j = static_cast<std::int32_t>(j);
    c.n[0] = n.x();
    c.n[1] = n.y();
    c.kappa = list.j[k] < 0
                  ? 1
                  : list.branch[k].norm() / (world.grains.radius[i] + world.grains.radius[j]);
    c.mass_n = 1 / (problem.motion[i].inverse_mass + problem.motion[j].inverse_mass);
    c.mass_t = c.mass_n / (1 + spin * c.kappa * c.kappa);
    const auto &a = simulation.before()[i],
               b = list.j[k] < 0 ? Motion<2>{} : simulation.before()[j];
    const double separation = (a.v[0] - b.v[0]) * c.n[0] + (a.v[1] - b.v[1]) * c.n[1];
    c.rebound = separation < 0 ? -world.material.restitution * separation : 0;
    problem.contacts.push_back(c);
  }
  return problem;
}

}  // namespace grseg::hard_cases
