// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/boundary_body.hpp"

#include "sim/step/energies.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

using namespace worlds;

constexpr double pi = std::numbers::pi;

/// Two boundary discs side by side form one body, above a mobile disc that rests on a floor.
struct UnderAPlate {
  std::vector<Disc> discs{{{0.5, 0.5}, 0.5}, {{0, 1.5}, 0.5, true}, {{1, 1.5}, 0.5, true}};
  World<2> world = world_of(discs);
  BoundaryBody plate;
  UnderAPlate()
  {
    const double lower = std::sqrt(0.75);  // the plate's discs touch the lower one
    discs[1].position.y() = discs[2].position.y() = 0.5 + lower;
    plate.begin = 1;
    plate.end = 3;
    plate.mass = 2;
    plate.load = -7;
    world.walls = {floor_at(0)};
  }
};

TEST(BoundaryBody, APlateAtRestPutsItsLoadOnTheFloor)
{
  UnderAPlate scene;
  scene.world.gravity = {0, -3};
  scene.world.material = {0, 0};
  Simulation<2> simulation(scene.world, positions_of(scene.discs));
  simulation.drive({scene.plate});
  Frame<2> frame;
  for (int step = 0; step < 200; ++step) simulation.advance(frame);
  Vec2 on_floor = Vec2::Zero();
  for (std::size_t c = 0; c < frame.contacts.size(); ++c)
    if (frame.contacts.j[c] < 0) on_floor += frame.contacts.force[c];
  const double weight = 3 * scene.world.grains.mass[0];
  EXPECT_NEAR(on_floor.y(), 7 + weight, 1e-8);
  EXPECT_NEAR(simulation.velocity(1).y(), 0, 1e-10);
  EXPECT_EQ(simulation.velocity(1), simulation.velocity(2));
}

// However few sweeps a step has, a free plate is solved with its contacts until its velocity, 1 m/s
// at first, settles to a millionth of its change in the sweep; 40 rounds may leave ten times more.
TEST(BoundaryBody, AFallingPlateGetsTheMomentumOfItsContactsInEveryStep)
{
  UnderAPlate scene;
  scene.plate.mass = 20;
  scene.world.solver = {.tolerance = 0.5, .max_sweeps = 8, .min_sweeps = 8};
  Simulation<2> simulation(scene.world, positions_of(scene.discs));
  simulation.drive({scene.plate});
  simulation.set_velocity(1, {0, -1});
  simulation.set_velocity(2, {0, -1});
  Frame<2> frame;
  for (int step = 0; step < 20; ++step) {
    const double before = simulation.velocity(1).y();
    simulation.advance(frame);
    double force = scene.plate.load;
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      if (frame.contacts.j[c] > 0) force -= frame.contacts.force[c].y();
    const double change = scene.plate.mass * (simulation.velocity(1).y() - before);
    EXPECT_NEAR(force * scene.world.step, change, 1e-5 * scene.plate.mass) << step;
  }
}

TEST(BoundaryBody, AGrainAndAPlateExchangeTheMomentumOfTwoFreeBodies)
{
  for (const double e : {0.0, 0.5, 1.0}) {
    const std::vector<Disc> discs{
        {{0, 0}, 0.5}, {{0, 1.0004}, 0.5, true}, {{1, 1.0004}, 0.5, true}};
    auto world = world_of(discs);
    world.material = {0, e};
    Simulation<2> simulation(world, positions_of(discs));
    BoundaryBody plate;
    plate.begin = 1;
    plate.end = 3;
    plate.mass = 2;
    simulation.drive({plate});
    simulation.set_velocity(0, {0, 1});
    for (int step = 0; step < 5; ++step) simulation.advance();
    const double m = world.grains.mass[0], both = m + plate.mass;
    EXPECT_NEAR(simulation.velocity(0).y(), (m - e * plate.mass) / both, 1e-10) << e;
    EXPECT_NEAR(simulation.velocity(2).y(), (1 + e) * m / both, 1e-10) << e;
    EXPECT_EQ(simulation.velocity(1), simulation.velocity(2));
  }
}

TEST(BoundaryBody, APlateWithoutContactsFallsUnderItsLoad)
{
  UnderAPlate scene;
  scene.discs[1].position.y() = scene.discs[2].position.y() = 10;
  Simulation<2> simulation(scene.world, positions_of(scene.discs));
  simulation.drive({scene.plate});
  for (int step = 0; step < 1000; ++step) simulation.advance();
  EXPECT_NEAR(simulation.velocity(1).y(), -3.5, 1e-12);
  EXPECT_NEAR(simulation.position(1).y(), 10 - 3.5 / 2, 1e-9);
}

TEST(BoundaryBody, ATurningRingKeepsItsRadiusAndGoesRoundInItsPeriod)
{
  const std::vector<Disc> discs{{{5, 1}, 0.5, true}, {{1, 5}, 0.5, true}, {{100, 100}, 0.5}};
  Simulation<2> simulation(world_of(discs), positions_of(discs));
  BoundaryBody ring;
  ring.begin = 0;
  ring.end = 2;
  ring.centre = {5, 5};
  ring.spin = 2 * pi;  // 1000 steps per turn
  simulation.drive({ring});
  for (int step = 0; step < 20250; ++step) simulation.advance();
  EXPECT_NEAR((simulation.position(0) - ring.centre).norm(), 4, 1e-11);
  EXPECT_NEAR((simulation.position(0) - Vec2(9, 5)).norm(), 0, 1e-9);
  EXPECT_NEAR((simulation.position(1) - Vec2(5, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR(simulation.velocity(0).norm(), 4 * 2 * pi, 1e-3);
  EXPECT_EQ(simulation.angular_velocity(0), 2 * pi);
}

TEST(BoundaryBody, AnOscillatingBaseFollowsItsSine)
{
  const std::vector<Disc> discs{{{0, 0}, 0.5, true}, {{100, 100}, 0.5}};
  Simulation<2> simulation(world_of(discs), positions_of(discs));
  BoundaryBody base;
  base.end = 1;
  base.amplitude = {0, 0.3};
  base.angular_frequency = 17;
  simulation.drive({base});
  for (int step = 0; step < 777; ++step) simulation.advance();
  EXPECT_NEAR(simulation.position(0).y(), 0.3 * std::sin(17 * 0.777), 1e-13);
  // With half the phase of a step, a = 0.0085, velocities are tan(a)/a times those of the sine.
  const double half = 17 * 0.001 / 2, too_fast = std::tan(half) / half;
  EXPECT_NEAR(simulation.velocity(0).y(), too_fast * 0.3 * 17 * std::cos(17 * 0.777), 1e-12);
}

/// Disc in a pocket of a turning ring, without gravity, with the ring's velocity and spin.
struct InARing {
  double way = 4 - std::sqrt(3);  // m, distance of the disc's centre from the axis
  double spin = 5;                // rad/s
  std::vector<Disc> discs;
  Simulation<2> simulation;

  explicit InARing(const Material& material)
      : discs{{{0, -way}, 1}, {{-1, -4}, 1, true}, {{1, -4}, 1, true}},
        simulation(world_with(material), positions_of(discs))
  {
    BoundaryBody ring;
    ring.begin = 1;
    ring.end = 3;
    ring.spin = spin;
    simulation.drive({ring});
    simulation.set_velocity(0, {spin * way, 0}, spin);
  }
  World<2> world_with(const Material& material) const
  {
    auto world = world_of(discs);
    world.material = material;
    return world;
  }
};

// Rigid bodies that turn together keep their distances. In a step of length h the load moves a disc
// by a h^2/2, where a is the centripetal acceleration; a disc that moved with the ring's velocity of
// the step before would sink by that much in every step.
TEST(BoundaryBody, ADiscThatTurnsWithARingDoesNotSinkIntoIt)
{
  for (const auto& material : {Material{0, 0}, Material{0.5, 0}, Material{0.5, 0.5}}) {
    InARing scene(material);
    auto& simulation = scene.simulation;
    Frame<2> frame;
    Vec2 force = Vec2::Zero();
    constexpr int steps = 5000;  // four turns
    for (int step = 0; step < steps; ++step) {
      simulation.advance(frame);
      const Vec2 inwards = -frame.position[0].normalized();
      for (const auto& of_contact : frame.contacts.force)
        force += Vec2(of_contact.dot(inwards), of_contact.dot(Vec2(inwards.y(), -inwards.x())));
    }
    const double h = simulation.world().step, a = scene.spin * scene.spin * scene.way;
    EXPECT_NEAR(simulation.position(0).norm(), scene.way, a * h * h / 2);
    const double load = simulation.world().grains.mass[0] * a;
    EXPECT_NEAR(force.x() / steps, load, 1e-2 * load);
    EXPECT_NEAR(force.y() / steps, 0, 1e-2 * load);
  }
}

TEST(BoundaryBody, NothingMovesBeforeTimeZero)
{
  const std::vector<Disc> discs{{{0, 0}, 0.5, true}, {{100, 100}, 0.5}};
  Simulation<2> simulation(world_of(discs), positions_of(discs));
  BoundaryBody base;
  base.end = 1;
  base.velocity = {1, 0};
  base.spin = 1;
  base.centre = {3, 3};
  simulation.drive({base});
  simulation.set_clock(-50);
  for (int step = 0; step < 50; ++step) simulation.advance();
  EXPECT_EQ(simulation.position(0), Vec2(0, 0));
  simulation.advance();
  EXPECT_NE(simulation.position(0), Vec2(0, 0));
}

TEST(BoundaryBody, TheWorkOfAMovingBaseClosesTheEnergyBalance)
{
  const std::vector<Disc> discs{{{0, 0}, 0.5, true}, {{0.3, 0.9539}, 0.5}};
  auto world = world_of(discs);
  world.material = {0.5, 0.5};
  world.gravity = {0, -1};
  Simulation<2> simulation(world, positions_of(discs));
  BoundaryBody base;
  base.end = 1;
  base.velocity = {0.3, 2};
  base.spin = 5;
  simulation.drive({base});
  Frame<2> frame;
  double work = 0;
  for (int step = 0; step < 20; ++step) {
    simulation.advance(frame);
    const auto balance =
        energy_balance<2>(world.grains, frame, simulation.before(), world.gravity, world.step);
    EXPECT_LT(balance.defect(), 1e-13);
    work += balance.work_of_boundaries;
  }
  EXPECT_GT(work, 0.1);
}

}  // namespace
}  // namespace grseg
