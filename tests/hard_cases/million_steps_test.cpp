// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/energy_balance.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/small_chute.hpp"

#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

/// The paper's chute for 1e6 steps: what grows without bound, however slowly, shows here.
namespace grseg::hard_cases {
namespace {

constexpr int all_steps = 1000000, between_samples = 500;

struct Sample {
  double time, overlap, sweeps;  // s; in d_S, mean over the steps since the last; mean
  double defect, work;           // of the step itself: energy defect; J, of contacts
  double kinetic, height;        // J; m
};

struct History {
  std::vector<Sample> samples;
  double d_s = 0, depth = 0, work_of_all_steps = 0, lowest = 0, highest = 0;  // m, J
  std::int64_t missed = 0;
  bool finite = true;
};

double total_energy(const Simulation& s)
{
  return s.translational_energy() + s.rotational_energy() + s.potential_energy();
}

Sample sample_of(const Simulation& simulation, const Frame& frame)
{
  const auto& world = simulation.world();
  const auto energy =
      energy_balance(world.grains, frame, simulation.before(), world.gravity, world.step);
  return {simulation.time(),
          0,
          0,
          energy.defect(),
          energy.work_of_contacts,
          simulation.translational_energy() + simulation.rotational_energy(),
          bed_height(simulation)};
}

History flow_at(const char* slope)
{
  // Of gravity's work only that at mid-step is the change of potential energy, as in the scheme.
  const auto scene = small_chute::paper_scene({"--slope", slope});
  auto simulation = small_chute::bed(scene);
  History history;
  history.d_s = scene.small_diameter;
  history.depth = scene.depth;
  const double start = total_energy(simulation);
  Frame frame;
  double overlap = 0, touching = 0, sweeps = 0;
  for (int k = 1; k <= all_steps; ++k) {
    const bool due = k % between_samples == 0;
    const auto report = due ? simulation.advance(frame) : simulation.advance();
    overlap += report.sum_overlap;
    touching += static_cast<double>(report.touching);
    sweeps += report.solver.sweeps;
    history.missed += !report.solver.converged;
    if (!due) continue;
    auto sample = sample_of(simulation, frame);
    sample.overlap = overlap / touching / scene.small_diameter;
    sample.sweeps = sweeps / between_samples;
    overlap = touching = sweeps = 0;
    history.samples.push_back(sample);
    history.finite = history.finite && std::isfinite(sample.kinetic + sample.height);
  }
  history.work_of_all_steps = total_energy(simulation) - start;
  history.lowest = 1e300;
  for (std::size_t g = 0; g < simulation.world().grains.size(); ++g) {
    if (simulation.world().grains.fixed[g]) continue;
    history.lowest = std::min(history.lowest, simulation.position(g).y());
    history.highest = std::max(history.highest, simulation.position(g).y());
  }
  return history;
}

/// Slope of a straight line through the means of twenty blocks of the second half of the run, and
/// its standard error from their scatter: blocks of 25,000 steps forget one another.
struct Drift {
  double slope = 0, error = 0, mean = 0, span = 0;

  Drift(const std::vector<Sample>& samples, double Sample::*quantity)
  {
    constexpr std::size_t blocks = 20;
    const std::size_t first = samples.size() / 2, size = (samples.size() - first) / blocks;
    std::vector<double> times, means;
    for (std::size_t b = 0; b < blocks; ++b) {
      double time = 0, sum = 0;
      for (std::size_t k = first + b * size; k < first + (b + 1) * size; ++k) {
        time += samples[k].time / static_cast<double>(size);
        sum += samples[k].*quantity / static_cast<double>(size);
      }
      times.push_back(time);
      means.push_back(sum);
      mean += sum / blocks;
    }
    span = times.back() - times.front();
    double intercept = 0, cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
    gsl_fit_linear(times.data(), 1, means.data(), 1, blocks, &intercept, &slope, &cov00, &cov01,
                   &cov11, &squares);
    error = std::sqrt(cov11);
  }
};

/// Where the environment names a folder for it, the history is kept as a table.
void keep(const History& history, const std::string& slope)
{
  const char* folder = std::getenv("GRSEG_HARD_CASES");
  if (folder == nullptr) return;
  const auto path = fmt::format("{}/million-steps-{}.tsv", folder, slope);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"),
                                                             std::fclose);
  ASSERT_NE(file, nullptr) << path;
  fmt::print(file.get(),
             "time[s]\toverlap[dS]\tsweeps\tenergy_defect\twork_of_contacts[J]\t"
             "kinetic_energy[J]\theight[m]\n");
  for (const auto& s : history.samples)
    fmt::print(file.get(), "{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\n", s.time,
               s.overlap, s.sweeps, s.defect, s.work, s.kinetic, s.height);
}

void check(const std::string& slope)
{
  const auto history = flow_at(slope.c_str());
  keep(history, slope);
  ASSERT_TRUE(history.finite);
  const std::string name = "G10";
  const auto case_of = [&](const char* what) { return fmt::format("{} at {}°", what, slope); };

  const Drift overlap(history.samples, &Sample::overlap);
  Case(name, case_of("mean overlap, d_S")).at_most(overlap.mean, 0.01);
  Case(name, case_of("drift of the mean overlap over its standard error"))
      .at_most(std::abs(overlap.slope) / overlap.error, 3);
  Case(name, case_of("what this drift and twice its error make in 1e6 steps, over the mean"))
      .at_most((std::abs(overlap.slope) + 2 * overlap.error) * 2 * overlap.span / overlap.mean, 1);

  double defect = 0, mean = 0, squares = 0;
  const auto count = static_cast<double>(history.samples.size());
  for (const auto& s : history.samples) {
    defect = std::max(defect, s.defect);
    mean += s.work / count;
    squares += s.work * s.work / count;
  }
  const double error = std::sqrt((squares - mean * mean) / count);
  Case(name, case_of("energy defect of a step")).at_most(defect, 1e-12);
  Case(name, case_of("work of contacts per step, sampled, less change of energy, over its error"))
      .at_most(std::abs(mean - history.work_of_all_steps / all_steps) / error, 4);

  Case(name, case_of("lowest centre above the tops of the base, d_S"))
      .between(history.lowest / history.d_s, -1, 1);
  Case(name, case_of("height of the bed, H0"))
      .between(history.samples.back().height / history.depth, 0.95, 1.25);
  Case(name, case_of("highest centre, H0")).between(history.highest / history.depth, 0.95, 1.5);
  Case(name, case_of("part of the steps above the tolerance"))
      .at_most(static_cast<double>(history.missed) / all_steps, 1e-3);
}

TEST(MillionSteps, At21DegreesNothingDrifts)
{
  check("21");
}

TEST(MillionSteps, At26DegreesNothingDrifts)
{
  check("26");
}

}  // namespace
}  // namespace grseg::hard_cases
