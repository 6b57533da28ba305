// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"

#include "sim/run/summary.hpp"
#include "sim/scene/deposition.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

Scene scene_from(std::vector<std::string> words)
{
  for (const auto* word : {"--accuracy", "draft", "--slope", "0"}) words.emplace_back(word);
  return small_chute::paper_scene(words);
}

Simulation<2> released(const Scene& scene)
{
  return release(deposit<2>(scene), scene);
}

template <class Keep>
std::size_t count_grains(const Simulation<2>& simulation, Keep keep)
{
  std::size_t count = 0;
  for (std::size_t g = 0; g < simulation.world().grains.size(); ++g) count += keep(g) ? 1 : 0;
  return count;
}

void run_for(Simulation<2>& simulation, double seconds)
{
  const double end = simulation.time() + seconds;
  while (simulation.time() < end) simulation.advance();
}

const std::vector<std::string> column{"--geometry",     "column", "--lateral", "walls",
                                      "--length",       "40dL",   "--depth",   "16dS",
                                      "--column-width", "20dS"};

TEST(Geometry, AColumnStandsBehindItsGateAndFallsWhenItOpens)
{
  const auto scene = scene_from(column);
  const auto deposited = deposit<2>(scene);
  const auto beyond = [&](const Simulation<2>& s) {
    return count_grains(s, [&](std::size_t g) {
      return !s.world().grains.fixed[g] && s.position(g).x() > scene.column_width;
    });
  };
  EXPECT_EQ(beyond(deposited), 0U);
  EXPECT_NEAR(bed_height(deposited), scene.depth, 0.02 * scene.depth);
  auto simulation = release(deposited, scene);
  EXPECT_EQ(simulation.world().walls.size(), 2U);
  run_for(simulation, 0.4);
  EXPECT_GT(beyond(simulation), 50U);
}

TEST(Geometry, AHopperHoldsItsGrainsUntilItsOutletOpens)
{
  const auto scene = scene_from({"--geometry", "hopper", "--lateral", "walls", "--length", "20dL",
                                 "--depth", "16dS", "--outlet", "12dS"});
  const auto deposited = deposit<2>(scene);
  const auto below = [&](const Simulation<2>& s) {
    return count_grains(s, [&](std::size_t g) {
      return !s.world().grains.fixed[g] && s.position(g).y() < -scene.large_diameter;
    });
  };
  EXPECT_EQ(below(deposited), 0U);
  auto simulation = release(deposited, scene);
  EXPECT_EQ(deposited.world().grains.size() - simulation.world().grains.size(), 6U);  // the plug
  run_for(simulation, 0.15);
  EXPECT_GT(below(simulation), 20U);
  // The outlet has the requested width: no bead reaches into it, and two beads end at its edges.
  double left = 0, right = scene.length;
  for (std::size_t g = 0; g < simulation.world().grains.size(); ++g) {
    if (!simulation.world().grains.fixed[g]) continue;
    const double x = simulation.position(g).x(), r = simulation.world().grains.radius[g];
    if (x < scene.length / 2) left = std::max(left, x + r);
    if (x > scene.length / 2) right = std::min(right, x - r);
  }
  EXPECT_NEAR(right - left, scene.outlet, 1e-12);
}

TEST(Geometry, ADrumHasNoGapAndKeepsItsGrains)
{
  const auto scene = scene_from({"--geometry", "drum", "--lateral", "walls", "--drum-diameter",
                                 "40dS", "--drum-rate", "-2", "--fill", "0.4"});
  auto simulation = released(scene);
  const auto& grains = simulation.world().grains;
  const Vec2 centre{scene.length / 2, scene.drum_diameter / 2};
  std::vector<Vec2> ring;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (grains.fixed[g]) ring.push_back(simulation.position(g));
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR((ring[k] - centre).norm(), (scene.drum_diameter + scene.large_diameter) / 2, 1e-12);
    const double gap = (ring[k] - ring[(k + 1) % ring.size()]).norm() - scene.large_diameter;
    EXPECT_GE(gap, -1e-12);
    EXPECT_LT(gap, 0.5 * scene.small_diameter);
  }
  run_for(simulation, 1);
  EXPECT_EQ(count_grains(simulation,
                         [&](std::size_t g) {
                           return !grains.fixed[g] && (simulation.position(g) - centre).norm() >
                                                          scene.drum_diameter / 2;
                         }),
            0U);
  // The drum turns clockwise; the bed leans to the left, where the drum moves up.
  double moment = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) moment += grains.mass[g] * (simulation.position(g) - centre).x();
  EXPECT_LT(moment, 0);
}

TEST(Geometry, AShearCellHoldsItsPressureAndItsPlateItsSpeed)
{
  const auto scene =
      scene_from({"--geometry", "shear", "--length", "10dL", "--depth", "16dS", "--plate-speed",
                  "0.5", "--plate-pressure", "3", "--size-ratio", "1", "--spread", "0.4"});
  auto simulation = released(scene);
  const auto& grains = simulation.world().grains;
  const auto plate = bodies_of(scene, grains).front();
  run_for(simulation, 1);
  Frame<2> frame;
  double pressure = 0;
  constexpr int steps = 4000;
  for (int step = 0; step < steps; ++step) {
    simulation.advance(frame);
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      if (frame.contacts.j[c] >= static_cast<int>(plate.begin))
        pressure -= frame.contacts.force[c].y() / (scene.length * steps);
  }
  EXPECT_NEAR(pressure, 3, 0.1);
  for (auto row = plate.begin; row < plate.end; ++row)
    EXPECT_NEAR(simulation.velocity(row).x(), 0.5, 1e-9);
}

TEST(Geometry, APlateSinksIntoItsGrainsNoFasterThanTheyIntoEachOther)
{
  const auto scene = scene_from({"--geometry", "shear", "--length", "30dS", "--depth", "40dS",
                                 "--plate-speed", "0.1", "--size-ratio", "1", "--spread", "0.4"});
  auto simulation = released(scene);
  const auto first = static_cast<int>(bodies_of(scene, simulation.world().grains).front().begin);
  run_for(simulation, 0.25);
  Frame<2> frame;
  double at_plate = 0, elsewhere = 0, count_at_plate = 0, count_elsewhere = 0;
  for (int step = 0; step < 2000; ++step) {
    simulation.advance(frame);
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      const double gap = frame.contacts.gap[c];
      if (gap >= 0) continue;
      const bool plate = frame.contacts.j[c] >= first;
      (plate ? at_plate : elsewhere) -= gap;
      (plate ? count_at_plate : count_elsewhere) += 1;
    }
  }
  EXPECT_GT(count_at_plate, 1000);
  EXPECT_LT(at_plate / count_at_plate, elsewhere / count_elsewhere);
}

TEST(Geometry, AShearCellTakesItsTimeFromItsPressure)
{
  const auto one = scene_from({"--geometry", "shear", "--plate-pressure", "2"});
  const auto hundred =
      scene_from({"--geometry", "shear", "--plate-pressure", "200", "--frame-interval", "0.005"});
  EXPECT_NEAR(one.step, 10 * hundred.step, 1e-12);
  const auto given = scene_from({"--geometry", "shear", "--gravity", "9.8"});
  EXPECT_EQ(given.step, scene_from({}).step);
}

TEST(Geometry, AShearCellIsReleasedInALinearFlow)
{
  const auto scene = scene_from(
      {"--geometry", "shear", "--length", "10dL", "--depth", "16dS", "--plate-speed", "5"});
  const auto deposited = deposit<2>(scene);
  const auto simulation = release(deposited, scene);
  const auto& grains = simulation.world().grains;
  const double height = simulation.position(grains.size() - 1).y();
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) {
      const double added = simulation.velocity(g).x() - deposited.velocity(g).x();
      EXPECT_NEAR(added, 5 * simulation.position(g).y() / height, 1e-12);
    }
}

TEST(Geometry, AShakenBaseMovesAsAskedAndThrowsItsBed)
{
  const auto scene = scene_from({"--length", "6dL", "--depth", "8dS", "--shake-amplitude", "1dS",
                                 "--shake-frequency", "12", "--large-grains", "1"});
  auto simulation = released(scene);
  const auto& grains = simulation.world().grains;
  EXPECT_EQ(
      count_grains(simulation, [&](std::size_t g) { return grains.species[g] == Species::large; }),
      1U);
  double highest = 0;
  const double before = bed_height(simulation);
  while (simulation.time() < 0.5) {
    simulation.advance();
    highest = std::max(highest, bed_height(simulation));
  }
  // 4.5 amplitudes if the solver converges fully.
  EXPECT_GT(highest, before + 3 * scene.shake_amplitude);  // acceleration 5.8 g
}

TEST(Geometry, ABaseThatIsNoLongerShakenStandsStill)
{
  auto scene = scene_from(
      {"--length", "6dL", "--depth", "8dS", "--shake-amplitude", "1dS", "--shake-frequency", "12"});
  auto simulation = released(scene);
  run_for(simulation, 0.1);
  scene.shake_amplitude = 0;
  start_flow(simulation, scene);
  const auto last = simulation.world().grains.size() - 1;  // a bead of the base
  const auto before = simulation.position(last);
  run_for(simulation, 0.1);
  EXPECT_EQ(simulation.position(last), before);
  EXPECT_EQ(simulation.velocity(last), Vec2::Zero());
}

TEST(Geometry, ARestartedShearCellContinuesBitwise)
{
  const auto scene = scene_from({"--geometry", "shear", "--length", "6dL", "--depth", "8dS"});
  auto through = released(scene);
  run_for(through, 0.1);
  Simulation<2> again(through.world(), through.state());
  again.drive(bodies_of(scene, again.world().grains));
  run_for(through, 0.1);
  run_for(again, 0.1);
  for (std::size_t g = 0; g < through.world().grains.size(); ++g)
    EXPECT_EQ(through.position(g), again.position(g));
}

TEST(Effects, AreNamedWhereASceneDoesNotNeedThem)
{
  EXPECT_EQ(effects_left_out(scene_from({})), "moving boundaries (none moves)");
  EXPECT_EQ(effects_left_out(scene_from({"--geometry", "shear"})), "gravity (none)");
  EXPECT_EQ(effects_left_out(scene_from({"--geometry", "drum", "--lateral", "walls", "--friction",
                                         "0", "--rotation", "off", "--restitution", "0",
                                         "--contact-law", "centred"})),
            "friction (its coefficient is 0), rotation (off), restitution (its coefficient is 0), "
            "memory of approaches (contacts act at once), periodicity (the cell has ends)");
}

TEST(Geometry, RefusesKeysThatDoNotFitIt)
{
  EXPECT_THROW(scene_from({"--geometry", "drum"}), SceneError);
  EXPECT_THROW(scene_from({"--geometry", "shear", "--lateral", "walls"}), SceneError);
  EXPECT_THROW(scene_from({"--geometry", "hopper", "--lateral", "walls", "--outlet", "1m"}),
               SceneError);
  EXPECT_THROW(scene_from({"--geometry", "shear", "--keep-deposition"}), SceneError);
  EXPECT_THROW(scene_from({"--shake-amplitude", "1dS"}), SceneError);
}

TEST(Geometry, ChecksLengthsInLargeDiametersOfItsOwnKeysOnly)
{
  const auto complaint = [](std::vector<std::string> words) {
    words.insert(words.end(), {"--size-ratio", "50", "--length", "4dL", "--depth", "60dS"});
    try {
      scene_from(words);
    } catch (const SceneError& error) {
      return error.key;
    }
    return std::string("none");
  };
  EXPECT_EQ(complaint({}), "none");
  EXPECT_EQ(complaint({"--geometry", "drum", "--lateral", "walls"}), "drum-diameter");
  EXPECT_EQ(complaint({"--geometry", "column", "--lateral", "walls"}), "column-width");
}

}  // namespace
}  // namespace grseg
