// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

using Relax = Change (*)(Contact&, Motion&, Motion&, double);

/// Restitution needs no variant here: without it rebounds are ignored by setting them 0.
Relax choose_relax(Effects e)
{
  // [friction][rotation]
  static constexpr Relax table[2][2] = {
      {relax<Effects{false, false, true}>, relax<Effects{false, true, true}>},
      {relax<Effects{true, false, true}>, relax<Effects{true, true, true}>}};
  return table[e.friction][e.rotation];
}

}  // namespace

SolverReport ContactSolver::solve(std::vector<Contact>& contacts, std::vector<Motion>& motion,
                                  double friction, Effects effects, const SolverSettings& settings,
                                  double floor)
{
  SolverReport report;
  if (contacts.empty()) return report;
  if (!effects.friction)
    for (auto& c : contacts) c.impulse_t = 0;
  motion.emplace_back();  // what the lanes left over act on
  blocks_.pack(contacts, motion, motion.size() - 1);
  apply_impulses(blocks_.blocks(), motion.data(), effects);
  const auto sweep = choose_sweep(effects);
  const double count = static_cast<double>(contacts.size());
  do {
    const auto result = sweep(blocks_.blocks(), motion.data(), friction);
    const double reference = std::max(std::sqrt(result.sum_reference / count), floor);
    ++report.sweeps;
    report.residual = reference > 0 ? result.largest / reference : 0;
    report.residual_rms = reference > 0 ? std::sqrt(result.sum_squares / count) / reference : 0;
    report.converged = report.residual <= settings.tolerance;
  } while (!report.converged && report.sweeps < settings.max_sweeps);
  motion.pop_back();
  blocks_.unpack(contacts);
  return report;
}

SolverReport solve_contacts(std::vector<Contact>& contacts, std::vector<Motion>& motion,
                            double friction, Effects effects, const SolverSettings& settings,
                            double floor)
{
  return ContactSolver{}.solve(contacts, motion, friction, effects, settings, floor);
}

double contact_residual(const std::vector<Contact>& contacts, const std::vector<Motion>& motion,
                        double friction, Effects effects)
{
  const auto relax_alone = choose_relax(effects);
  double largest = 0;
  for (auto alone : contacts) {
    auto a = motion[static_cast<std::size_t>(alone.i)],
         b = motion[static_cast<std::size_t>(alone.j)];
    if (!effects.restitution) alone.rebound = 0;
    const auto change = relax_alone(alone, a, b, friction);
    largest = std::max({largest, change.normal, change.tangential});
  }
  return largest;
}

}  // namespace grseg
