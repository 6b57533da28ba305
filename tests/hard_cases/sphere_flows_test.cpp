// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

/// Many spheres: a gas, and beds at rest and in flow.
namespace grseg::hard_cases {
namespace {

using std::numbers::pi;

constexpr double solid_fraction = 0.2;
constexpr int per_side = 16;
const double pitch = std::cbrt(pi / 6 / solid_fraction);
const double height = pitch * per_side;

/// Smooth equal spheres of diameter 1 with Gaussian velocities, between two walls and periodic along
/// them. They are elastic at first, so that nothing of the initial lattice remains.
Simulation<3> equilibrium(double restitution)
{
  World<3> world;
  std::vector<Vec3> position;
  for (int k = 0; k < per_side * per_side * per_side; ++k) {
    position.push_back(pitch * Vec3(k % per_side + 0.5, k / per_side % per_side + 0.5,
                                    k / (per_side * per_side) + 0.5));
    world.grains.id.push_back(k);
    world.grains.species.push_back(Species::small);
    world.grains.radius.push_back(0.5);
    world.grains.mass.push_back(grain_volume<3>(0.5));
    world.grains.fixed.push_back(0);
  }
  world.box = {height, height, true, 3, height, true};
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}, {Vec3(0, height, 0), -Vec3::UnitY()}};
  world.material = {0, 1};
  world.law.forecast = 0.5;
  world.step = 0.005;
  world.solver = {1e-12, 1000};
  Simulation<3> elastic(world, position);
  std::mt19937 random(1);
  std::normal_distribution<double> velocity;
  for (std::size_t g = 0; g < position.size(); ++g)
    elastic.set_velocity(g, {velocity(random), velocity(random), velocity(random)});
  for (int step = 0; step < 600; ++step) elastic.advance();
  world.material.restitution = restitution;
  for (std::size_t g = 0; g < position.size(); ++g) position[g] = elastic.position(g);
  Simulation<3> gas(world, position);
  for (std::size_t g = 0; g < position.size(); ++g) gas.set_velocity(g, elastic.velocity(g));
  return gas;
}

/// Temperature, J: m <v_x^2> about the mean velocity.
double temperature(const Simulation<3>& gas)
{
  const auto count = static_cast<double>(gas.world().grains.size());
  Vec3 mean = Vec3::Zero();
  for (std::size_t g = 0; g < gas.world().grains.size(); ++g) mean += gas.velocity(g) / count;
  return (2 * translational_energy(gas) / count - gas.world().grains.mass[0] * mean.squaredNorm()) /
         3;
}

/// Pair correlation at contact (Carnahan & Starling, J. Chem. Phys. 51, 635, 1969).
constexpr double contact_value =
    (1 - solid_fraction / 2) / ((1 - solid_fraction) * (1 - solid_fraction) * (1 - solid_fraction));
constexpr double density = 6 * solid_fraction / pi;

/// Collisions of a sphere per time, 1/s (Chapman & Enskog).
double frequency(const Simulation<3>& gas)
{
  return 4 * std::sqrt(pi) * density * contact_value *
         std::sqrt(temperature(gas) / gas.world().grains.mass[0]);
}

TEST(GasOfSpheres, KeepsItsEnergyAndCollidesAtEnskogsRate)
{
  // 16,000 collisions scatter by 0.8 %; Carnahan & Starling are accurate to 0.3 %, and a step leaves
  // out second collisions of 1 % of the spheres.
  Case energy("S8", "energy of an elastic gas over that before"),
      rate("S8", "collisions over Enskog's number");
  auto gas = equilibrium(1);
  const double before = translational_energy(gas),
               expected = frequency(gas) / 2 * static_cast<double>(gas.world().grains.size());
  Frame<3> frame;
  double collisions = 0;
  for (int step = 0; step < 600; ++step) {
    gas.advance(frame);
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      if (frame.contacts.j[c] >= 0 && frame.contacts.force[c].norm() > 0) ++collisions;
  }
  energy.near(translational_energy(gas) / before, 1, 1e-11);
  rate.near(collisions / (expected * 600 * gas.world().step), 1, 0.035);
}

TEST(GasOfSpheres, CoolsByHaffsLaw)
{
  // dT/dt = -(1 - e^2)/3 w T with w the collisions of a sphere per time (Brilliantov & Poeschel 2004).
  // A sphere that hits one of two walls at distance H loses (1 - e^2) T, and n T (1 + 4 nu chi) is the
  // pressure, which adds (1 + 4 nu chi)/(pi sqrt(2) n d^2 H chi) to the rate. The bound is that of
  // discs (H28).
  Case law("S8", "temperature over Haff's law up to t = 3 tau, e = 0.95");
  const double e = 0.95;
  auto gas = equilibrium(e);
  const double walls = (1 + 4 * solid_fraction * contact_value) /
                       (pi * std::sqrt(2) * density * height * contact_value);
  const double start = temperature(gas), rate = (1 - e * e) / 6 * frequency(gas) * (1 + walls);
  while (gas.time() * rate < 3) {
    gas.advance();
    law.near(temperature(gas) / start * std::pow(1 + gas.time() * rate, 2), 1, 0.05);
  }
}

/// A bed of spheres on the default base, at a slope in degrees, followed for 2,000 sqrt(d_S/g).
struct LongBed {
  // d_S: largest overlap with the base; growth of the largest overlap after a fortieth of the time
  double on_base = 0, growth = 0;
  double sinking = 0, kinetic = 0;  // d_S; M g d_S
  double stress_ratio = 0;  // sigma_xx/sigma_yy of the lowest layer, 4 d_S, mean of the second half

  explicit LongBed(const std::string& slope)
  {
    const auto scene = small_chute::paper_scene({"--dimension", "3", "--length", "12dS", "--width",
                                                 "8dS", "--depth", "12dS", "--phi-large", "0.45",
                                                 "--slope", slope, "--accuracy", "standard"});
    auto bed = release(deposit<3>(scene), scene);
    const double d = scene.small_diameter, until = 2000 * std::sqrt(d / scene.gravity);
    double first = 0;
    while (bed.time() < until / 40) first = bed.advance().largest_overlap;
    const double before = mean_height(bed);
    Frame<3> frame;
    double xx = 0, yy = 0;
    for (int part = 0; bed.time() < until; ++part) {
      const bool looks = part % 200 == 0 && bed.time() > until / 2;
      const auto report = looks ? bed.advance(frame) : bed.advance();
      growth = std::max(growth, (report.largest_overlap - first) / d);
      if (!looks) continue;
      for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
        const auto i = static_cast<std::size_t>(frame.contacts.i[c]),
                   j = static_cast<std::size_t>(frame.contacts.j[c]);
        if (bed.world().grains.fixed[j]) on_base = std::max(on_base, -frame.contacts.gap[c] / d);
        if (frame.position[i].y() > 4 * d) continue;
        xx += frame.contacts.force[c].x() * frame.contacts.branch[c].x();
        yy += frame.contacts.force[c].y() * frame.contacts.branch[c].y();
      }
    }
    sinking = (before - mean_height(bed)) / d;
    kinetic = (translational_energy(bed) + rotational_energy(bed)) /
              (mobile_mass(bed.world().grains) * scene.gravity * d);
    stress_ratio = xx / yy;
  }

 private:
  static double mean_height(const Simulation<3>& bed)
  {
    double sum = 0;
    for (std::size_t g = 0; g < bed.world().grains.size(); ++g) sum += bed.position(g).y();
    return sum / static_cast<double>(bed.world().grains.size());
  }
};

TEST(BedOfSpheres, AtRestForTwoThousandTimeUnitsNeitherSinksNorRatchets)
{
  // Self-stress of grains locked between base grains made sigma_xx/sigma_yy 10 on a base with pockets.
  // A bed at rest has Janssen's ratio, below 1. Single precision changes velocities by 1e-7 of
  // gravity's change in a step, as in two dimensions.
  Case base("S11", "largest overlap of a bed at rest with its base, d_S"),
      growth("S11", "growth of the largest overlap of a bed at rest, d_S"),
      sinking("S11", "sinking of a bed at rest, d_S"),
      ratio("S11", "σ_xx/σ_yy of the lowest layer at rest"),
      kinetic("S11", "kinetic energy at the end, M g d_S");
  const LongBed bed("0");
  base.at_most(bed.on_base, 0.01);
  growth.at_most(bed.growth, 1e-6);
  sinking.at_most(std::abs(bed.sinking), 1e-6);
  ratio.between(bed.stress_ratio, 0, 1.5);
  kinetic.at_most(bed.kinetic, 1e-9);
}

TEST(BedOfSpheres, InFlowForTwoThousandTimeUnitsDoesNotRatchet)
{
  // grseg-check allows overlaps of 0.1 d_S.
  Case base("S11", "largest overlap in flow with the base, d_S"),
      growth("S11", "growth of the largest overlap in flow, d_S"),
      ratio("S11", "σ_xx/σ_yy of the lowest layer in flow");
  const LongBed bed("26");
  base.at_most(bed.on_base, 0.1);
  growth.at_most(bed.growth, 0.1);
  ratio.between(bed.stress_ratio, 0.5, 1.5);
}

}  // namespace
}  // namespace grseg::hard_cases
