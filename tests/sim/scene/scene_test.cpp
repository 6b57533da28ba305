// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/scene.hpp"

#include "formats/cli/tool.hpp"
#include "formats/core/errors.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/step/energies.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace grseg {
namespace {

namespace fs = std::filesystem;

po::variables_map parse(const std::vector<std::string>& words)
{
  po::variables_map values;
  po::store(po::command_line_parser(words).options(scene_options()).run(), values);
  po::notify(values);
  return values;
}

Scene scene_from(const std::vector<std::string>& words)
{
  return resolve_scene(parse(words));
}

class SceneFile : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / ("grseg_scene_test_" + std::to_string(getpid()) + ".ini"))
          .string();
  void TearDown() override { fs::remove(path); }
  std::string complaint(const std::string& content)
  {
    std::ofstream(path) << content;
    auto values = parse({});
    try {
      read_scene_file(path, values);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST(Scene, DefaultsAreThePapersFlow)
{
  const auto scene = scene_from({});
  EXPECT_DOUBLE_EQ(scene.small_diameter, 0.005);
  EXPECT_DOUBLE_EQ(scene.large_diameter, 0.01);
  EXPECT_DOUBLE_EQ(scene.depth, 0.3);
  EXPECT_DOUBLE_EQ(scene.length, 0.35);
  EXPECT_EQ(scene.slope, 23);
  EXPECT_EQ(scene.friction, 0.5);
  EXPECT_EQ(scene.restitution, 0.25);
  EXPECT_EQ(scene.duration, 150);
}

TEST(Scene, AWholeNumberOfStepsFitsIntoAFrameInterval)
{
  for (const auto* accuracy : {"draft", "standard", "reference"}) {
    const auto scene = scene_from({"--accuracy", accuracy, "--frame-interval", "0.0123"});
    const double steps = scene.frame_interval / scene.step;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
  EXPECT_THROW(scene_from({"--step", "0.0003"}), UsageError);
}

TEST(Scene, StorageIsAsAsked)
{
  EXPECT_TRUE(scene_from({"--store", "float32"}).float32);
  EXPECT_EQ(scene_from({"--compression", "4"}).compression, 4);
}

TEST(Scene, GravityPointsDownTheSlopeAndIntoTheBase)
{
  const auto gravity = to_parameters(scene_from({"--slope", "30"})).numbers.at("gravity");
  EXPECT_NEAR(gravity[0], 4.9, 1e-12);
  EXPECT_NEAR(gravity[1], -9.8 * std::sqrt(3.0) / 2, 1e-12);
}

TEST(Scene, ASlopeThatTurnsIsToldAndMustTurnSlowly)
{
  const auto scene = scene_from({"--slope", "0", "--slope-rate", "5"});
  EXPECT_EQ(to_parameters(scene).numbers.at("slope_rate").at(0), 5);
  const auto later = gravity_of(scene).at(6);  // at 30 degrees
  EXPECT_NEAR(later.x(), 4.9, 1e-12);
  for (const auto& words : {std::vector<std::string>{"--slope-rate", "5000"},
                            {"--slope-rate", "5", "--geometry", "shear"}}) {
    try {
      scene_from(words);
      FAIL();
    } catch (const SceneError& error) {
      EXPECT_EQ(error.key, "slope-rate");
    }
  }
}

TEST(Scene, ItsTextMakesTheSameScene)
{
  const auto scene = scene_from(
      {"--phi-large", "0.45", "--slope", "21.5", "--rotation", "off", "--slope-rate", "0.25"});
  const auto path =
      (fs::temp_directory_path() / ("grseg_scene_" + std::to_string(getpid()) + ".ini")).string();
  std::ofstream(path) << to_text(scene);
  auto values = parse({});
  read_scene_file(path, values);
  fs::remove(path);
  EXPECT_EQ(to_text(resolve_scene(values)), to_text(scene));
}

TEST(Scene, ValuesOutOfRangeAreRefusedByName)
{
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"phi-large", "1.5"},
                                                        {"restitution", "-0.1"},
                                                        {"friction", "nan"},
                                                        {"depth", "0"},
                                                        {"length", "3dL"},
                                                        {"slope", "91"},
                                                        {"step", "0.1"},
                                                        {"rotation", "maybe"},
                                                        {"accuracy", "best"},
                                                        {"seed", "-1"},
                                                        {"threads", "-1"},
                                                        {"base", "sand"}}) {
    try {
      scene_from({"--" + key, value});
      FAIL() << key;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
  }
}

TEST_F(SceneFile, AnUnknownKeyIsNamedWithItsLineAndTheNearestKnownOne)
{
  EXPECT_EQ(complaint("# a chute\nslope = 23\nfrction = 0.5\n"),
            path + ":3: unknown key 'frction', did you mean 'friction'?");
}

TEST_F(SceneFile, AValueThatIsNoNumberIsNamedWithItsLine)
{
  EXPECT_EQ(complaint("slope = steep\n").substr(0, path.size() + 3), path + ":1:");
}

TEST_F(SceneFile, AValueOutOfRangeIsTheFilesFaultUnlessTheCommandLineGaveIt)
{
  std::ofstream(path) << "# a chute\nphi-large = 1.5\n";
  try {
    resolve_scene(path, parse({}));
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_EQ(std::string(error.what()),
              path + ":2: phi-large is 1.5: it must lie between 0 and 1");
  }
  EXPECT_NO_THROW(resolve_scene(path, parse({"--phi-large", "0.5"})));
  EXPECT_THROW(resolve_scene(path, parse({"--phi-large", "2"})), UsageError);
}

TEST_F(SceneFile, TheCommandLineWins)
{
  std::ofstream(path) << "slope = 21\nfriction = 0.3\n";
  auto values = parse({"--slope", "26"});
  read_scene_file(path, values);
  const auto scene = resolve_scene(values);
  EXPECT_EQ(scene.slope, 26);
  EXPECT_EQ(scene.friction, 0.3);
}

TEST_F(SceneFile, ThatIsMissingIsAUsageError)
{
  auto values = parse({});
  EXPECT_THROW(read_scene_file("/nowhere/chute.ini", values), UsageError);
}

TEST(Deposition, MakesABedOfTheAskedDepthAndComposition)
{
  const auto scene = scene_from(
      {"--depth", "12dS", "--length", "15dL", "--phi-large", "0.4", "--accuracy", "draft"});
  const auto simulation = deposit(scene);
  EXPECT_NEAR(bed_height(simulation), scene.depth, 0.02 * scene.depth);
  const auto& grains = simulation.world().grains;
  double large = 0, all = 0, y_large = 0, y_small = 0;
  int count_large = 0, count_small = 0, base = 0;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    base += grains.species[k] == Species::boundary;
    if (grains.fixed[k]) continue;
    const double area = std::numbers::pi * grains.radius[k] * grains.radius[k];
    const bool is_large = grains.species[k] == Species::large;
    all += area;
    large += is_large ? area : 0;
    (is_large ? y_large : y_small) += simulation.position(k).y();
    ++(is_large ? count_large : count_small);
    EXPECT_NEAR(2 * grains.radius[k], is_large ? 0.01 : 0.005, 0.04 * (is_large ? 0.01 : 0.005));
    EXPECT_GT(simulation.position(k).y(), 0);
  }
  EXPECT_EQ(base, 15);
  EXPECT_NEAR(large / all, 0.4, 0.02);
  EXPECT_LT(y_large / count_large, 0.6 * y_small / count_small);
}

/// Kinetic energy over m g d of a small grain, per grain, of a bed left flat for a second.
double trembling(const std::string& accuracy, const std::string& min_sweeps)
{
  const auto scene = scene_from({"--depth", "40dS", "--length", "10dL", "--accuracy", accuracy});
  auto simulation = deposit(scene);
  const auto loose = scene_from({"--accuracy", accuracy, "--min-sweeps", min_sweeps});
  auto world = simulation.world();
  world.solver = loose.solver;
  simulation = Simulation(world, simulation.state());
  double most = 0;
  while (simulation.time() < 1) {
    simulation.advance();
    if (simulation.time() > 0.5) most = std::max(most, translational_energy(simulation));
  }
  const auto& grains = world.grains;
  const double small = std::numbers::pi / 4 * scene.small_diameter * scene.small_diameter;
  return most / (static_cast<double>(grains.size()) * scene.density * small * scene.gravity *
                 scene.small_diameter);
}

TEST(Deposition, ABedAtRestStaysAtRest)
{
  for (const auto* accuracy : {"draft", "standard"}) {
    EXPECT_LT(trembling(accuracy, "8"), 1e-3) << accuracy;
    EXPECT_GT(trembling(accuracy, "1"), 2e-3) << accuracy << ": the least number is for nothing";
  }
}

TEST(Deposition, GivesTheWorldWhatTheSceneSays)
{
  const auto scene =
      scene_from({"--depth", "6dS", "--length", "6dL", "--origin", "centre", "--rotation", "off",
                  "--density", "3", "--tolerance", "0.3", "--max-sweeps", "77", "--threads", "3"});
  const auto simulation = deposit(scene);
  const auto& world = simulation.world();
  EXPECT_FALSE(world.rotation);
  EXPECT_EQ(world.solver.tolerance, 0.3);
  EXPECT_EQ(world.solver.max_sweeps, 77);
  EXPECT_EQ(world.threads, 3);
  EXPECT_EQ(simulation.time(), 0);
  for (std::size_t k = 0; k < world.grains.size(); ++k) {
    const double r = world.grains.radius[k];
    EXPECT_DOUBLE_EQ(world.grains.mass[k], 3 * std::numbers::pi * r * r);
    if (world.grains.fixed[k]) {
      EXPECT_EQ(simulation.position(k).y(), 0);
    }
  }
}

TEST(Deposition, IsRecordedBeforeTheTiltWithoutChangingTheBed)
{
  const auto scene = scene_from({"--depth", "6dS", "--length", "6dL", "--accuracy", "draft"});
  std::int64_t steps = 0;
  std::vector<double> times;
  const auto recorded = deposit(
      scene,
      {.each_step = {}, .record = [&](const StepReport&, const Simulation&, const Frame* frame) {
         ++steps;
         if (frame != nullptr) times.push_back(frame->time);
       }});
  ASSERT_GE(times.size(), 2u);
  EXPECT_GE(times.front(), -static_cast<double>(steps) * scene.step);
  EXPECT_LT(times.back(), 0);
  EXPECT_NEAR(times[1] - times[0], scene.frame_interval, 1e-12);
  EXPECT_EQ(recorded.position(3), deposit(scene).position(3));
}

TEST(Deposition, EndsWhenItIsAskedTo)
{
  const auto scene = scene_from({"--accuracy", "draft"});
  int steps = 0;
  const auto listen = [&] {
    if (++steps == 10) throw ToolError(exit_interrupted, "interrupted");
  };
  EXPECT_THROW(deposit(scene, {.each_step = listen, .record = {}}), ToolError);
  EXPECT_EQ(steps, 10);
}

TEST(Deposition, WithoutGrainsIsRefused)
{
  EXPECT_THROW(deposit(scene_from({"--size-ratio", "100", "--phi-large", "1", "--depth", "1dS",
                                   "--length", "4dL", "--base", "wall"})),
               UsageError);
}

TEST(Deposition, AnotherSeedMakesAnotherBedAndTheSameSeedTheSame)
{
  const auto bed = [](const char* seed) {
    return deposit(
        scene_from({"--depth", "6dS", "--length", "6dL", "--accuracy", "draft", "--seed", seed}));
  };
  const auto first = bed("1"), again = bed("1"), other = bed("2");
  EXPECT_EQ(first.position(3), again.position(3));
  EXPECT_NE(first.position(3), other.position(3));
}

TEST(Deposition, StandsOnAStraightWallBetweenWallsToo)
{
  const auto simulation = deposit(scene_from({"--depth", "8dS", "--length", "8dL", "--base", "wall",
                                              "--lateral", "walls", "--accuracy", "draft"}));
  for (std::size_t k = 0; k < simulation.world().grains.size(); ++k) {
    EXPECT_FALSE(simulation.world().grains.fixed[k]);
    const double r = simulation.world().grains.radius[k];
    const auto at = simulation.position(k);
    EXPECT_GT(at.y(), 0.9 * r);
    EXPECT_GT(at.x(), 0.9 * r);
    EXPECT_LT(at.x(), simulation.world().box.length_x - 0.9 * r);
  }
}

}  // namespace
}  // namespace grseg
