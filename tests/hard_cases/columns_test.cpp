// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solver.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/contact_list.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

/// Convergence of sweeps in a column of discs on a floor, for which theory has a closed form. The
/// contacts of a column form a path, so a Gauss-Seidel sweep contracts errors by the square of
/// Jacobi's factor, in any order of contacts, also by colour (Young 1954, consistent order).
namespace grseg::hard_cases {
namespace {

using std::numbers::pi;

constexpr double gh = 9.8e-3;  // velocity that gravity adds per step, m/s

/// Discs of these masses one above the other, each falling at g h, with zero impulses at first.
/// Contact k joins disc k to the disc below it or to the floor.
struct Column {
  std::vector<Motion<2>> motion;
  std::vector<Contact<2>> contacts;

  explicit Column(const std::vector<double>& masses)
  {
    for (const double m : masses) motion.push_back({{0, -gh}, 1 / m});
    motion.push_back({});
    for (std::size_t k = 0; k < masses.size(); ++k) {
      Contact<2> c{};
      c.i = static_cast<std::int32_t>(k);
      c.j = static_cast<std::int32_t>(k == 0 ? masses.size() : k - 1);
      c.n[1] = c.kappa = 1;
      c.mass_n = 1 / (motion[k].inverse_mass + (k == 0 ? 0 : motion[k - 1].inverse_mass));
      c.mass_t = c.mass_n / 3;
      contacts.push_back(c);
    }
  }

  SolverReport solve(double tolerance, int sweeps)
  {
    return solve_contacts(contacts, motion, 0.5, {}, {tolerance, sweeps}, 0);
  }

  /// Largest deviation of an impulse from the weight above it.
  double error() const
  {
    double largest = 0;
    for (const auto& c : contacts) {
      double weight = 0;
      for (auto k = static_cast<std::size_t>(c.i); k + 1 < motion.size(); ++k)
        weight += gh / motion[k].inverse_mass;
      largest = std::max(largest, std::abs(c.impulse_n - weight));
    }
    return largest;
  }
};

/// Factor by which a sweep reduces the error, from the second half of so many sweeps.
double contraction(const Column& cold, int sweeps)
{
  auto half = cold, whole = cold;
  half.solve(0, sweeps / 2);
  whole.solve(0, sweeps);
  return std::pow(whole.error() / half.error(), 2.0 / sweeps);
}

TEST(Column, ASweepContractsTheErrorByCosineSquaredOfPiOverTwoNInAnyOrder)
{
  // Jacobi's matrix has the eigenvalues cos((2k - 1) pi/2n): 0.933 n^2 sweeps per decade.
  Case rates("H13", "error left by a sweep, cos²(π/2n)");
  for (const std::size_t n : {5u, 20u, 60u}) {
    Column column(std::vector<double>(n, 1.0));
    const int sweeps = static_cast<int>(2 * n * n);
    const double rate = std::pow(std::cos(pi / (2 * static_cast<double>(n))), 2);
    rates.near(contraction(column, sweeps), rate, 1e-9);
    std::reverse(column.contacts.begin(), column.contacts.end());
    rates.near(contraction(column, sweeps), rate, 1e-9);
    std::shuffle(column.contacts.begin(), column.contacts.end(), std::mt19937(1));
    rates.near(contraction(column, sweeps), rate, 1e-9);
  }
}

TEST(Column, AHeavyDiscOnALightOneConvergesByROverOnePlusRPerSweep)
{
  // Sweep k leaves the part L^k of the impulse's error, L = R/(1 + R), and reports the residual L^k/(R (1 -
  // L^k)). Here a light disc is on a heavy one: R < 1.
  Case heavy("H15", "load that k sweeps find, 1 − (R/(1 + R))ᵏ"),
      light("H16", "load that k sweeps find, 1 − (1 + R)⁻ᵏ");
  for (const double ratio : {1.0, 4.0, 100.0, 1e4, 0.25, 0.01, 1e-4}) {
    const double rate = ratio / (1 + ratio);
    for (const int sweeps : {1, 3, 50}) {
      Column column({1, ratio});
      const auto report = column.solve(0, sweeps);
      const double left = std::pow(rate, sweeps);
      (ratio < 1 ? light : heavy)
          .near(column.contacts[1].impulse_n / (ratio * gh), 1 - left, 1e-12);
      EXPECT_NEAR(report.residual, left / (ratio * (1 - left)), 1e-12);
    }
  }
}

TEST(Column, AHeavyDiscOnALightOneEndsWithinToleranceAndReportsItsSweeps)
{
  // With the residual above, sweeps end when L^k is R tol/(1 + R tol): 231 sweeps per decade at R =
  // 100. With a tolerance that is not small against 1/R, much of the load is still missing then.
  Case count("H15", "sweeps until a tolerance is met");
  for (const double ratio : {4.0, 100.0, 1e4})
    for (const double tolerance : {1e-2, 1e-6}) {
      Column column({1, ratio});
      const auto report = column.solve(tolerance, 1000000);
      const double left = ratio * tolerance / (1 + ratio * tolerance);
      EXPECT_TRUE(report.converged);
      count.near(report.sweeps, std::ceil(std::log(left) / std::log(ratio / (1 + ratio))), 1);
      EXPECT_LE(1 - column.contacts[1].impulse_n / (ratio * gh), left * (1 + 1e-9));
    }
}

TEST(Column, AHeavyDiscAtRestOnALightOneNeedsOneSweep)
{
  Column column({1, 1e4});
  column.contacts[0].impulse_n = (1 + 1e4) * gh;
  column.contacts[1].impulse_n = 1e4 * gh;
  Case("H15", "sweeps of the column at rest, R = 10⁴").near(column.solve(1e-12, 100).sweeps, 1, 0);
}

/// A column at rest, with `sweeps` sweeps per step, whose weight increases by 5 %.
struct Burdened {
  std::vector<double> force;  // increase of the force on the floor, over its final increase
  std::vector<double> sink;   // sinking of the top disc since then, over 5 % of g h^2

  Burdened(int discs, int sweeps, int steps)
  {
    std::vector<worlds::Disc> column;
    column.reserve(static_cast<std::size_t>(discs));
    for (int k = 0; k < discs; ++k) column.push_back({{0, 0.5 + k}, 0.5});
    auto world = worlds::world_of(column);
    world.walls = {worlds::floor_at(0)};
    world.gravity = {0, -gh / world.step};
    world.solver = {0, sweeps};
    Simulation<2> simulation(world, worlds::positions_of(column));
    double before = 0;
    for (int k = 0; k < 4000; ++k) before = simulation.advance().base_impulse.y();
    const double weight = discs * world.grains.mass[0] * gh;
    EXPECT_NEAR(before, weight, 1e-3 * weight);
    const auto top = static_cast<std::size_t>(discs - 1);
    const double start = simulation.position(top).y();
    simulation.tilt(Vec2(1.05 * world.gravity));
    for (int k = 0; k < steps; ++k) {
      force.push_back((simulation.advance().base_impulse.y() - before) / (0.05 * weight));
      sink.push_back((start - simulation.position(top).y()) / (0.05 * gh * world.step));
    }
  }

  /// Period of the force: steps from the first to the `periods`-th later upward passage through 1,
  /// per period.
  double period(int periods) const
  {
    std::vector<double> passages;
    for (std::size_t k = 1; k < force.size(); ++k)
      if (force[k - 1] < 1 && force[k] >= 1)
        passages.push_back(static_cast<double>(k) - (force[k] - 1) / (force[k] - force[k - 1]));
    return (passages.at(static_cast<std::size_t>(periods)) - passages[0]) / periods;
  }
};

TEST(Column, WithFewSweepsPerStepItRingsLikeAColumnOfSprings)
{
  // In a long wave all impulses change by nearly the same amount, P, from one sweep to the next.
  // When a contact is relaxed, each neighbour has changed by P once since the contact's last
  // relaxation, in any order, also by colour. So P is -m times the mean relative velocity that a
  // sweep leaves, and N sweeps act like springs N m/h^2. The step is a leap-frog: sin(pi/T) =
  // sqrt(N) sin(pi/4n), T = 4n/sqrt(N) steps for long waves, except for the part of a wave that the
  // sweeps of a step damp. In the end the top has sunk by 1' E (1 - E)^-1 e_1 g h^2, where E is the
  // matrix that sweeps of a step apply to the relative velocities: near n^2/2N for any order, ((n^2
  // - 1)/N - 1)/2 for n even and two colours.
  const int n = 40;
  Case periods("H14", "period over π/asin(√N sin(π/4n)) steps, n = 40, N = 5, 20, 80"),
      sinking("H14", "sinking of the top over ((n² − 1)/N − 1)/2 g h²");
  for (const int sweeps : {5, 20, 80}) {
    SCOPED_TRACE(sweeps);
    const Burdened column(n, sweeps, 3000);
    const double period = pi / std::asin(std::sqrt(sweeps) * std::sin(pi / (4 * n)));
    periods.near(column.period(2) / period, 1, 0.02);
    const double sink = ((n * n - 1.0) / sweeps - 1) / 2;
    sinking.near(column.sink.back() / sink, 1, 0.005);
    EXPECT_NEAR(column.force.back(), 1, 1e-3);
  }
}

}  // namespace
}  // namespace grseg::hard_cases
