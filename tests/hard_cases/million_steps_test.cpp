// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/small_chute.hpp"

#include <gsl/gsl_multifit.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <tuple>

/// Staron & Phillips' chute for 1e6 steps, which reveals quantities that grow without bound,
/// however slowly.
namespace grseg::hard_cases {
namespace {

constexpr int all_steps = 1000000, between_samples = 500;

struct Sample {
  double time, overlap, sweeps;  // s; mean overlap since the last sample, d_S; mean sweeps
  double defect, work;           // energy defect of the step; work of contacts, J
  double kinetic, height;        // kinetic energy, J; height, m
};

struct History {
  std::vector<Sample> samples;
  double d_s = 0, lowest = 0;                    // small diameter, lowest centre, m
  double lowest_pocket = 0, highest_pocket = 0;  // centre of a grain between two base grains, m
  double solid_fraction = 0;
  // J. Gravity's work is the change of the potential energy up to round-off, so the rest is the
  // work of contacts.
  double work_of_all_steps = 0;
  std::int64_t missed = 0;
  bool finite = true;
};

double total_energy(const Simulation<2>& s)
{
  return translational_energy(s) + rotational_energy(s) + potential_energy(s);
}

Sample sample_of(const Simulation<2>& simulation, const Frame<2>& frame)
{
  const auto& world = simulation.world();
  const auto energy =
      energy_balance<2>(world.grains, frame, simulation.before(), world.gravity, world.step);
  return {simulation.time(),
          0,
          0,
          energy.defect(),
          energy.work_of_contacts,
          translational_energy(simulation) + rotational_energy(simulation),
          bed_height(simulation)};
}

/// Height of the centre of a grain that lies on two touching base grains, relative to their tops.
double pocket(double base, double radius)
{
  return std::sqrt((base + radius) * (base + radius) - base * base) - base;
}

void look_at_the_bed(const Simulation<2>& simulation, History& history)
{
  const auto& world = simulation.world();
  double volume = 0, base = 0, smallest = 1e300, largest = 0;
  history.lowest = 1e300;
  for (std::size_t g = 0; g < world.grains.size(); ++g) {
    const double radius = world.grains.radius[g];
    if (world.grains.fixed[g]) {
      base = radius;
      continue;
    }
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
    volume += grain_volume<2>(radius);
    history.lowest = std::min(history.lowest, simulation.position(g).y());
  }
  history.lowest_pocket = pocket(base, smallest);
  history.highest_pocket = pocket(base, largest);
  history.solid_fraction = volume / (world.box.length_x * bed_height(simulation));
}

History flow_at(const char* slope)
{
  const auto scene = small_chute::paper_scene({"--slope", slope, "--seed", "2"});
  auto simulation = small_chute::bed(scene);
  History history;
  history.d_s = scene.small_diameter;
  const double start = total_energy(simulation);
  Frame<2> frame;
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
  look_at_the_bed(simulation, history);
  return history;
}

/// Trend of the mean overlap over the second half of the run, from twenty independent blocks of 25,000
/// steps. Impacts overlap by their speed times the step, and the speed of the flow still increases as the
/// large grains rise. An error of the scheme is therefore an increase of the overlap relative to the speed
/// (root of the kinetic energy): the slope in time of a fit in time and speed together. It is given per
/// 10^6 steps and over the mean; its standard error is from the scatter of the blocks.
struct Drift {
  static constexpr std::size_t blocks = 20;
  double mean = 0;
  double slope = 0, error = 0;  // trend at equal speed of the flow, and its error

  /// Absolute bound: the end of the 99.7 % interval that is farther from 0 (17 degrees of freedom:
  /// 3.45 errors).
  double at_most() const { return std::abs(slope) + 3.45 * error; }

  explicit Drift(const std::vector<Sample>& samples)
  {
    const std::size_t first = samples.size() / 2, size = (samples.size() - first) / blocks;
    std::vector<double> time, overlap, speed;
    for (std::size_t b = 0; b < blocks; ++b) {
      double t = 0, o = 0, k = 0;
      for (std::size_t s = first + b * size; s < first + (b + 1) * size; ++s) {
        t += samples[s].time / static_cast<double>(size);
        o += samples[s].overlap / static_cast<double>(size);
        k += samples[s].kinetic / static_cast<double>(size);
      }
      time.push_back(t / samples.back().time);
      overlap.push_back(o);
      speed.push_back(std::sqrt(k));
    }
    mean = std::accumulate(overlap.begin(), overlap.end(), 0.0) / blocks;
    std::tie(slope, error) = fit(overlap, mean, {time, speed});
  }

 private:
  /// Coefficient of the first regressor, beside a constant, and its standard error, both divided by `unit`.
  static std::pair<double, double> fit(const std::vector<double>& values, double unit,
                                       const std::vector<std::vector<double>>& regressors)
  {
    const std::size_t terms = regressors.size() + 1;
    const std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)> x{gsl_matrix_alloc(blocks, terms),
                                                                    gsl_matrix_free},
        covariance{gsl_matrix_alloc(terms, terms), gsl_matrix_free};
    const std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)> y{gsl_vector_alloc(blocks),
                                                                    gsl_vector_free},
        c{gsl_vector_alloc(terms), gsl_vector_free};
    const std::unique_ptr<gsl_multifit_linear_workspace, decltype(&gsl_multifit_linear_free)> work{
        gsl_multifit_linear_alloc(blocks, terms), gsl_multifit_linear_free};
    for (std::size_t b = 0; b < blocks; ++b) {
      gsl_matrix_set(x.get(), b, 0, 1);
      for (std::size_t k = 1; k < terms; ++k) gsl_matrix_set(x.get(), b, k, regressors[k - 1][b]);
      gsl_vector_set(y.get(), b, values[b]);
    }
    double squares = 0;
    gsl_multifit_linear(x.get(), y.get(), c.get(), covariance.get(), &squares, work.get());
    return {gsl_vector_get(c.get(), 1) / unit,
            std::sqrt(gsl_matrix_get(covariance.get(), 1, 1)) / unit};
  }
};

/// Writes the history as a table if the environment names a folder for it.
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

  const Drift overlap(history.samples);
  // A run stops above this bound.
  Case(name, case_of("mean overlap, d_S")).at_most(overlap.mean, 0.01);
  // B rises by 0.0043 if the overlap becomes ten times as large (a line through the table of
  // docs/studies/accuracy.md), hence by 0.0002 for a tenth more, which no campaign resolves: its
  // error of B is 0.002. (The bound was three standard errors of the slope, which the noisier run
  // passes more easily, and 0.02 for these; 0.070 and 0.016 were known.)
  Case(name, case_of("change of the mean overlap at equal speed in 1e6 steps, over the mean, "
                     "farther end of its 99.7 % interval"))
      .at_most(overlap.at_most(), 0.1);

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

  // No grain sinks below the pockets of the base, except by an overlap as large as the mean overlap
  // that a run allows, and some grain lies in a pocket.
  Case(name, case_of("lowest centre above the tops of the base, d_S"))
      .between(history.lowest / history.d_s, history.lowest_pocket / history.d_s - 0.01,
               history.highest_pocket / history.d_s + 0.01);
  // Without overlap, no packing of discs is denser than hexagonal on average. A flow of discs at I
  // = 0.2, steeper than these, has the solid fraction 0.737 (docs/studies/scenes.md).
  Case(name, case_of("solid fraction of the bed"))
      .between(history.solid_fraction, 0.737, std::numbers::pi / std::sqrt(12));
  Case(name, case_of("part of the steps above the tolerance"))
      .at_most(static_cast<double>(history.missed) / all_steps, 1e-3);
}

// Samples of a flow that speeds up by half. Its overlap follows the speed and scatters by 2 % from
// sample to sample, as at 21 degrees, with or without a drift of its own.
TEST(Drift, OfAFifthInAMillionStepsIsFoundAndASpeedThatRisesIsNone)
{
  for (const double drift : {0.0, 0.2}) {
    std::mt19937 random(3);
    std::normal_distribution<double> scatter(0, 0.02);
    std::vector<Sample> samples;
    const int count = all_steps / between_samples;
    for (int k = 1; k <= count; ++k) {
      const double t = static_cast<double>(k) / count;
      const double speed = 1 + 0.5 * t + 0.05 * std::sin(40 * t);
      Sample sample{};
      sample.time = 200 * t;
      sample.kinetic = speed * speed;
      sample.overlap = 1e-3 * (speed + 1.4 * drift * t) * (1 + scatter(random));
      samples.push_back(sample);
    }
    const Drift found(samples);
    EXPECT_NEAR(found.slope, drift, 0.03);
    EXPECT_EQ(found.at_most() <= 0.1, drift == 0) << found.at_most();
  }
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
