// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_law.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace grseg {

/// Contact problem of one step, taken from a developed chute flow (tests/inputs/README.md).
struct FrozenProblem {
  std::vector<Motion<2>> motion;  // motion of each body after gravity, before contact impulses
  std::vector<Contact<2>> contacts;
  static constexpr double friction = 0.5;
};

inline FrozenProblem read_frozen_problem(const std::string& path)
{
  std::ifstream file(path);
  std::size_t bodies = 0, count = 0;
  file >> bodies >> count;
  FrozenProblem problem;
  problem.motion.resize(bodies);
  problem.contacts.resize(count);
  std::vector<double> omega(bodies);
  for (std::size_t b = 0; b < bodies; ++b)
    file >> problem.motion[b].v[0] >> problem.motion[b].v[1] >> omega[b];
  for (auto& c : problem.contacts) {
    double ri = 0, rj = 0, bias = 0, wi = 0, wj = 0, ignored = 0;
    // In the file the normal points from i to j, and impulses act on j: here i and j are exchanged.
    file >> c.j >> c.i >> c.n[0] >> c.n[1] >> rj >> ri >> c.mass_n >> c.mass_t >> bias >> wj >>
        wi >> ignored >> ignored;
    c.kappa = 1;
    c.rebound = -bias;
    c.impulse_n = c.impulse_t[0] = 0;
    auto& a = problem.motion.at(static_cast<std::size_t>(c.i));
    auto& b = problem.motion.at(static_cast<std::size_t>(c.j));
    a.inverse_mass = wi;
    b.inverse_mass = wj;
    a.rim[0] = ri * omega[static_cast<std::size_t>(c.i)];
    b.rim[0] = rj * omega[static_cast<std::size_t>(c.j)];
    c.mass_n = 1 / (wi + wj);  // the file's nine digits would not match the bodies
    c.mass_t = c.mass_n / 3;
  }
  if (!file) throw std::runtime_error("cannot read " + path);
  return problem;
}

}  // namespace grseg
