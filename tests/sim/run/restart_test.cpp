// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/restart.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/digest.hpp"
#include "sim/solver/sweep.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace grseg {
namespace {

using small_chute::bed;
using small_chute::checkpoint_of;
using small_chute::scene;
using small_chute::tilted_gravity;

/// Digest chained over all frames of `steps` steps.
std::uint64_t digest_of_steps(Simulation<2>& simulation, int steps, std::uint64_t before = 0)
{
  Frame<2> frame;
  for (int k = 0; k < steps; ++k) {
    simulation.advance(frame);
    before = frame_digest(frame, before, false);
  }
  return before;
}

Checkpoint<2> through_a_file(const Checkpoint<2>& checkpoint)
{
  const auto path = (std::filesystem::temp_directory_path() /
                     ("grseg_restart_test_" + std::to_string(getpid()) + ".chk"))
                        .string();
  write_checkpoint(path, checkpoint);
  auto read = std::get<Checkpoint<2>>(read_checkpoint(path));
  std::filesystem::remove(path);
  return read;
}

Simulation<2> restarted(const Simulation<2>& simulation, const Scene& scene)
{
  auto again =
      restored_simulation(through_a_file(checkpoint_of(simulation, scene)), scene, scene, {});
  again.tilt(tilted_gravity(scene));
  return again;
}

TEST(Restart, OfABedOfLargeGrainsAloneIsPossible)
{
  const auto large = scene({"--phi-large", "1", "--size-ratio", "4"});
  EXPECT_NO_THROW(restarted(bed(large), large));
}

void expect_a_restart_to_change_nothing(const Scene& scene)
{
  auto undisturbed = bed(scene);
  auto first = undisturbed;
  const auto half = digest_of_steps(first, 1000);
  auto second = restarted(first, scene);
  EXPECT_EQ(second.steps_done(), 1000);
  const auto whole = digest_of_steps(second, 1000, half);
  hard_cases::Case("H37", "2000 steps are 1000, a restart and 1000, bit for bit")
      .holds(digest_of_steps(undisturbed, 2000) == whole);
  EXPECT_EQ(second.pair_list_renewals(), undisturbed.pair_list_renewals());
  EXPECT_GT(first.pair_list_renewals(), 1u);
  EXPECT_EQ(second.state().pairs.impulse_t, undisturbed.state().pairs.impulse_t);
}

TEST(Restart, TwoThousandStepsAreAThousandARestartAndAThousand)
{
  expect_a_restart_to_change_nothing(scene());
}

TEST(Restart, BetweenWallsToo)
{
  expect_a_restart_to_change_nothing(scene({"--base", "wall", "--lateral", "walls"}));
}

TEST(Restart, OnAnotherInstructionSetToo)
{
  const auto chute = scene();
  auto undisturbed = bed(chute);
  const auto start = undisturbed;
  const auto whole = digest_of_steps(undisturbed, 600);
  for (const auto& set : instruction_sets()) {
    use_instruction_set("");
    auto first = start;
    const auto half = digest_of_steps(first, 300);
    use_instruction_set(set);
    auto second = restarted(first, chute);
    EXPECT_EQ(digest_of_steps(second, 300, half), whole) << set;
  }
  use_instruction_set("");
}

TEST(Restart, AtAnyStepBetweenTwoRenewalsOfThePairList)
{
  const auto chute = scene();
  auto simulation = bed(chute);
  std::vector<std::uint64_t> digests;
  std::vector<Checkpoint<2>> checkpoints;
  for (int k = 0; k < 400; ++k) {
    if (k % 13 == 0) checkpoints.push_back(checkpoint_of(simulation, chute));
    digests.push_back(digest_of_steps(simulation, 1));
  }
  for (const auto& checkpoint : checkpoints) {
    auto again = restored_simulation(checkpoint, chute, chute, {});
    again.tilt(tilted_gravity(chute));
    for (auto k = static_cast<std::size_t>(checkpoint.state.steps_done); k < 400; ++k)
      ASSERT_EQ(digest_of_steps(again, 1), digests[k]) << "from " << checkpoint.state.steps_done;
  }
}

TEST(Restart, UnderEveryOtherContactLawTheFlowGoesOn)
{
  const auto chute = scene();
  auto first = bed(chute);
  digest_of_steps(first, 50);
  const auto checkpoint = through_a_file(checkpoint_of(first, chute));
  for (const char* law : {"touch", "predictive", "centred"}) {
    const auto other = scene({"--contact-law", law});
    auto again = restored_simulation(checkpoint, chute, other, {});
    again.tilt(tilted_gravity(other));
    EXPECT_NE(digest_of_steps(again, 50), digest_of_steps(first, 50)) << law;
    EXPECT_EQ(again.steps_done(), 100);
  }
}

TEST(Restart, WithoutFrictionNoContactKeepsItsTangentialForce)
{
  const auto chute = scene(), smooth = scene({"--friction", "0"});
  auto first = bed(chute);
  digest_of_steps(first, 50);
  auto again = restored_simulation(checkpoint_of(first, chute), chute, smooth, {});
  again.tilt(tilted_gravity(smooth));
  Frame<2> frame;
  again.advance(frame);
  ASSERT_GT(frame.contacts.size(), 30u);
  for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
    const auto &force = frame.contacts.force[c], &branch = frame.contacts.branch[c];
    EXPECT_LE(std::abs(force.x() * branch.y() - force.y() * branch.x()),
              1e-12 * force.norm() * branch.norm());
  }
}

TEST(Restart, OfAListThatWasNeverMade)
{
  const auto chute = scene();
  const auto deposited = bed(chute);
  std::vector<Vec2> position;
  for (std::size_t g = 0; g < deposited.world().grains.size(); ++g)
    position.push_back(deposited.position(g));
  Simulation<2> undisturbed(deposited.world(), position);
  auto again = restarted(undisturbed, chute);
  EXPECT_EQ(digest_of_steps(again, 20), digest_of_steps(undisturbed, 20));
}

TEST(Restart, WithOtherPairsThanTheProgramFindsIsRefused)
{
  const auto chute = scene();
  auto simulation = bed(chute);
  auto checkpoint = checkpoint_of(simulation, chute);
  checkpoint.state.pairs.j.back() ^= 1;
  EXPECT_THROW(restored_simulation(checkpoint, chute, chute, {}), FormatError);
}

TEST(Restart, AnotherStepKeepsTheTimeAndScalesTheImpulses)
{
  const auto chute = scene();
  auto simulation = bed(chute);
  for (int k = 0; k < 100; ++k) simulation.advance();
  const auto checkpoint = checkpoint_of(simulation, chute);
  auto finer = chute;
  finer.step = chute.step / 4;
  const auto again = restored_simulation(checkpoint, chute, finer, {});
  EXPECT_EQ(again.steps_done(), 400);
  EXPECT_DOUBLE_EQ(again.time(), simulation.time());
  const auto before = simulation.state().pairs.impulse_n, after = again.state().pairs.impulse_n;
  double largest = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(after[k], before[k] / 4);
    largest = std::max(largest, before[k]);
  }
  EXPECT_GT(largest, 0);
}

TEST(Restart, AStepThatDoesNotDivideTheTimeIsRefusedWithARemedy)
{
  const auto chute = scene({"--step", "2.5e-4"});
  auto simulation = bed(chute);
  for (int k = 0; k < 101; ++k) simulation.advance();
  auto coarser = chute;
  coarser.step = 2 * chute.step;
  try {
    restored_simulation(checkpoint_of(simulation, chute), chute, coarser, {});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(
        error.what(),
        "the checkpoint's time, 0.02525 s, is not a whole number of steps of 0.0005 s; choose a "
        "step that divides it, or first continue with the old step to the next frame: --duration "
        "0.05");
  }
}

TEST(Restart, APerturbationMovesMobileGrainsByUpToItsSizeAndItsSeedTellsHow)
{
  const auto chute = scene();
  const auto simulation = bed(chute);
  const auto checkpoint = checkpoint_of(simulation, chute);
  const auto one = restored_simulation(checkpoint, chute, chute, {1e-6, 1}),
             same = restored_simulation(checkpoint, chute, chute, {1e-6, 1}),
             other = restored_simulation(checkpoint, chute, chute, {1e-6, 2});
  const double most = 1e-6 * chute.small_diameter;
  double largest = 0;
  std::size_t differ = 0;
  for (std::size_t g = 0; g < checkpoint.grains.size(); ++g) {
    const double moved = (one.position(g) - simulation.position(g)).norm();
    EXPECT_EQ(one.position(g), same.position(g));
    EXPECT_LE(moved, most * (1 + 1e-6));  // positions are rounded
    EXPECT_EQ(checkpoint.grains.fixed[g] != 0, moved == 0);
    largest = std::max(largest, moved);
    differ += one.position(g) != other.position(g);
  }
  EXPECT_GT(largest, 0.8 * most);
  EXPECT_GT(differ, checkpoint.grains.size() / 2);
}

Scene with_words(const Checkpoint<2>& checkpoint, const std::vector<std::string>& words)
{
  namespace po = boost::program_options;
  po::variables_map given;
  po::store(po::command_line_parser(words).options(scene_options()).run(), given);
  return scene_of(checkpoint.scene, "run.chk", given);
}

TEST(Restart, TheCommandLineWinsOverTheCheckpointAndTheRestStays)
{
  const auto chute = scene({"--friction", "0.3"});
  Checkpoint<2> checkpoint;
  checkpoint.scene = to_text(chute);
  const auto now = with_words(checkpoint, {"--duration", "300", "--slope", "21"});
  EXPECT_EQ(now.duration, 300);
  EXPECT_EQ(now.slope, 21);
  EXPECT_EQ(now.friction, 0.3);
  EXPECT_EQ(now.step, chute.step);
  EXPECT_EQ(to_text(with_words(checkpoint, {})), checkpoint.scene);
}

// The speculative law would change the energy of an elastic gas.
TEST(Restart, AGivenRestitutionBringsItsUsualLawUnlessAnotherLawWasChosen)
{
  Checkpoint<2> checkpoint;
  checkpoint.scene = to_text(scene({"--restitution", "0.3"}));
  EXPECT_EQ(with_words(checkpoint, {"--restitution", "1"}).law, ContactLaw::centred);
  EXPECT_EQ(with_words(checkpoint, {"--slope", "0"}).law, ContactLaw::speculative);
  const std::vector<std::string> chosen{"--restitution", "1", "--contact-law", "touch"};
  EXPECT_EQ(with_words(checkpoint, chosen).law, ContactLaw::touch);
  checkpoint.scene = to_text(scene({"--restitution", "0.3", "--contact-law", "touch"}));
  EXPECT_EQ(with_words(checkpoint, {"--restitution", "1"}).law, ContactLaw::touch);
}

TEST(Restart, AGivenAccuracyReplacesStepToleranceAndSweeps)
{
  Checkpoint<2> checkpoint;
  checkpoint.scene = to_text(scene());
  const auto now = with_words(checkpoint, {"--accuracy", "reference"});
  const auto fresh = scene({"--accuracy", "reference"});
  EXPECT_EQ(now.step, fresh.step);
  EXPECT_EQ(now.solver.tolerance, fresh.solver.tolerance);
  EXPECT_EQ(now.solver.max_sweeps, fresh.solver.max_sweeps);
  EXPECT_EQ(now.solver.min_sweeps, fresh.solver.min_sweeps);
}

TEST(Restart, KeysOfTheBedCannotChange)
{
  const auto chute = scene();
  Checkpoint<2> checkpoint;
  checkpoint.scene = to_text(chute);
  EXPECT_NO_THROW(require_same_bed(chute, with_words(checkpoint, {"--depth", "8dS"})));
  EXPECT_NO_THROW(require_same_bed(chute, with_words(checkpoint, {"--friction", "0.1"})));
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"small-diameter", "6mm"},
                                                        {"size-ratio", "1.9"},
                                                        {"spread", "0.1"},
                                                        {"density", "2"},
                                                        {"density-ratio", "2"},
                                                        {"phi-large", "0.4"},
                                                        {"depth", "9dS"},
                                                        {"length", "9dL"},
                                                        {"seed", "2"},
                                                        {"rotation", "off"},
                                                        {"base", "wall"},
                                                        {"lateral", "walls"},
                                                        {"origin", "centre"}}) {
    try {
      require_same_bed(chute, with_words(checkpoint, {"--" + key, value}));
      ADD_FAILURE() << key;
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).find(key + " differs from the checkpoint's"), 0u) << key;
    }
  }
}

// In floating point, 70 d_S of 5 mm are 0.35000000000000003 m.
TEST(Restart, ALengthInOtherUnitsIsNoOtherBed)
{
  const auto chute = scene({"--length", "70dS"});
  Checkpoint<2> checkpoint;
  checkpoint.scene = to_text(chute);
  for (const char* length : {"0.35m", "350mm", "35cm"}) {
    const auto now = without_round_off(with_words(checkpoint, {"--length", length}), chute);
    EXPECT_EQ(to_text(now), to_text(chute)) << length;
  }
  const auto longer = without_round_off(with_words(checkpoint, {"--length", "0.351m"}), chute);
  EXPECT_EQ(longer.length, 0.351);
}

TEST(Restart, OnlyDurationAndStorageLeaveTheMotionAsItWas)
{
  const auto chute = scene();
  auto now = chute;
  now.duration = 300;
  now.float32 = true;
  EXPECT_TRUE(same_steps(chute, now));
  now.solver.tolerance /= 2;
  EXPECT_FALSE(same_steps(chute, now));
}

// Depth of a drum, spacing of a base that fills its cell, and gravity of a shear cell follow from
// other keys. If the program could not read them again, the checkpoint would be lost.
TEST(Restart, ATextOfASceneIsReadAgainIfTheSceneWasAccepted)
{
  using Words = std::vector<std::string>;
  for (const auto& words : {Words{"--geometry", "drum", "--lateral", "walls", "--drum-diameter",
                                  "40dS", "--fill", "0.026"},
                            Words{"--base-diameter", "10dL", "--length", "81dL"},
                            Words{"--geometry", "shear", "--plate-pressure", "1e6"}}) {
    const auto text = to_text(small_chute::paper_scene(words));
    EXPECT_EQ(to_text(scene_of(text, "run.chk")), text) << words.back();
  }
  for (const auto& words : {Words{"--geometry", "drum", "--lateral", "walls", "--drum-diameter",
                                  "40dS", "--fill", "0.024"},
                            Words{"--geometry", "shear", "--plate-pressure", "1e12"}})
    EXPECT_THROW(small_chute::paper_scene(words), SceneError) << words.back();
}

TEST(Restart, AnotherDimensionIsAnotherBed)
{
  Checkpoint<2> checkpoint;
  checkpoint.scene = to_text(scene());
  try {
    with_words(checkpoint, {"--dimension", "3"});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()).find("dimension differs from the checkpoint's"), 0U);
  }
}

TEST(Restart, ATextOfTheSceneGivesTheSameSceneForAnyRatio)
{
  for (int k = 0; k < 200; ++k) {
    const auto chute = scene({"--size-ratio", std::to_string(1.1 + 0.0137 * k), "--length", "1m"});
    Checkpoint<2> checkpoint;
    checkpoint.scene = to_text(chute);
    const auto again = scene_of(checkpoint.scene, "run.chk");
    EXPECT_EQ(again.large_diameter, chute.large_diameter);
    EXPECT_EQ(to_text(again), checkpoint.scene);
  }
}

}  // namespace
}  // namespace grseg
