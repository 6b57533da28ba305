// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hard_cases/case.hpp"
#include "tests/sim/small_chute.hpp"
#include "tests/sim/worlds.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

/// Beds that rest, flow, stop or jam: statistical cases.
namespace grseg::hard_cases {
namespace {

using std::numbers::pi;
using worlds::Disc;
using worlds::positions_of;

constexpr double g = 9.8;

double mobile_mass(const World& world)
{
  double mass = 0;
  for (std::size_t k = 0; k < world.grains.size(); ++k)
    if (!world.grains.fixed[k]) mass += world.grains.mass[k];
  return mass;
}

double kinetic_energy_of(const Simulation& s)
{
  return s.translational_energy() + s.rotational_energy();
}

void run(Simulation& simulation, std::int64_t steps)
{
  for (std::int64_t k = 0; k < steps; ++k) simulation.advance();
}

/// Weight of the grains whose centres lie above y, and what contacts carry across y.
struct Cut {
  double weight = 0, carried = 0;  // N

  Cut(const World& world, const Frame& frame, double y)
  {
    const auto above = [&](std::int32_t k) {
      return k >= 0 && frame.position[static_cast<std::size_t>(k)].y() > y;
    };
    for (std::size_t k = 0; k < world.grains.size(); ++k)
      if (above(static_cast<std::int32_t>(k)) && !world.grains.fixed[k])
        weight += world.grains.mass[k] * g;
    const auto& list = frame.contacts;
    for (std::size_t c = 0; c < list.size(); ++c)
      carried += list.force[c].y() * (above(list.i[c]) - above(list.j[c]));
  }
};

TEST(StaticBed, PressesOnItsBaseWithItsWeightAndOnEachLevelWithThatOfWhatIsAbove)
{
  const auto scene = small_chute::paper_scene({"--depth", "20dS", "--length", "20dS"});
  const auto deposited = deposit(scene);
  auto world = deposited.world();
  world.solver = {1e-9, 20000, true};
  Simulation bed(world, deposited.state());
  run(bed, 4000);
  Case base("H31", "force on the base over the weight, each step"),
      level("H31", "force across a level over the weight above");
  const double weight = mobile_mass(bed.world()) * g;
  Frame frame;
  for (int step = 0; step < 20; ++step) {
    const auto report = bed.advance(frame);
    base.near(report.base_impulse.y() / bed.world().step / weight, 1, 1e-8);
    for (double y = scene.small_diameter; y < 15 * scene.small_diameter;
         y += scene.small_diameter) {
      const Cut cut(bed.world(), frame, y);
      level.near(cut.carried / cut.weight, 1, 1e-8);
    }
  }
}

/// Straight line through (x, y), unweighted.
struct Line {
  double intercept = 0, slope = 0;

  Line(const std::vector<double>& x, const std::vector<double>& y)
  {
    double cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
    gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &cov00, &cov01, &cov11,
                   &squares);
  }
};

TEST(SteadyFlow, BalancesGravityAtEveryLevelAndHasBagnoldsProfile)
{
  // Momentum of what is above a level: force of the contacts across it, flux of grains through it
  // and weight. Followed exactly, it needs no volume: the mean force on the base is M (g - a).
  // Bagnold: du/dy ~ sqrt(p/rho) since the inertial number is uniform; u(y) = u_H (1 - (1 -
  // y/H)^(3/2)) but for slip at the base and a few diameters at the top.
  const auto scene = small_chute::paper_scene(
      {"--depth", "30dS", "--length", "20dS", "--phi-large", "0", "--slope", "22"});
  auto flow = small_chute::bed(scene);
  const double d = scene.small_diameter, slope = 22 * pi / 180;
  run(flow, 160000);
  const double mass = mobile_mass(flow.world());
  const auto momentum = [&] {
    Vec2 p = Vec2::Zero();
    for (std::size_t k = 0; k < flow.world().grains.size(); ++k)
      if (!flow.world().grains.fixed[k]) p += flow.world().grains.mass[k] * flow.velocity(k);
    return p;
  };
  const Vec2 start = momentum();
  const double begin = flow.time();
  Vec2 base = Vec2::Zero();
  std::vector<double> sum(40), count(40);
  for (int step = 0; step < 160000; ++step) {
    base += flow.advance().base_impulse;
    if (step % 200 != 0) continue;
    for (std::size_t k = 0; k < flow.world().grains.size(); ++k) {
      const auto bin = static_cast<std::size_t>(std::max(0.0, flow.position(k).y() / d));
      if (flow.world().grains.fixed[k] || bin >= sum.size()) continue;
      sum[bin] += flow.velocity(k).x();
      count[bin] += 1;
    }
  }
  const double time = flow.time() - begin;
  const Vec2 expected = momentum() - start - mass * time * flow.world().gravity;
  Case("H30", "impulse of the base less that of weight and change of momentum, relative")
      .at_most((base - expected).norm() / expected.norm(), 1e-9);
  Case("H30", "shear over normal force of the base over tan θ, 40 s")
      .near(-base.x() / base.y() / std::tan(slope), 1, 0.002);

  const double height = bed_height(flow);
  std::vector<double> x, u;
  for (std::size_t bin = 3; (static_cast<double>(bin) + 1) * d < 0.85 * height; ++bin) {
    const double y = (static_cast<double>(bin) + 0.5) * d;
    x.push_back(1 - std::pow(1 - y / height, 1.5));
    u.push_back(sum[bin] / count[bin]);
  }
  const Line bagnold(x, u);
  Case shape("H33", "u(y) less its fit by Bagnold's profile, over u(H)");
  for (std::size_t k = 0; k < x.size(); ++k)
    shape.at_most(std::abs(u[k] - bagnold.intercept - bagnold.slope * x[k]) /
                      (bagnold.intercept + bagnold.slope),
                  0.05);
  Case("H33", "slip at the base, over u(H)")
      .between(bagnold.intercept / (bagnold.intercept + bagnold.slope), -0.15, 0.15);
}

TEST(StoppedBed, FarBelowReposeComesToRestAndDoesNotCreep)
{
  const auto scene =
      small_chute::paper_scene({"--depth", "15dS", "--length", "15dS", "--slope", "10"});
  auto bed = small_chute::bed(scene);
  const double unit = mobile_mass(bed.world()) * g * scene.small_diameter;
  run(bed, 20000);
  const auto positions = [&] {
    std::vector<Vec2> x;
    for (std::size_t k = 0; k < bed.world().grains.size(); ++k) x.push_back(bed.position(k));
    return x;
  };
  const auto before = positions();
  double energy = 0;
  for (int k = 0; k < 100; ++k) {
    run(bed, 1000);
    energy = std::max(energy, kinetic_energy_of(bed) / unit);
  }
  double creep = 0;
  const auto after = positions();
  for (std::size_t k = 0; k < after.size(); ++k)
    creep = std::max(creep, (after[k] - before[k]).norm() / scene.small_diameter);
  Case("H34", "kinetic energy over m g d per grain, 10°, standard").at_most(energy, 1e-12);
  Case("H34", "creep in 1e5 steps, d_S").at_most(creep, 1e-9);
}

/// Discs of diameter 1 +- 10 % poured into a box of this width between straight walls, in `rows`
/// rows; the bottom is a row of fixed discs with a hole `outlet` wide in the middle, 0 for none.
Simulation silo(double width, int rows, double outlet, double friction)
{
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> random{gsl_rng_alloc(gsl_rng_mt19937),
                                                                 gsl_rng_free};
  std::vector<Disc> discs;
  const int columns = static_cast<int>((width - 0.2) / 1.15);
  const double pitch = width / columns;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < columns; ++k)
      discs.push_back(
          {{pitch * (k + 0.5) + 0.02 * (gsl_rng_uniform(random.get()) - 0.5), 1.15 * row + 0.8},
           0.45 + 0.1 * gsl_rng_uniform(random.get())});
  for (double x = 0.25; x < width; x += 0.5)
    if (std::abs(x - width / 2) > outlet / 2 + 0.25) discs.push_back({{x, -0.25}, 0.25, true});
  auto world = worlds::world_of(discs);
  world.box = {width, 4.0 * rows, false};
  world.walls = {{{0, 0}, {1, 0}}, {{width, 0}, {-1, 0}}};
  world.material = {friction, 0.25};
  world.gravity = {0, -g};
  world.step = 0.01 / std::sqrt(g);
  world.forecast = 0.5;
  world.solver = {0.1, 500, false, 4};
  return {world, positions_of(discs)};
}

/// The same silo with these grains where they are now and another bottom.
Simulation opened(const Simulation& closed, double width, double outlet)
{
  auto world = closed.world();
  std::vector<Disc> discs;
  for (std::size_t k = 0; k < world.grains.size(); ++k)
    if (!world.grains.fixed[k]) discs.push_back({closed.position(k), world.grains.radius[k]});
  for (double x = 0.25; x < width; x += 0.5)
    if (std::abs(x - width / 2) > outlet / 2 + 0.25) discs.push_back({{x, -0.25}, 0.25, true});
  world.grains = worlds::world_of(discs).grains;
  return {world, positions_of(discs)};
}

/// Of a filling of this weight, both in N; `length` is Janssen's as the weight of such a filling.
double janssen_load(double filling, double length)
{
  return length * (1 - std::exp(-filling / length));
}

/// The length that gives `load`, by bisection.
double janssen_length(double filling, double load)
{
  double low = load, high = 1e3 * filling;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (janssen_load(filling, middle) < load ? low : high) = middle;
  }
  return low;
}

TEST(Silo, WallsAndBaseTogetherCarryTheWeightAndTheBaseSaturatesAsJanssenSays)
{
  // Base load L (1 - exp(-H/L)) in units of rho g W, L = W/(2 mu K): one length describes three
  // fillings. Nothing mobilises all friction, so K is an effective one.
  const double width = 10.3;
  std::vector<double> load, filling;
  Case total("H32", "load of walls and base over the weight");
  for (const int rows : {10, 30, 90}) {
    auto pile = silo(width, rows, 0, 0.5);
    run(pile, 12000);
    auto world = pile.world();
    world.solver = {1e-6, 20000, true};
    Simulation tight(world, pile.state());
    run(tight, 500);
    Frame frame;
    tight.advance(frame);
    const double weight = mobile_mass(world) * g;
    double base = 0, walls = 0;
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      const int i = frame.contacts.i[c], j = frame.contacts.j[c];
      if (j < 0) walls += frame.contacts.force[c].y();
      if (j >= 0 && world.grains.fixed[static_cast<std::size_t>(j)])
        base += frame.contacts.force[c].y();
      EXPECT_FALSE(world.grains.fixed[static_cast<std::size_t>(i)]);
    }
    total.near((base + walls) / weight, 1, 1e-3);
    filling.push_back(weight);
    load.push_back(base);
  }
  const double length = janssen_length(filling[2], load[2]);
  Case middle("H32", "load of the base, filled 1 and 3 widths high, over Janssen's");
  for (std::size_t k = 0; k < 2; ++k)
    middle.near(load[k] / janssen_load(filling[k], length), 1, 0.2);
  const double weight_per_height = 0.8 * width * g;
  Case("H32", "Janssen's K, from the filling 9 widths high")
      .between(width / (2 * 0.5 * length / weight_per_height), 0.1, 1);
}

TEST(Hopper, FlowsByBeverloosLawThroughWideOutletsAndJamsInANarrowOne)
{
  const double width = 40.3;
  auto closed = silo(width, 45, 0, 0.5);
  run(closed, 9000);
  std::vector<double> outlets{7, 10, 14, 18}, flow;
  for (const double outlet : outlets) {
    auto open = opened(closed, width, outlet);
    const auto passed = [&] {
      double mass = 0;
      for (std::size_t k = 0; k < open.world().grains.size(); ++k)
        if (open.position(k).y() < -1) mass += open.world().grains.mass[k];
      return mass;
    };
    const double all = mobile_mass(open.world());
    double begin = 0, start = 0;
    for (int k = 0; k < 400 && passed() < 0.35 * all; ++k) {
      run(open, 50);
      if (begin == 0 && passed() > 0.05 * all) begin = open.time(), start = passed();
    }
    flow.push_back((passed() - start) / (open.time() - begin));
  }
  std::vector<double> powers;
  for (const double q : flow) powers.push_back(std::pow(q, 2.0 / 3));
  const Line beverloo(outlets, powers);
  Case fit("H35", "flow^(2/3) over its straight line in the outlet, 7 to 18 d");
  for (std::size_t k = 0; k < outlets.size(); ++k)
    fit.near(powers[k] / (beverloo.intercept + beverloo.slope * outlets[k]), 1, 0.06);
  Case("H35", "k of Beverloo's law").between(-beverloo.intercept / beverloo.slope, 0, 3.5);
  const double bulk = 0.8;  // mass per area
  Case("H35", "C of Beverloo's law")
      .between(std::pow(beverloo.slope, 1.5) / (bulk * std::sqrt(g)), 0.4, 1.6);

  auto jammed = opened(closed, width, 2.2);
  run(jammed, 12000);
  double energy = 0;
  const double unit = mobile_mass(jammed.world()) * g;
  for (int k = 0; k < 50; ++k) {
    run(jammed, 2000);
    double inside = 0;
    for (std::size_t d = 0; d < jammed.world().grains.size(); ++d)
      if (jammed.position(d).y() > -1)
        inside += jammed.world().grains.mass[d] * jammed.velocity(d).squaredNorm() / 2;
    energy = std::max(energy, inside / unit);
  }
  Case("G13", "kinetic energy over m g d per grain of a jammed silo, 1e5 steps")
      .at_most(energy, 1e-6);
}

}  // namespace
}  // namespace grseg::hard_cases
