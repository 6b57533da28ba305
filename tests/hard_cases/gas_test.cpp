// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/worlds.hpp"

#include <gsl/gsl_randist.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

/// A gas of discs without gravity.
namespace grseg::hard_cases {
namespace {

using std::numbers::pi;

constexpr double solid_fraction = 0.2;
constexpr int columns = 60, rows = 60;

/// Smooth equal discs of diameter 1 with Gaussian velocities of temperature m, between two walls and
/// periodic along them. They are elastic at first, so that nothing of the initial lattice remains.
Simulation<2> equilibrium(double restitution)
{
  const double pitch = std::sqrt(pi / 4 / solid_fraction);
  std::vector<worlds::Disc> discs;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < columns; ++k)
      discs.push_back({{pitch * (k + 0.5), pitch * (row + 0.5)}, 0.5});
  auto world = worlds::world_of(discs);
  world.box = {pitch * columns, pitch * rows, true};
  world.walls = {worlds::floor_at(0), {{0, pitch * rows}, {0, -1}}};
  world.material = {0, 1};
  world.law.forecast = 0.5;
  world.step = 0.01;
  world.solver = {1e-6, 100};
  Simulation<2> elastic(world, worlds::positions_of(discs));
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> random{gsl_rng_alloc(gsl_rng_mt19937),
                                                                 gsl_rng_free};
  for (std::size_t g = 0; g < discs.size(); ++g)
    elastic.set_velocity(g, {gsl_ran_gaussian(random.get(), 1), gsl_ran_gaussian(random.get(), 1)});
  for (int step = 0; step < 800; ++step) elastic.advance();

  world.material.restitution = restitution;
  std::vector<Vec2> position;
  for (std::size_t g = 0; g < discs.size(); ++g) position.push_back(elastic.position(g));
  Simulation<2> gas(world, position);
  for (std::size_t g = 0; g < discs.size(); ++g) gas.set_velocity(g, elastic.velocity(g));
  return gas;
}

/// Temperature, J, of the motion about the mean: one kT per disc in two dimensions.
double temperature(const Simulation<2>& gas)
{
  const auto count = static_cast<double>(gas.world().grains.size());
  Vec2 mean = Vec2::Zero();
  for (std::size_t g = 0; g < gas.world().grains.size(); ++g) mean += gas.velocity(g) / count;
  return translational_energy(gas) / count - gas.world().grains.mass[0] * mean.squaredNorm() / 2;
}

TEST(Gas, CoolsByHaffsLawUntilItClusters)
{
  // Collisions between discs: dT/dt = -(1 - e^2)/2 w T, w = 2 sqrt(pi) n d chi sqrt(T/m) (Enskog;
  // Brilliantov & Poeschel 2004). A disc that hits one of two walls at distance H also loses (1 -
  // e^2) T; the density at walls follows from the pressure, n (1 + 2 phi chi), which adds sqrt(2)
  // (1 + 2 phi chi)/(pi n d H chi). The law assumes uncorrelated velocities. As vortices grow, the
  // deviation from the law is proportional to 1 - e^2, whatever the step: 15 % at e = 0.8, 8 % at
  // 0.9, 4 % at 0.95 after 3 t_e.
  Case law("H28", "temperature over Haff's law up to t = 3 t_e, e = 0.95, 0.98");
  Case cooling("G8", "largest gain of energy of a cooling gas in a step, relative");
  for (const double e : {0.95, 0.98}) {
    auto gas = equilibrium(e);
    const double m = gas.world().grains.mass[0];
    const double t0 = temperature(gas), n = 4 * solid_fraction / pi;
    const double chi = (1 - 7 * solid_fraction / 16) / std::pow(1 - solid_fraction, 2);
    const double frequency = 2 * std::sqrt(pi) * n * chi * std::sqrt(t0 / m);
    const double walls =
        std::sqrt(2) / (pi * n * gas.world().box.length_y) * (1 + 2 * solid_fraction * chi) / chi;
    const double rate = (1 - e * e) / 4 * frequency * (1 + walls);
    double energy = translational_energy(gas);
    while (gas.time() * rate < 3) {
      gas.advance();
      const double now = translational_energy(gas);
      cooling.at_most(std::max(0.0, now / energy - 1), 1e-12);
      energy = now;
      law.near(temperature(gas) / t0 * std::pow(1 + gas.time() * rate, 2), 1, 0.05);
    }
  }
}

}  // namespace
}  // namespace grseg::hard_cases
