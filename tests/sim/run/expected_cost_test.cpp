// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/expected_cost.hpp"

#include "formats/trajectory/reader.hpp"
#include "sim/run/run.hpp"
#include "tests/folder.hpp"
#include "tests/sim/small_chute.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace grseg {
namespace {

class ExpectedFile : public testing::TestWithParam<std::vector<std::string>> {};

INSTANTIATE_TEST_SUITE_P(
    Scenes, ExpectedFile,
    testing::Values(
        std::vector<std::string>{"--depth", "40dS", "--length", "20dL", "--duration", "2"},
        std::vector<std::string>{"--duration", "0.05"},
        std::vector<std::string>{"--duration", "1", "--frame-interval", "0.005"},
        std::vector<std::string>{"--duration", "1", "--store", "float32"},
        std::vector<std::string>{"--dimension", "3", "--width", "4dL", "--duration", "0.2"}));

TEST_P(ExpectedFile, IsAnUpperBoundByAQuarterAtMost)
{
  const auto scene = small_chute::scene(GetParam());
  const auto cost = expected_cost(scene);
  RunOptions options;
  options.output = fmt::format("expected_cost_{}.h5", getpid());
  options.overwrite = options.quiet = true;
  simulate(scene, options);
  const auto file = static_cast<double>(std::filesystem::file_size(options.output));
  EXPECT_GT(cost.file, file);
  EXPECT_LT(cost.file, 1.25 * file);
  const auto grains = TrajectoryReader(options.output).grains().size();
  EXPECT_NEAR(cost.grains, static_cast<double>(grains), 0.05 * static_cast<double>(grains));
  std::filesystem::remove(options.output);
}

TEST(ExpectedCost, OfARestartLeavesOutWhatIsDone)
{
  EXPECT_EQ(expected_cost(small_chute::scene({"--duration", "100"}), 75).file,
            expected_cost(small_chute::scene({"--duration", "25"})).file);
}

/// 24 million grains in 0.12 million layers would need 132 GB.
TEST(ExpectedCost, ABedThatDoesNotFitIntoMemoryIsRefusedUnlessItIsForced)
{
  ExpectedCost cost;
  cost.memory = 1e18;
  try {
    require_room(cost, "run.h5");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()).find("this run needs about 1000000 TB of memory"), 0)
        << error.what();
  }
  cost = {};
  cost.disk = 1e18;
  EXPECT_THROW(require_room(cost, "run.h5"), UsageError);
  cost.file = cost.disk = 1e3;
  EXPECT_NO_THROW(require_room(cost, "run.h5"));
}

// Its base alone would need more memory than there is.
TEST(ExpectedCost, OfAHugeBedIsKnownWithoutItsBase)
{
  const auto scene =
      small_chute::scene({"--dimension", "3", "--length", "1e5dL", "--width", "1e5dL"});
  EXPECT_GT(expected_cost(scene).memory, 1e12);
}

// Some 40,000 small grains of a tenth of d_L would lie in the smallest bed.
TEST(ExpectedCost, HasNoTimeIfTheSmallestBedOfSuchGrainsIsLarge)
{
  const auto scene = small_chute::scene({"--dimension", "3", "--base", "wall", "--size-ratio", "10",
                                         "--depth", "30dS", "--width", "8dL"});
  EXPECT_FALSE(expected_cost(scene, 0, Measure::always).seconds);
}

TEST(ExpectedCost, IsSaidInFewWords)
{
  EXPECT_EQ(
      to_text({.grains = 3357, .memory = 43.4e6, .file = 1.46e9, .disk = 1.46e9, .seconds = 190.0}),
      "3357 grains, 43 MB of memory, a file of up to 1.5 GB, about 3 minutes");
  EXPECT_EQ(
      to_text({.grains = 100, .memory = 26e6, .file = 9960, .disk = 2e4, .seconds = {}}),
      "100 grains, 26 MB of memory, a file of up to 10 kB before and 20 kB while it is compressed");
}

TEST(ExpectedCost, AnEstimateOfAShortRunStatesItsTimeToo)
{
  const auto scene = small_chute::scene({"--duration", "0.1"});
  EXPECT_FALSE(expected_cost(scene).seconds);
  const auto cost = expected_cost(scene, 0, Measure::always);
  ASSERT_TRUE(cost.seconds);
  EXPECT_GT(*cost.seconds, 0);
  EXPECT_EQ(to_table({.grains = 3, .memory = 2e6, .file = 1e9, .seconds = 12.34}),
            "grains\tmemory[bytes]\tfile[bytes]\ttime[s]\n3\t2000000\t1000000000\t12\n");
}

}  // namespace
}  // namespace grseg
