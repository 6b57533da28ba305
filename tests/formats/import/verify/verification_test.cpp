// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/verification.hpp"

#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

using lammps_text::mentions;

/// A disc of mass 2 falls freely; a base disc holds one of mass 3 against gravity (0, -10).
struct Scene {
  Grains grains;
  Box box{10, 10, true};
  Vec3 gravity{0, -10, 0};
  Frame<3> frame;

  Scene()
  {
    grains.id = {1, 2, 3};
    grains.species = {Species::small, Species::large, Species::boundary};
    grains.radius = {0.5, 1, 1};
    grains.mass = {2, 3, 3};
    grains.fixed = {0, 0, 1};
    frame.position = {{5, 5, 0}, {1, 2, 0}, {1, 0, 0}};
    frame.velocity = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    frame.angular_velocity.assign(3, Vec3::Zero());
    frame.force = {{0, -20, 0}, {0, 0, 0}, {0, 0, 0}};
    frame.contacts.i = {1};
    frame.contacts.j = {2};
    frame.contacts.force = {{0, 30, 0}};
    frame.contacts.branch = {{0, 2, 0}};
    frame.contacts.gap = {0};
  }
  Verification verification(double tolerance = 1e-10) const
  {
    return {grains, box, gravity, OutputAccuracy{tolerance, false, 1e-12, 0.5}};
  }
  std::string complaint(double tolerance = 1e-10) const
  {
    const auto found = verification(tolerance).check(frame);
    return found ? found->sentence : "no complaint";
  }
};

TEST(Verification, HasNoComplaintWhereForcesAddUp)
{
  const Scene scene;
  auto verification = scene.verification();
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_EQ(verification.residual()->largest, 0);
}

TEST(Verification, ResidualIsTheMissingForceOverTheLargestForce)
{
  Scene scene;
  scene.frame.contacts.force[0] = {0, 32, 0};
  auto verification = scene.verification(0.1);
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_DOUBLE_EQ(verification.residual()->largest, 2.0 / 32);
  EXPECT_EQ(verification.residual()->grain, 1u);
  EXPECT_TRUE(mentions(scene.complaint(), "the forces on grain 2 do not add up: 0.0625"));
}

TEST(Verification, SaysWhichOtherReadingFits)
{
  Scene scene;
  scene.frame.contacts.force[0] = {0, 60, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "with half of every force"));
  scene.frame.contacts.force[0] = {7, 30, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "with only the normal part"));
  scene.frame.force[1] = {-7, 0, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "with the tangential part reversed"));
  scene.frame.force[1] = {0, 0, 0};
  scene.frame.contacts.force[0] = {0, -30, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "contacts pull: 100 %"));
  EXPECT_TRUE(mentions(scene.complaint(), "with the opposite sign"));
  scene.frame.contacts.force[0] = {0, 50, 0};
  EXPECT_FALSE(mentions(scene.complaint(), "with")) << "nothing fits";
}

TEST(Verification, ContactsJoinGrainsThatTouch)
{
  Scene scene;
  scene.frame.position[1] = {1, 3, 0};
  EXPECT_TRUE(
      mentions(scene.complaint(), "grains 2 and 3 are listed as touching, but their centres"));
  scene.frame.contacts.branch[0] = {0, 3, 0};
  scene.frame.contacts.gap[0] = 1;
  EXPECT_TRUE(mentions(scene.complaint(), "3 apart and the radii add up to 2: "));
  scene.frame.contacts.force[0] = {0, 0, 0};
  EXPECT_FALSE(mentions(scene.complaint(), "listed as touching")) << "rows without force may";
}

TEST(Verification, OverlapOfSoftGrainsIsNoGapInTheGeometry)
{
  Scene scene;
  scene.frame.position[1] = {1, 1.9, 0};
  scene.frame.contacts.branch[0] = {0, 1.9, 0};
  scene.frame.contacts.gap[0] = -0.1;
  EXPECT_EQ(scene.complaint(), "no complaint");
  scene.frame.contacts.gap[0] = 0.02;
  EXPECT_TRUE(mentions(scene.complaint(), "while the archive states a distance of 2.02"));
}

/// A scene with discs 1 and 2, of radii 0.5 and 1, side by side with an overlap of 0.1.
Scene overlapping_discs()
{
  Scene scene;
  scene.frame.position[0] = {2.4, 2, 0};
  return scene;
}

TEST(Verification, APairThatOverlapsWithoutARowIsRefused)
{
  auto scene = overlapping_discs();
  EXPECT_TRUE(mentions(scene.complaint(),
                       "grains 1 and 2 overlap by 0.2 of the smaller radius and are "
                       "not in the list of contacts"));
  scene.frame.position[0].x() += scene.box.length_x;
  EXPECT_TRUE(mentions(scene.complaint(), "grains 1 and 2 overlap")) << "across the period, too";
  scene.frame.position[0] = {2.6, 2, 0};
  EXPECT_EQ(scene.complaint(), "no complaint") << "the two are apart";
}

TEST(Verification, APairThatOverlapsWithoutARowOfTheBaseNamesTheBase)
{
  Scene scene;
  scene.frame.position[0] = {2.4, 0, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "contacts with the base are missing"));
}

// Contact dynamics lists contacts with a force; a pair that parts may still overlap.
TEST(Verification, RigidGrainsThatBalanceMayOverlapWithoutARow)
{
  const auto scene = overlapping_discs();
  OutputAccuracy accuracy{1e-10, false, 0, 0.5};
  accuracy.lists_all = false;
  Verification verification(scene.grains, scene.box, scene.gravity, accuracy);
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_EQ(verification.numbers().unlisted, 0);
}

// Without forces on grains it is unknown whether the pair has a contact force.
TEST(Verification, OfRigidGrainsInASingleFrameCompletenessIsOpen)
{
  auto scene = overlapping_discs();
  scene.frame.force.clear();
  OutputAccuracy accuracy{1e-10, false, 0, 0.5};
  accuracy.lists_all = false;
  Verification verification(scene.grains, scene.box, scene.gravity, accuracy);
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_NEAR(verification.numbers().unlisted, 0.2, 1e-12);
  EXPECT_EQ(verification.numbers().unlisted_may_part, 1);
}

// Spins are 3, and velocities differ by 3 x (2.4 - 1, 0) = (0, 4.2).
TEST(Verification, NeighboursThatShareSpinAndMotionAreOneBody)
{
  auto scene = overlapping_discs();
  scene.frame.angular_velocity = {{0, 0, 3}, {0, 0, 3}, {0, 0, 0}};
  scene.frame.velocity[0] = {1, 4.2, 0};
  scene.frame.velocity[1] = {1, 0, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "rigid bodies of several grains are not supported"));
  scene.frame.position[0].x() += 0.1;
  scene.frame.velocity[0].y() += 0.3;
  EXPECT_TRUE(mentions(scene.complaint(), "rigid bodies")) << "also where they only touch";
  scene.frame.velocity[0].y() += 0.1;
  EXPECT_EQ(scene.complaint(), "no complaint") << "they pass each other";
}

/// Discs 1 and 2 as parts of a plug that turns at the rate w about (0, 2), as in a drum. Walls push them
/// on their way, without friction.
Scene plug(double w)
{
  auto scene = overlapping_discs();
  auto& frame = scene.frame;
  frame.angular_velocity = {{0, 0, w}, {0, 0, w}, {0, 0, w}};
  frame.contacts = {};
  for (const std::int32_t g : {0, 1}) {
    const auto k = static_cast<std::size_t>(g);
    const double distance = frame.position[k].x(), mass = scene.grains.mass[k];
    frame.velocity[k] = {0, w * distance, 0};
    frame.force[k] = {-mass * w * w * distance, 0, 0};
    frame.contacts.i.push_back(g);
    frame.contacts.j.push_back(-1 - g);
    frame.contacts.force.push_back(frame.force[k] - mass * scene.gravity);
    frame.contacts.branch.push_back(scene.grains.radius[k] *
                                    frame.contacts.force.back().normalized());
    frame.contacts.gap.push_back(0);
  }
  return scene;
}

std::optional<Complaint> complaint_about_rigid_grains(const Scene& scene)
{
  OutputAccuracy accuracy{1e-10, false, 0, 0.5};
  accuracy.lists_all = false;
  return Verification(scene.grains, scene.box, scene.gravity, accuracy).check(scene.frame);
}

TEST(Verification, APlugThatTurnsWithADrumIsNoRigidBodyWhereForcesTurnIt)
{
  auto scene = plug(3);
  EXPECT_FALSE(complaint_about_rigid_grains(scene));
  // A body of two discs carries the second disc by an inner force that the archive does not have.
  scene.frame.contacts.force[1] -= Vec3(0, 6, 0);
  scene.frame.force[1] -= Vec3(0, 6, 0);
  const auto complaint = complaint_about_rigid_grains(scene);
  ASSERT_TRUE(complaint);
  EXPECT_TRUE(mentions(complaint->sentence, "rigid bodies of several grains are not supported"));
  EXPECT_TRUE(mentions(complaint->sentence, "--accept-residual completeness=1 accepts it"));
}

TEST(Verification, APlugThatTurnsIsARigidBodyWhereATorqueTurnsOneOfItsGrainsOnly)
{
  auto scene = plug(3);
  auto& contacts = scene.frame.contacts;
  for (const int side : {1, -1}) {
    contacts.i.push_back(1);
    contacts.j.push_back(-4 - side);
    contacts.force.push_back(side * Vec3(4, 10, 0));
    contacts.branch.push_back(side * Vec3(0, scene.grains.radius[1], 0));
    contacts.gap.push_back(0);
  }
  EXPECT_TRUE(complaint_about_rigid_grains(scene));
}

TEST(Verification, DampingMayPullALittle)
{
  Scene scene;
  scene.frame.contacts.i.push_back(0);
  scene.frame.contacts.j.push_back(-1);
  scene.frame.contacts.branch.emplace_back(0, 0.5, 0);
  scene.frame.contacts.gap.push_back(0);
  scene.frame.contacts.force.emplace_back(0, -3, 0);
  scene.frame.force[0] = {0, -23, 0};
  EXPECT_EQ(scene.complaint(), "no complaint");
  scene.frame.contacts.force[1] = {0, -13, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "contacts pull: 30 %"));
}

// A disc of mass 3 is accelerated upward by 2: half a step of 0.1 later the damping 7 m v is
// smaller by 7 * 3 * 2 * 0.05.
TEST(Verification, DampingEvaluatedHalfAStepLateIsFoundAndExplainsTheMissingForce)
{
  Scene scene;
  scene.frame.force[1] = {0, 6, 0};
  scene.frame.contacts.force[0] = {0, 36 - 7 * 3 * 2 * 0.05, 0};
  Verification verification(scene.grains, scene.box, scene.gravity,
                            OutputAccuracy{1e-10, true, 0.1, 0.5});
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_NEAR(verification.residual()->late->normal, 7, 1e-12);
  EXPECT_EQ(verification.residual()->late->tangential, 0);
  EXPECT_NEAR(verification.residual()->largest, 2.1 / 33.9, 1e-12);
  EXPECT_LT(verification.residual()->unexplained, 1e-14);

  scene.frame.contacts.force[0] = {0, 36 + 7 * 3 * 2 * 0.05, 0};
  EXPECT_TRUE(verification.check(scene.frame)) << "damping does not drive";
}

// Twelve discs on base discs, accelerated by 1 to 12. Forces that are damped half a step late are told
// as such, though forces between the discs and their neighbours would balance them, too.
TEST(Verification, DampingOfAProgramThatIsNotKnownForItIsNamedBeforeOtherForces)
{
  Scene scene;
  scene.grains = {};
  scene.frame = {};
  scene.box.length_x = 100;
  auto& [grains, box, gravity, frame] = scene;
  for (int k = 1; k <= 12; ++k) {
    const double x = 2.01 * k, m = 3;
    grains.id.insert(grains.id.end(), {2 * k, 2 * k + 1});
    grains.species.insert(grains.species.end(), {Species::large, Species::boundary});
    grains.radius.insert(grains.radius.end(), {1, 1});
    grains.mass.insert(grains.mass.end(), {m, m});
    grains.fixed.insert(grains.fixed.end(), {0, 1});
    frame.position.insert(frame.position.end(), {{x, 2, 0}, {x, 0, 0}});
    frame.force.insert(frame.force.end(), {{0, m * k, 0}, {0, 0, 0}});
    frame.contacts.i.push_back(2 * k - 2);
    frame.contacts.j.push_back(2 * k - 1);
    frame.contacts.force.emplace_back(0, m * (10 + k) - 7 * m * k * 0.05, 0);
    frame.contacts.branch.emplace_back(0, 2, 0);
    frame.contacts.gap.push_back(0);
  }
  frame.velocity.assign(24, Vec3::Zero());
  frame.angular_velocity.assign(24, Vec3::Zero());
  Verification verification(grains, box, gravity, OutputAccuracy{1e-4, false, 0.1, 0.5});
  const auto complaint = verification.check(frame);
  ASSERT_TRUE(complaint);
  EXPECT_TRUE(mentions(complaint->sentence, "damping is evaluated half a step late"));
}

TEST(Verification, ForcesThatAllPullAreTakenForTheOnesOnTheOtherGrain)
{
  Scene scene;
  scene.frame.force.clear();
  scene.frame.contacts.force[0] *= -1;
  EXPECT_TRUE(mentions(scene.complaint(), "exchange i and j"));
}

// Without forces on grains: a fall from rest has v = g t, and the held grain stays at rest.
TEST(Verification, WithoutForcesVelocitiesOfTwoStepsAreUsed)
{
  Scene scene;
  scene.frame.force.clear();
  auto verification = scene.verification();
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_FALSE(verification.residual()) << "nothing to compare with yet";
  scene.frame.step = 1;
  scene.frame.time = 0.5;
  scene.frame.velocity[0] = {0, -5, 0};
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_LT(verification.residual()->largest, 1e-15);
  scene.frame.step = 2;
  scene.frame.time = 1;
  const auto complaint = verification.check(scene.frame);
  ASSERT_TRUE(complaint);
  EXPECT_EQ(complaint->check, "balance");
  EXPECT_TRUE(mentions(complaint->sentence, "difference of velocities between two frames"));
}

// The force on the held grain changes from 30 to 60 over a step; its mean may be any value between.
TEST(Verification, AForceThatChangesOverAStepIsKnownToHalfOfTheChange)
{
  Scene scene;
  scene.frame.force.clear();
  for (const double velocity : {0.0, -0.5, 9.5, 10.5}) {
    auto verification = scene.verification();
    scene.frame.step = 0;
    scene.frame.time = 0;
    scene.frame.velocity = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    scene.frame.contacts.force[0] = {0, 30, 0};
    EXPECT_FALSE(verification.check(scene.frame));
    scene.frame.step = 1;
    scene.frame.time = 1;
    scene.frame.velocity = {{0, -10, 0}, {0, velocity, 0}, {0, 0, 0}};
    scene.frame.contacts.force[0] = {0, 60, 0};
    // accepted impulses m v: 0 to 30
    EXPECT_EQ(verification.check(scene.frame).has_value(), velocity < 0 || velocity > 10)
        << velocity;
  }
}

TEST(Verification, FramesFarApartBalanceNeitherWellNorBadly)
{
  Scene scene;
  scene.frame.force.clear();
  auto verification = scene.verification();
  EXPECT_FALSE(verification.check(scene.frame));
  scene.frame.step = 1000;
  scene.frame.time = 1000;
  scene.frame.contacts.force[0] = {0, 40, 0};
  EXPECT_FALSE(verification.check(scene.frame));
  EXPECT_FALSE(verification.residual());
  EXPECT_EQ(verification.numbers().balance_grains, 0);
  EXPECT_DOUBLE_EQ(verification.numbers().change, 10.0 / 40);
  // If forces do not change, as in a packing at rest, the median grain in contact is judged.
  scene.frame.step = 2000;
  scene.frame.time = 2000;
  const auto complaint = verification.check(scene.frame);
  ASSERT_TRUE(complaint) << "40 does not balance 30";
  EXPECT_EQ(complaint->check, "balance");
}

// The disc falls for 0.4 s, hits a floor that is not in the archive, and is at rest again, while the
// contacts of the other disc have not changed: nothing is wrong, and nothing can be judged.
TEST(Verification, FramesAreFarApartWhereAGrainMayHaveMetAnotherInBetween)
{
  for (const double speed : {0.0, 0.04}) {
    Scene scene;
    scene.frame.force.clear();
    scene.frame.velocity[0] = {0, -1, 0};
    auto verification = scene.verification(1e-3);
    ASSERT_FALSE(verification.check(scene.frame));
    scene.frame.step = 1000;
    scene.frame.time = 0.4;
    scene.frame.velocity[0] = {0, -speed, 0};
    EXPECT_FALSE(verification.check(scene.frame));
    EXPECT_FALSE(verification.residual());
  }
}

TEST(Verification, ADeepOverlapHasItsOwnNameAndCanBeWaived)
{
  Scene scene;
  scene.frame.position[1] = {1, 1.5, 0};
  scene.frame.contacts.branch[0] = {0, 1.5, 0};
  scene.frame.contacts.gap[0] = -0.5;
  const auto complaint = scene.verification().check(scene.frame);
  ASSERT_TRUE(complaint);
  EXPECT_EQ(complaint->check, "overlap");
  EXPECT_TRUE(mentions(complaint->sentence, "grains 2 and 3 overlap by 0.5 of the smaller radius"));
  EXPECT_TRUE(mentions(complaint->sentence, "--accept-residual overlap=0.5"));
  Verification waived(scene.grains, scene.box, scene.gravity, {1e-10, false, 0, 0.5},
                      Waivers({"overlap=0.6"}));
  EXPECT_FALSE(waived.check(scene.frame));
  EXPECT_DOUBLE_EQ(waived.numbers().overlap, 0.5);
}

// A wall below, which the archive does not mention, holds the disc on the base disc.
TEST(Verification, AMissingWallIsNamedWhereGrainsLackItsPush)
{
  Scene scene;
  scene.frame.contacts.clear();
  scene.frame.position[2] = {5, -3, 0};
  Verification verification(scene.grains, scene.box, scene.gravity, {1e-10, false, 0, 0.5}, {},
                            {AxisInArchive{'x', true, 0}, {'z', true, 0.5}});
  const auto complaint = verification.check(scene.frame);
  ASSERT_TRUE(complaint);
  EXPECT_TRUE(mentions(complaint->sentence,
                       "the only grain that does not balance is at a side of the bed and lacks a "
                       "force that pushes away from it (1 at the lowest z, at about z = 0.5)"));
  EXPECT_TRUE(mentions(complaint->sentence, "name the wall, as in --wall floor=z:0"));
}

TEST(Verification, AMissingContactIsNamedByItsGrains)
{
  Scene scene;
  scene.frame.contacts.clear();
  EXPECT_TRUE(mentions(scene.complaint(),
                       "acts between grains 2 and 3, which touch: their contact is missing"));
}

// Discs 1 and 2, a tenth of the smaller radius apart, attract each other with the force 6.
TEST(Verification, OppositeForcesOnNeighboursWithoutARowAreContactsThatPull)
{
  Scene scene;
  scene.frame.position[0] = {2.55, 2, 0};
  scene.frame.force[0] = {-6, -20, 0};
  scene.frame.force[1] = {6, 0, 0};
  EXPECT_TRUE(
      mentions(scene.complaint(), "the missing forces act between 1 pairs without a listed force"));
  EXPECT_TRUE(mentions(scene.complaint(), "(the largest: grains 1 and 2): attractive contacts"));
}

// The disc moves away from the base by 1 in a step of 0.1; its contact had a force while they touched.
TEST(Verification, GrainsThatPartWithinAStepHaveTouchedWhereItBegan)
{
  Scene scene;
  scene.frame.velocity[1] = {0, 10, 0};
  scene.frame.position[1].y() = 3;
  scene.frame.contacts.branch = {{0, 3, 0}};
  scene.frame.contacts.gap = {1};
  EXPECT_TRUE(mentions(scene.complaint(), "are listed as touching, but their centres are 3 apart"));
  const auto with_step = [&](double step) {
    return Verification(scene.grains, scene.box, scene.gravity, {1e-10, false, step, 0.5})
        .check(scene.frame);
  };
  EXPECT_FALSE(with_step(0.1));
  EXPECT_TRUE(with_step(0.09));
}

/// A scene with three discs in flight, each slowed down by a force of twice its momentum.
Scene flight(const std::vector<Vec3>& velocity)
{
  Scene scene;
  scene.frame.contacts.clear();
  scene.grains.fixed[2] = 0;
  scene.grains.species[2] = Species::large;
  scene.frame.position = {{5, 5, 0}, {1, 2, 0}, {8, 8, 0}};
  scene.frame.velocity = velocity;
  for (std::size_t g = 0; g < 3; ++g)
    scene.frame.force[g] = scene.grains.mass[g] * (scene.gravity - 2 * velocity[g]);
  return scene;
}

TEST(Verification, ADragIsNotToldFromAnotherGravityWhereGrainsMoveAlike)
{
  const auto scene = flight({{1, 2, 0}, {1, 2, 0}, {1, 2, 0}});
  const auto complaint = scene.verification().check(scene.frame);
  ASSERT_TRUE(complaint);
  EXPECT_TRUE(mentions(complaint->sentence, "a drag on all grains, or another gravity"));
  EXPECT_FALSE(complaint->spoils_gravity);
}

TEST(Verification, ADragOnAllGrainsIsNamedAndIsNoOtherGravity)
{
  const auto scene = flight({{1, 2, 0}, {-3, 1, 0}, {0.5, -4, 0}});
  const auto complaint = scene.verification().check(scene.frame);
  ASSERT_TRUE(complaint);
  EXPECT_TRUE(
      mentions(complaint->sentence, "the missing force is 2 times the momentum of each grain"));
  EXPECT_TRUE(complaint->spoils_gravity);
}

// Velocities of 1 for a time of 0.1, but displacements of 0.5, five times as far.
TEST(Verification, FramesWhoseGrainsMovedTooFarAreNotOneStepApart)
{
  Scene scene;
  scene.frame.contacts.clear();
  scene.frame.position = {{5, 5, 0}, {1, 7, 0}, {5, -3, 0}};
  scene.frame.velocity = {{1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  scene.frame.force.clear();
  scene.frame.step = 1;
  scene.frame.time = 0.1;
  auto verification = scene.verification();
  verification.check(scene.frame);
  scene.frame.step = 2;
  scene.frame.time = 0.2;
  for (const std::size_t g : {0, 1}) scene.frame.position[g].x() += 0.5;
  const auto complaint = verification.check(scene.frame);
  ASSERT_TRUE(complaint);
  EXPECT_TRUE(mentions(complaint->sentence, "5 times as far as their velocities allow"));
  EXPECT_TRUE(mentions(complaint->sentence, "are 1 and 2 numbers of frames instead of steps?"));
}

TEST(Verification, AMissingTangentialPartIsNamed)
{
  Scene scene;
  scene.gravity = {4, -10, 0};
  scene.frame.force[0] = {8, -20, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "is the tangential part missing?"));
}

TEST(Verification, ABedThatIsStillFillingIsNamed)
{
  Scene scene;
  scene.frame.position[1] = {1, 1.8, 0};
  auto& contacts = scene.frame.contacts;
  contacts.branch[0] = {0, 1.8, 0};
  contacts.gap[0] = -0.2;
  contacts.force[0] = {9, 80, 0};
  EXPECT_TRUE(mentions(scene.complaint(), "the bed may still be filling"));
}

/// The same with spheres: one falls, and one is on a base sphere in an oblique direction, across
/// both periods.
struct SceneInSpace {
  Grains grains = Scene().grains;
  Box box{10, 10, true, 3, 8, true};
  Vec3 gravity{3, -10, 1};
  Vec3 n{0.48, 0.6, 0.64};
  Frame<3> frame;

  SceneInSpace()
  {
    frame.position = {{5, 5, 4}, {0.46, 1.2, 0.28}, {9.5, 0, 7}};
    frame.velocity.assign(3, Vec3::Zero());
    frame.force = {2 * gravity, {0, 0, 0}, {0, 0, 0}};
    frame.contacts.i = {1};
    frame.contacts.j = {2};
    frame.contacts.force = {-3 * gravity};
    frame.contacts.branch = {2 * n};
    frame.contacts.gap = {0};
  }
  std::string complaint(double tolerance = 1e-10) const
  {
    const auto found =
        Verification(grains, box, gravity, OutputAccuracy{tolerance, false, 0, 0.4}).check(frame);
    return found ? found->sentence : "no complaint";
  }
};

TEST(VerificationInSpace, FindsWhatIsWrongInEachComponent)
{
  EXPECT_EQ(SceneInSpace().complaint(), "no complaint");
  for (int k = 0; k < 3; ++k) {
    SceneInSpace scene;
    scene.frame.contacts.force[0][k] += 0.01;
    EXPECT_TRUE(mentions(scene.complaint(), "the forces on grain 2 do not add up")) << k;
    scene = {};
    scene.frame.contacts.branch[0][k] += 0.05;
    EXPECT_TRUE(mentions(scene.complaint(), "grains 2 and 3 are listed as touching")) << k;
    scene = {};
    scene.frame.position[1][k] += 0.05;
    EXPECT_TRUE(mentions(scene.complaint(), "grains 2 and 3 are listed as touching")) << k;
  }
  SceneInSpace scene;
  scene.box.periodic_z = false;
  EXPECT_TRUE(mentions(scene.complaint(), "is the cell periodic as the archive states?"));
}

TEST(VerificationInSpace, SaysWhichOtherReadingFits)
{
  SceneInSpace scene;
  const Vec3 right = scene.frame.contacts.force[0], n = scene.n;
  scene.frame.contacts.force[0] = 2 * right.dot(n) * n - right;
  EXPECT_TRUE(mentions(scene.complaint(), "with the tangential part reversed"));
  scene.frame.contacts.force[0] = 2 * right;
  EXPECT_TRUE(mentions(scene.complaint(), "with half of every force"));
}

// A contact force f at mid-step is F - c_n m a_n h/2 along n. Along the tangents the same is true
// with the rim's acceleration a_t - r alpha x n = a_t + F_t/(0.4 m). Then m a = F at mid-step + m g.
TEST(VerificationInSpace, LateDampingOfARollingSphereIsFoundInEveryDirection)
{
  SceneInSpace scene;
  const double m = 3, half_step = 0.05, c_n = 3, c_t = 2;
  const Vec3 n = scene.n, weight = m * scene.gravity, force(9, 30, -4);
  const auto normal = [&](const Vec3& v) { return Vec3(v.dot(n) * n); };
  const Vec3 along_n = normal(force + weight), friction = force - normal(force);
  const Vec3 along_t = force + weight - along_n;
  scene.frame.contacts.force[0] = force;
  scene.frame.force[1] = along_n / (1 - c_n * half_step) +
                         (along_t + c_t * half_step * friction / 0.4) / (1 - c_t * half_step);
  // The falling sphere slides along a wall without acceleration away from it.
  auto& contacts = scene.frame.contacts;
  contacts.i.push_back(0);
  contacts.j.push_back(-1);
  contacts.branch.emplace_back(0, 0.5, 0);
  contacts.gap.push_back(0);
  contacts.force.emplace_back(40, 20, -30);
  scene.frame.force[0] = 2 * scene.gravity + contacts.force[1];
  Verification verification(scene.grains, scene.box, scene.gravity,
                            OutputAccuracy{1e-10, true, 2 * half_step, 0.4});
  const auto complaint = verification.check(scene.frame);
  EXPECT_FALSE(complaint) << complaint->sentence;
  EXPECT_NEAR(verification.residual()->late->normal, c_n, 1e-12);
  EXPECT_NEAR(verification.residual()->late->tangential, c_t, 1e-12);
  EXPECT_GT(verification.residual()->largest, 0.05);
  EXPECT_LT(verification.residual()->unexplained, 1e-14);
}

}  // namespace
}  // namespace grseg
