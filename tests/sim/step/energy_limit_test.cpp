// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"
#include "sim/step/energies.hpp"
#include "tests/sim/small_chute.hpp"
#include "tests/sim/worlds.hpp"

#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <sstream>

namespace grseg {
namespace {

/// Discs of diameter 1 on a triangular lattice that touch each other and a floor.
std::vector<worlds::Disc> lattice()
{
  std::vector<worlds::Disc> discs;
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 4; ++k)
      discs.push_back({{k + 0.5 * row, 0.5 + row * std::sqrt(0.75)}, 0.5});
  return discs;
}

struct Step {
  StepReport report;
  Frame<2> frame;
  EnergyBalance energy;
};

/// The lattice, whose discs have random velocities and spins. The discs of the lowest row have 96
/// times the mass of others.
Simulation<2> moving_lattice(double friction, double restitution, const SolverSettings& solver,
                             unsigned long seed)
{
  const auto discs = lattice();
  auto world = worlds::world_of(discs);
  for (std::size_t g = 0; g < 4; ++g) world.grains.mass[g] *= 96;
  world.walls = {worlds::floor_at(0)};
  world.material = {friction, restitution};
  world.solver = solver;
  Simulation<2> simulation(world, worlds::positions_of(discs));
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> random{gsl_rng_alloc(gsl_rng_mt19937),
                                                                 gsl_rng_free};
  gsl_rng_set(random.get(), seed);
  const auto draw = [&] { return 2 * gsl_rng_uniform(random.get()) - 1; };
  for (std::size_t g = 0; g < discs.size(); ++g)
    simulation.set_velocity(g, {draw(), draw()}, 4 * draw());
  return simulation;
}

Step step_of_lattice(double friction, double restitution, unsigned long seed)
{
  auto simulation = moving_lattice(friction, restitution, {1e-9, 20000}, seed);
  const auto& world = simulation.world();
  Step step;
  step.report = simulation.advance(step.frame);
  step.energy =
      energy_balance<2>(world.grains, step.frame, simulation.before(), world.gravity, world.step);
  return step;
}

TEST(EnergyLimit, ContactsCreateNoEnergyHoweverLargeFrictionAndRestitution)
{
  // Without gravity, earlier impulses and forecast, every term on the right side of the limit is 0.
  int solved_again = 0, steps = 0;
  for (const double friction : {0.5, 2.0, 1000.0})
    for (const double restitution : {0.5, 0.9, 1.0})
      for (unsigned long seed = 1; seed <= 50; ++seed, ++steps) {
        const auto step = step_of_lattice(friction, restitution, seed);
        EXPECT_LE(step.energy.work_of_contacts, 1e-11 * step.energy.kinetic_before) << seed;
        EXPECT_LT(step.energy.defect(), 1e-12);
        solved_again += step.report.solved_again;
      }
  EXPECT_GT(solved_again, 0);
  EXPECT_LT(solved_again, steps / 2);
}

TEST(EnergyLimit, StepsWithoutReboundsAreLeftAsTheyAre)
{
  for (const double friction : {0.5, 1000.0})
    for (unsigned long seed = 1; seed <= 200; ++seed) {
      const auto step = step_of_lattice(friction, 0, seed);
      EXPECT_FALSE(step.report.solved_again) << seed;
      EXPECT_LT(step.energy.work_of_contacts, 0) << seed;
    }
}

/// Energy that the contacts of `frame` may return, J: as springs that `sweeps` leave soft, the sum of
/// W_nn p_n^2/2 over sweeps, and in later rebounds, if they slowed down pairs before they touched.
double energy_of_contacts(const Frame<2>& frame, const Simulation<2>& simulation, int sweeps)
{
  const auto& world = simulation.world();
  const auto& contacts = frame.contacts;
  double energy = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec2 n = contacts.branch[c].normalized();
    const double p = world.step * contacts.force[c].dot(n);
    double inverse_mass = 0, approach = 0;
    for (const auto& [grain, sign] : {std::pair{contacts.i[c], -1}, {contacts.j[c], 1}}) {
      if (grain < 0) continue;
      const auto g = static_cast<std::size_t>(grain);
      inverse_mass += 1 / world.grains.mass[g];
      approach += sign * n.dot(vector_of(simulation.before()[g].v));
    }
    energy += inverse_mass * p * p / (2 * sweeps);
    if (contacts.gap[c] > 0) energy += p * std::max(approach, 0.0);
  }
  return energy;
}

/// Steps solved again of an undriven column of grains with `friction` and their `seed`. In each of its
/// steps its energy must be at most that after any earlier step, with the energy of contacts there.
int steps_of_column_solved_again(const std::string& friction, const std::string& seed)
{
  std::istringstream keys(
      "--geometry column --lateral walls --base wall --column-width 3dL --length 6dL --depth 4dS "
      "--size-ratio 1 --spread 0.4 --phi-large 0.22 --initial mixed --density-ratio 96 "
      "--restitution 0.9 --slope 30 --accuracy draft --precision double --friction " +
      friction + " --seed " + seed);
  const auto scene = small_chute::paper_scene({std::istream_iterator<std::string>(keys), {}});
  auto simulation = release(deposit<2>(scene), scene);
  const double mass = mobile_mass(simulation.world().grains);
  const double fall = mass * std::pow(scene.gravity * scene.step, 2) / 8;
  const double round_off = 1e-9 * mass * scene.gravity * scene.small_diameter;
  double most = std::numeric_limits<double>::infinity();
  int solved_again = 0;
  Frame<2> frame;
  while (simulation.time() < 0.5) {
    solved_again += simulation.advance(frame).solved_again;
    const double energy = translational_energy(simulation) + rotational_energy(simulation) +
                          potential_energy(simulation);
    most += fall;
    EXPECT_LE(energy, most + round_off) << friction << ' ' << seed << ' ' << simulation.time();
    most = std::min(most, energy + energy_of_contacts(frame, simulation, scene.solver.min_sweeps));
  }
  return solved_again;
}

TEST(EnergyLimit, AnUndrivenColumnGainsOverManyStepsNoMoreThanItsContactsHeld)
{
  int solved_again = 0;
  for (const auto* friction : {"0.5", "2", "10", "1000"})
    for (const auto* seed : {"5", "11", "12"})
      solved_again += steps_of_column_solved_again(friction, seed);
  EXPECT_GT(solved_again, 0);
}

TEST(EnergyLimit, ForcesOfAStepSolvedAgainStayWithinCoulombsCone)
{
  int solved_again = 0;
  for (unsigned long seed = 1; seed <= 200; ++seed) {
    const auto step = step_of_lattice(2, 0.9, seed);
    if (!step.report.solved_again) continue;
    ++solved_again;
    const auto& contacts = step.frame.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      // The branch vector points from j to i, and a force on i that pushes points along it.
      const Vec2 n = contacts.branch[c].normalized(), force = contacts.force[c];
      const double normal = force.dot(n), tangential = n.x() * force.y() - n.y() * force.x();
      EXPECT_GE(normal, 0);
      EXPECT_LE(std::abs(tangential), 2 * normal * (1 + 1e-12)) << seed;
    }
  }
  EXPECT_GT(solved_again, 0);
}

/// A disc at rest above a boundary grain of the same size, which moves as `body` and hits it
/// obliquely. Restitution is 1.
struct PushedDisc {
  World<2> world = worlds::world_of({{{0, 1.01}, 0.5}, {{0.3, 0}, 0.5, true}});
  std::vector<Vec2> position{{0, 1.01}, {0.3, 0}};
  int solved_again = 0;
  double kinetic = 0;

  PushedDisc(double friction, BoundaryBody body)
  {
    body.begin = 1;
    body.end = 2;
    world.bodies = {body};
    world.material = {friction, 1};
    Simulation<2> simulation(world, position);
    for (int step = 0; step < 100; ++step) solved_again += simulation.advance().solved_again;
    kinetic = translational_energy(simulation) + rotational_energy(simulation);
  }
};

TEST(EnergyLimit, MovingBoundariesMayDoWorkOnGrains)
{
  // Friction dissipates energy, and would hide errors of the work of boundaries that do not rotate.
  const PushedDisc translated(0, {.velocity = {0.1, 3}}),
      shaken(0, {.amplitude = {0, 0.1}, .angular_frequency = 20}),
      rotated(1, {.velocity = {0, 1}, .centre = {0.3, 0}, .spin = 20}),
      falling(0, {.mass = 4, .load = 100});
  for (const auto* disc : {&translated, &shaken, &rotated, &falling}) {
    EXPECT_GT(disc->kinetic, 0);
    EXPECT_EQ(disc->solved_again, 0);
  }
}

}  // namespace
}  // namespace grseg
