// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/recorder.hpp"

#include "formats/core/errors.hpp"
#include "sim/step/energies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

// Largest mean overlap, in d_S, unless the largest approach in a step is larger.
constexpr double most_overlap = 0.01;

/// Data from which the observables of a frame are computed.
template <int D>
struct Written {
  const StepTotals& t;  // totals since the previous frame
  const Simulation<D>& simulation;
  const Frame<D>& frame;
  EnergyBalance energy;

  const World<D>& world() const { return simulation.world(); }
};

template <int D>
struct Column {
  const char *name, *unit;
  double (*value)(const Written<D>&);
};

// clang-format off
template <int D>
const std::vector<Column<D>> columns = {
  {"translational_energy", "J", [](const Written<D>& w) { return translational_energy(w.simulation); }},
  {"rotational_energy", "J", [](const Written<D>& w) { return rotational_energy(w.simulation); }},
  {"potential_energy", "J", [](const Written<D>& w) { return potential_energy(w.simulation); }},
  {"momentum_defect", "", [](const Written<D>& w) {
     return momentum_defect<D>(w.world().grains, w.frame, w.world().gravity); }},
  {"energy_defect", "", [](const Written<D>& w) { return w.energy.defect(); }},
  {"work_of_contacts", "J", [](const Written<D>& w) { return w.energy.work_of_contacts; }},
  {"work_of_boundaries", "J", [](const Written<D>& w) { return w.energy.work_of_boundaries; }},
  {"steps", "", [](const Written<D>& w) { return static_cast<double>(w.t.steps); }},
  {"missed_steps", "", [](const Written<D>& w) { return static_cast<double>(w.t.missed); }},
  {"sweeps", "", [](const Written<D>& w) { return w.t.per_step(w.t.sweeps); }},
  {"residual", "", [](const Written<D>& w) { return w.t.largest_residual; }},
  {"residual_rms", "", [](const Written<D>& w) { return w.t.per_step(w.t.residual_rms); }},
  {"touching", "", [](const Written<D>& w) { return w.t.per_step(w.t.touching); }},
  {"contacts", "", [](const Written<D>& w) { return w.t.per_step(w.t.force_bearing); }},
  {"mean_overlap", "m", [](const Written<D>& w) { return w.t.mean_overlap(); }},
  {"largest_overlap", "m", [](const Written<D>& w) { return w.t.largest_overlap; }},
  {"mean_gap", "m", [](const Written<D>& w) { return w.t.mean_gap_bearing(); }},
  {"fastest_approach", "m s-1", [](const Written<D>& w) { return w.t.fastest_approach; }},
  {"frame_step", "s", [](const Written<D>& w) { return w.simulation.written_step(); }},
  {"base_force_x", "N", [](const Written<D>& w) {
     return w.t.per_step(w.t.base_impulse.x()) / w.world().step; }},
  {"base_force_y", "N", [](const Written<D>& w) {
     return w.t.per_step(w.t.base_impulse.y()) / w.world().step; }}};
// clang-format on

template <int D>
bool all_finite(const std::vector<Vector<D>>& values)
{
  return std::all_of(values.begin(), values.end(), [](const auto& v) { return v.allFinite(); });
}

}  // namespace

void StepTotals::add(const StepReport& report)
{
  const auto& solver = report.solver;
  add(StepTotals{.steps = 1,
                 .missed = solver.converged ? 0 : 1,
                 .sweeps = static_cast<double>(solver.sweeps),
                 .residual_rms = solver.residual_rms,
                 .touching = static_cast<double>(report.touching),
                 .force_bearing = static_cast<double>(report.force_bearing),
                 .sum_overlap = report.sum_overlap,
                 .sum_gap_bearing = report.sum_gap_bearing,
                 .largest_residual = solver.residual,
                 .largest_overlap = report.largest_overlap,
                 .fastest_approach = report.fastest_approach,
                 .farthest_approach = report.farthest_approach,
                 .divided = report.parts > 1 ? 1 : 0,
                 .solved_again = report.solved_again ? 1 : 0,
                 .base_impulse = report.base_impulse,
                 .largest_impulses = solver.converged ? report.largest_impulse : 0,
                 .missed_impulse = solver.converged ? 0 : report.largest_impulse,
                 .missed_gain = solver.converged ? 0 : report.energy_gain,
                 .missed_overlap = last_missed ? report.largest_overlap : 0,
                 .last_missed = !solver.converged});
}

void StepTotals::add(const StepTotals& other)
{
  steps += other.steps;
  missed += other.missed;
  sweeps += other.sweeps;
  residual_rms += other.residual_rms;
  touching += other.touching;
  force_bearing += other.force_bearing;
  sum_overlap += other.sum_overlap;
  sum_gap_bearing += other.sum_gap_bearing;
  largest_residual = std::max(largest_residual, other.largest_residual);
  largest_overlap = std::max(largest_overlap, other.largest_overlap);
  fastest_approach = std::max(fastest_approach, other.fastest_approach);
  farthest_approach = std::max(farthest_approach, other.farthest_approach);
  divided += other.divided;
  solved_again += other.solved_again;
  base_impulse += other.base_impulse;
  largest_impulses += other.largest_impulses;
  missed_impulse = std::max(missed_impulse, other.missed_impulse);
  missed_gain = std::max(missed_gain, other.missed_gain);
  missed_overlap = std::max(missed_overlap, other.missed_overlap);
  last_missed = other.last_missed;
}

std::vector<Observable> Recorder::observables(int dimension)
{
  std::vector<Observable> all;
  all.reserve(columns<2>.size() + 1);
  for (const auto& column : columns<2>) all.push_back({column.name, column.unit});
  if (dimension == 3) all.push_back({"base_force_z", "N"});
  return all;
}

Recorder::Recorder(TrajectoryWriter& writer, double small_diameter, const State& state)
    : writer_(writer), small_diameter_(small_diameter), state_(state)
{
}

template <int D>
void Recorder::write(const Frame<D>& frame, const Simulation<D>& simulation)
{
  check_bounds(frame, simulation);
  const auto& world = simulation.world();
  const Written<D> now{state_.since_frame, simulation, frame,
                       energy_balance<D>(world.grains, frame, simulation.before(), world.gravity,
                                         simulation.written_step())};
  std::vector<double> values;
  values.reserve(columns<D>.size() + 1);
  for (const auto& column : columns<D>) values.push_back(column.value(now));
  if constexpr (D == 3) values.push_back(now.t.per_step(now.t.base_impulse.z()) / world.step);
  writer_.append(frame, values);
  state_.totals.add(state_.since_frame);
  state_.since_frame = {.last_missed = state_.since_frame.last_missed};
}

template <int D>
void Recorder::check_bounds(const Frame<D>& frame, const Simulation<D>& simulation) const
{
  if (!all_finite<D>(frame.position) || !all_finite<D>(frame.velocity))
    throw RunError(fmt::format(
        "a position or velocity is not finite at t = {:.6g} s; use a smaller step", frame.time));
  const double approach = state_.since_frame.farthest_approach, most = simulation.most_approach();
  if (approach > most)
    throw RunError(fmt::format(
        "grains may approach each other by {:.2g} d_S in 1/{} of a step at t = {:.6g} s, above "
        "{:.2g} d_S, half the smallest diameter; use a step below {:.2g} s",
        approach / small_diameter_, 1 << most_halvings, frame.time, most / small_diameter_,
        simulation.world().step * most / approach));
  const double overlap = state_.since_frame.mean_overlap() / small_diameter_;
  if (overlap > std::max(most_overlap, approach / small_diameter_))
    throw RunError(fmt::format(
        "the mean overlap is {:.2g} d_S at t = {:.6g} s, above {} d_S and above the largest "
        "displacement in a step; use a smaller step or tolerance",
        overlap, frame.time, most_overlap));
}

template <int D>
double momentum_defect(const Grains& grains, const Frame<D>& frame, const Vector<D>& gravity)
{
  std::vector<Vector<D>> defect(grains.size());
  double largest_force = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    defect[g] = grains.mass[g] * gravity - frame.force[g];
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    defect[static_cast<std::size_t>(contacts.i[c])] += contacts.force[c];
    if (contacts.j[c] >= 0) defect[static_cast<std::size_t>(contacts.j[c])] -= contacts.force[c];
    largest_force = std::max(largest_force, contacts.force[c].norm());
  }
  double largest = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) largest = std::max(largest, defect[g].norm());
  return largest_force > 0 ? largest / largest_force : largest;
}

template void Recorder::write(const Frame<2>&, const Simulation<2>&);
template void Recorder::write(const Frame<3>&, const Simulation<3>&);
template double momentum_defect<2>(const Grains&, const Frame<2>&, const Vec2&);
template double momentum_defect<3>(const Grains&, const Frame<3>&, const Vec3&);

}  // namespace grseg
