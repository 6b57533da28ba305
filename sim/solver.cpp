// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver.hpp"

#include "sim/parallel.hpp"

#include <algorithm>
#include <array>
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

SweepResult total(const std::vector<SweepResult>& strips)
{
  SweepResult total;
  for (const auto& s : strips) {
    total.largest = std::max(total.largest, s.largest);
    total.sum_squares += s.sum_squares;
    total.sum_reference += s.sum_reference;
  }
  return total;
}

}  // namespace

SolverReport solve_contacts(std::span<const BlockRuns> strips, std::size_t count,
                            std::span<Motion> motion, double friction, Effects effects,
                            const SolverSettings& settings, double floor,
                            Extrapolation& extrapolation, int threads)
{
  SolverReport report;
  if (count == 0) return report;
  for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
    apply_impulses(strips[s].blocks, motion.data(), effects);
  });
  const auto sweep = choose_sweep(effects);
  const auto contact_count = static_cast<double>(count);
  std::vector<SweepResult> results(strips.size());
  if (settings.acceleration) extrapolation.begin();
  for (;;) {
    for_alternate_strips(threads, strips.size(), [&](std::size_t s) {
      results[s] = sweep(strips[s], motion.data(), friction);
    });
    const auto result = total(results);
    const double reference = std::max(std::sqrt(result.sum_reference / contact_count), floor);
    ++report.sweeps;
    // Without gravity the sweep that lets the last contact go leaves a reference of 0.
    const auto relative = [&](double change) { return change == 0 ? 0 : change / reference; };
    report.residual = relative(result.largest);
    report.residual_rms = relative(std::sqrt(result.sum_squares / contact_count));
    report.converged = report.residual <= settings.tolerance;
    const bool enough = report.sweeps >= settings.min_sweeps || result.largest == 0;
    if ((report.converged && enough) || report.sweeps >= settings.max_sweeps) return report;
    if (settings.acceleration) extrapolation.go_on(strips, motion, result.sum_squares, threads);
  }
}

SolverReport solve_contacts(std::vector<Contact>& contacts, std::vector<Motion>& motion,
                            double friction, Effects effects, const SolverSettings& settings,
                            double floor)
{
  if (!effects.friction)
    for (auto& c : contacts) c.impulse_t = 0;
  const std::size_t bodies = motion.size();
  motion.emplace_back();  // what the lanes left over act on
  ContactBlocks packed;
  packed.pack(contacts, motion, bodies);
  const std::array strips{packed.runs()};
  Extrapolation extrapolation;
  const auto report = solve_contacts(strips, contacts.size(), motion, friction, effects, settings,
                                     floor, extrapolation);
  motion.pop_back();
  packed.unpack(contacts);
  return report;
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
