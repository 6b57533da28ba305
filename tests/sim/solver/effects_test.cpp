// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/digest.hpp"
#include "sim/run/recorder.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <functional>

/// Kernels leave out effects (docs/glossary.md) that a scene does not need. Whole flows computed
/// with and without an effect are equal to the last bit if its coefficient is neutral.
namespace grseg {
namespace {

using Change = std::function<void(World<2>&)>;

/// The small chute in motion, without spin, with changed conditions.
Simulation<2> chute_with(const Change& change, const std::vector<std::string>& words = {})
{
  auto start = small_chute::bed(small_chute::scene(words));
  for (int k = 0; k < 300; ++k) start.advance();
  auto world = start.world();
  change(world);
  std::vector<Vec2> position;
  for (std::size_t g = 0; g < world.grains.size(); ++g) position.push_back(start.position(g));
  Simulation<2> simulation(world, position);
  for (std::size_t g = 0; g < position.size(); ++g) simulation.set_velocity(g, start.velocity(g));
  return simulation;
}

/// Digest of all frames of a flow.
std::uint64_t flow(Simulation<2> simulation)
{
  std::uint64_t digest = 0;
  std::size_t contacts = 0;
  Frame<2> frame;
  for (int k = 0; k < 400; ++k) {
    simulation.advance(frame);
    contacts += frame.contacts.size();
    digest = frame_digest(frame, digest, false);
  }
  EXPECT_GT(contacts, 400u * 10);
  EXPECT_GT(simulation.pair_list_renewals(), 1u);
  return digest;
}

void make_general(World<2>& world)
{
  world.general = true;
}

TEST(Effects, AFlowWithoutFrictionIsOneOfFrictionZeroToTheLastBit)
{
  const Change smooth = [](World<2>& w) { w.material.friction = 0; };
  const Change zero = [&](World<2>& w) { smooth(w), make_general(w); };
  EXPECT_EQ(flow(chute_with(smooth)), flow(chute_with(zero)));
  EXPECT_NE(flow(chute_with(smooth)), flow(chute_with(make_general)));
}

TEST(Effects, AFlowWithoutRestitutionIsOneOfRestitutionZeroToTheLastBit)
{
  const Change inelastic = [](World<2>& w) { w.material.restitution = 0; };
  const Change zero = [&](World<2>& w) { inelastic(w), make_general(w); };
  EXPECT_EQ(flow(chute_with(inelastic)), flow(chute_with(zero)));
  EXPECT_NE(flow(chute_with(inelastic)), flow(chute_with(make_general)));
}

// Without friction nothing begins to spin; with friction, no coefficient would prevent a disc from
// spinning.
TEST(Effects, AFlowWithoutRotationIsOneInWhichNothingSpinsToTheLastBit)
{
  const Change unspun = [](World<2>& w) { w.material.friction = 0, make_general(w); };
  const Change unturned = [&](World<2>& w) { unspun(w), w.rotation = false; };
  const Change rough_and_unturned = [](World<2>& w) { w.rotation = false; };
  EXPECT_EQ(flow(chute_with(unturned)), flow(chute_with(unspun)));
  EXPECT_NE(flow(chute_with(rough_and_unturned)), flow(chute_with(make_general)));
}

TEST(Effects, AFlowBetweenWallsIsOneWhosePairsAreShiftedByNothingToTheLastBit)
{
  const Change nothing = [](World<2>&) {};
  const std::vector<std::string> steep{"--slope", "60"},
      walls{"--slope", "60", "--lateral", "walls"};
  EXPECT_EQ(flow(chute_with(nothing, walls)), flow(chute_with(make_general, walls)));
  EXPECT_NE(flow(chute_with(nothing, walls)), flow(chute_with(nothing, steep)));
}

// The gravity is so faint that its square is 0, and so is the solver's lower limit. The test uses
// the centred law, because the speculative law checks whether a pair has been slowed down at all.
TEST(Effects, AFlowWithoutGravityIsOneOfGravityBelowTheLastDigitToTheLastBit)
{
  const Change weightless = [](World<2>& w) { w.gravity = Vec2::Zero(); };
  const Change faint = [](World<2>& w) { w.gravity = {1e-200, -1e-200}; };
  const std::vector<std::string> centred{"--contact-law", "centred"};
  EXPECT_EQ(flow(chute_with(weightless, centred)), flow(chute_with(faint, centred)));
  EXPECT_NE(flow(chute_with(weightless, centred)), flow(chute_with([](World<2>&) {}, centred)));
}

}  // namespace
}  // namespace grseg
