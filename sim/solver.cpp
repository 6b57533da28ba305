// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver.hpp"

namespace grseg {
namespace {

/// What one pass over all contacts found.
struct SweepResult {
  double largest = 0;        // m/s
  double sum_squares = 0;    // (m/s)^2, of the changes
  double sum_reference = 0;  // (m/s)^2, of W p
};

template <Effects with>
SweepResult sweep(std::vector<Contact>& contacts, std::vector<Motion>& motion, double friction)
{
  SweepResult result;
  for (auto& c : contacts) {
    const auto change = relax<with>(c, motion[static_cast<std::size_t>(c.i)],
                                    motion[static_cast<std::size_t>(c.j)], friction);
    result.largest = std::max({result.largest, change.normal, change.tangential});
    result.sum_squares += change.normal * change.normal + change.tangential * change.tangential;
    const double normal = c.impulse_n / c.mass_n, tangential = c.impulse_t / c.mass_t;
    result.sum_reference += normal * normal + tangential * tangential;
  }
  return result;
}

using Sweep = SweepResult (*)(std::vector<Contact>&, std::vector<Motion>&, double);

/// The only place where a scene's effects become a compile-time choice.
Sweep choose_sweep(Effects e)
{
  // [friction][rotation][restitution]
  static constexpr Sweep table[2][2][2] = {
      {{sweep<Effects{false, false, false}>, sweep<Effects{false, false, true}>},
       {sweep<Effects{false, true, false}>, sweep<Effects{false, true, true}>}},
      {{sweep<Effects{true, false, false}>, sweep<Effects{true, false, true}>},
       {sweep<Effects{true, true, false}>, sweep<Effects{true, true, true}>}}};
  return table[e.friction][e.rotation][e.restitution];
}

/// Applies the first guess, the impulses of the step before, to the grains.
void warm_start(std::vector<Contact>& contacts, std::vector<Motion>& motion, Effects effects)
{
  for (auto& c : contacts) {
    if (c.impulse_n == 0) continue;
    if (!effects.friction) c.impulse_t = 0;
    auto& a = motion[static_cast<std::size_t>(c.i)];
    auto& b = motion[static_cast<std::size_t>(c.j)];
    const double px = c.impulse_n * c.nx - c.impulse_t * c.ny;
    const double py = c.impulse_n * c.ny + c.impulse_t * c.nx;
    a.vx += a.inverse_mass * px;
    a.vy += a.inverse_mass * py;
    b.vx -= b.inverse_mass * px;
    b.vy -= b.inverse_mass * py;
    if (!effects.rotation) continue;
    const double spin = disc_rim_factor * c.kappa * c.impulse_t;
    a.rim_speed -= a.inverse_mass * spin;
    b.rim_speed -= b.inverse_mass * spin;
  }
}

}  // namespace

SolverReport solve_contacts(std::vector<Contact>& contacts, std::vector<Motion>& motion,
                            double friction, Effects effects, const SolverSettings& settings,
                            double floor)
{
  SolverReport report;
  if (contacts.empty()) return report;
  warm_start(contacts, motion, effects);
  const auto one_sweep = choose_sweep(effects);
  const double count = static_cast<double>(contacts.size());
  do {
    const auto result = one_sweep(contacts, motion, friction);
    const double reference = std::max(std::sqrt(result.sum_reference / count), floor);
    ++report.sweeps;
    report.residual = reference > 0 ? result.largest / reference : 0;
    report.residual_rms = reference > 0 ? std::sqrt(result.sum_squares / count) / reference : 0;
    report.converged = report.residual <= settings.tolerance;
  } while (!report.converged && report.sweeps < settings.max_sweeps);
  return report;
}

double contact_residual(const std::vector<Contact>& contacts, const std::vector<Motion>& motion,
                        double friction, Effects effects)
{
  double largest = 0;
  for (const auto& contact : contacts) {
    std::vector<Contact> alone{contact};
    alone[0].i = 0;
    alone[0].j = 1;
    std::vector<Motion> pair{motion[static_cast<std::size_t>(contact.i)],
                             motion[static_cast<std::size_t>(contact.j)]};
    largest = std::max(largest, choose_sweep(effects)(alone, pair, friction).largest);
  }
  return largest;
}

}  // namespace grseg
