// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/player_data.hpp"

#include "tests/analysis/explore/unpacked.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

constexpr float absent = NAN;

ShownRun two_frames()
{
  ShownRun run;
  run.row = {4, 7, 9};
  run.radius = {0.01f, 0.005f, 0.01f};
  run.species = {Species::large, Species::small, Species::boundary};
  ShownFrame first;
  first.step = 10;
  first.time = 0.5;
  first.x = {0.1f, 0.2f, 0.3f};
  first.y = {0, 0.05f, -0.01f};
  first.z = {0, 0, 0};
  first.i = {0, 0, 1};
  first.j = {1, 2, -2};
  first.along = {2, 4, 1};
  first.across = {1, -2, 0.25f};
  first.walls = {{NAN, NAN, NAN}, {0, 1, -0.02f}};
  ShownFrame second = first;
  second.step = 20;
  second.time = 1;
  second.x[1] = second.y[1] = absent;
  second.i = {0};
  second.j = {2};
  second.along = {0.5f};
  second.across = {0.1f};
  run.frames = {first, second};
  return run;
}

constexpr Box cell{0.4, 0.5, true};

TEST(PlayerData, PositionsComeBackWithinHalfAStep)
{
  BinaryArrays arrays;
  const auto run = two_frames();
  const auto data = player_data(run, cell, arrays);
  for (const char* axis : {"x", "y"}) {
    const auto codes = unpacked::array<std::uint16_t>(arrays, axis, "u16");
    ASSERT_EQ(codes.size(), 6u);
    const double from = data["bounds"][axis]["from"], step = data["bounds"][axis]["step"];
    for (std::size_t k = 0; k < 6; ++k) {
      const auto& frame = run.frames[k / 3];
      const double value = (*axis == 'x' ? frame.x : frame.y)[k % 3];
      if (std::isnan(value))
        EXPECT_EQ(codes[k], 65535);
      else
        EXPECT_NEAR(from + codes[k] * step, value, 0.51 * step);
    }
  }
  EXPECT_EQ(data["bounds"]["x"]["from"], 0) << "a periodic axis is coded over the whole cell";
  EXPECT_DOUBLE_EQ(data["bounds"]["x"]["step"], 0.4 / 65534);
}

TEST(PlayerData, SpheresHaveTheirPlaceInTheSlice)
{
  auto run = two_frames();
  run.frames[0].z = {-0.01f, 0.01f, 0.005f};
  BinaryArrays arrays;
  const auto data = player_data(run, {0.4, 0.5, true, 3, 0.1, true}, arrays);
  const auto codes = unpacked::array<std::uint16_t>(arrays, "z", "u16");
  ASSERT_EQ(codes.size(), 6u);
  EXPECT_EQ(codes[0], 0) << "the farthest";
  EXPECT_EQ(codes[1], 65534) << "the nearest";
  const double from = data["bounds"]["z"]["from"], step = data["bounds"]["z"]["step"];
  EXPECT_NEAR(from + codes[2] * step, 0.005, 0.51 * step);
}

TEST(PlayerData, ContactsAreCountedFrameByFrameAndWallsFromTheTop)
{
  BinaryArrays arrays;
  player_data(two_frames(), cell, arrays);
  EXPECT_EQ(unpacked::array<std::uint32_t>(arrays, "contact_offset", "u32"),
            (std::vector<std::uint32_t>{0, 3, 4}));
  EXPECT_EQ(unpacked::array<std::uint16_t>(arrays, "i", "u16"),
            (std::vector<std::uint16_t>{0, 0, 1, 0}));
  EXPECT_EQ(unpacked::array<std::uint16_t>(arrays, "j", "u16"),
            (std::vector<std::uint16_t>{1, 2, 65534, 2}))
      << "wall 1 is 2^16 - 1 - 1";
  EXPECT_EQ(unpacked::array<std::uint8_t>(arrays, "species", "u8"),
            (std::vector<std::uint8_t>{1, 0, 255}));
}

TEST(PlayerData, ForcesComeBackWithinHalfAStep)
{
  auto run = two_frames();
  run.frames[1].across = {20};  // the component across may be many times the one along
  const double along_were[] = {2, 4, 1, 0.5}, across_were[] = {1, -2, 0.25, 20};
  BinaryArrays arrays;
  const auto data = player_data(run, cell, arrays);
  const auto along = unpacked::array<std::uint16_t>(arrays, "along", "u16");
  const auto across = unpacked::array<std::uint16_t>(arrays, "across", "u16");
  EXPECT_EQ(data["bounds"]["along"]["from"], 0) << "no force has the code 0";
  EXPECT_DOUBLE_EQ(data["bounds"]["across"]["step"], 22.0 / 65534) << "-2 to 20";
  for (std::size_t k = 0; k < 4; ++k) {
    const auto of = [&](const char* name, std::uint16_t code) {
      const auto& bounds = data["bounds"][name];
      return bounds["from"].get<double>() + code * bounds["step"].get<double>();
    };
    EXPECT_NEAR(of("along", along[k]), along_were[k], 0.51 * 4 / 65534);
    EXPECT_NEAR(of("across", across[k]), across_were[k], 0.51 * 22 / 65534);
  }
}

TEST(PlayerData, WallsThatAFrameDoesNotKnowYetAreNotNumbers)
{
  auto run = two_frames();
  run.frames[0].walls.clear();
  BinaryArrays arrays;
  const auto data = player_data(run, cell, arrays);
  EXPECT_EQ(data["walls"], 2);
  const auto walls = unpacked::array<float>(arrays, "walls", "f32");
  ASSERT_EQ(walls.size(), 12u);
  EXPECT_TRUE(std::isnan(walls[5]));
  EXPECT_EQ(walls[10], 1);
  EXPECT_EQ(walls[11], -0.02f);
}

TEST(PlayerData, GravityIsToldFrameByFrame)
{
  auto run = two_frames();
  run.frames[0].gravity = {1, -9};
  run.frames[1].gravity = {2, -8};
  BinaryArrays arrays;
  EXPECT_EQ(player_data(run, cell, arrays)["gravity"].dump(), "[[1.0,-9.0],[2.0,-8.0]]");
}

TEST(PlayerData, ManyGrainsTakeWiderNumbers)
{
  ShownRun run;
  const std::size_t many = (1u << 15) + 1;
  run.row.resize(many);
  run.radius.resize(many, 1);
  run.species.resize(many, Species::small);
  ShownFrame frame;
  frame.x = frame.y = frame.z = std::vector<float>(many, 1);
  frame.i = {static_cast<std::int32_t>(many - 1)};
  frame.j = {-1};
  frame.along = frame.across = {1};
  frame.walls = {{0, 1, 0}};
  run.frames = {frame};
  BinaryArrays arrays;
  player_data(run, cell, arrays);
  EXPECT_EQ(unpacked::array<std::uint32_t>(arrays, "i", "u32"),
            (std::vector<std::uint32_t>{1u << 15}));
  EXPECT_EQ(unpacked::array<std::uint32_t>(arrays, "j", "u32"),
            (std::vector<std::uint32_t>{4294967295u}));
}

}  // namespace
}  // namespace grseg
