// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/proposals.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

/// Three grains of mass 2 in one column along y. The lowest, of type 3, is held; the upper ones
/// rest, or fall, under the gravity (1, -4, 0).
ArchiveFrame column(const Vec3& acceleration)
{
  const Vec3 gravity(1, -4, 0);
  constexpr double mass = 2;
  ArchiveFrame frame;
  auto& grains = frame.grains;
  grains.id = {11, 12, 13};
  grains.type = {3, 1, 1};
  grains.radius = {0.5, 0.5, 0.5};
  grains.mass = {mass, mass, mass};
  grains.position = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  grains.velocity = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}};
  const Vec3 force = mass * acceleration, carried = force - mass * gravity;
  grains.force = {{7, 7, 7}, force, force};
  auto& contacts = frame.contacts;
  contacts.i = {12, 12};
  contacts.j = {11, 13};
  contacts.force = {2 * carried, -carried};
  return frame;
}

const std::vector<double> masses{2, 2, 2};

TEST(Proposals, GravityIsWhatContactsDoNotExplainOfTheForcesOnMovingGrains)
{
  for (const Vec3& acceleration : {Vec3(0, 0, 0), Vec3(0.3, 2, -1)}) {
    const auto frame = column(acceleration);
    const auto gravity = suggested_gravity(frame, masses, resting_grains(frame.grains, nullptr));
    ASSERT_TRUE(gravity);
    EXPECT_NEAR((*gravity - Vec3(1, -4, 0)).norm(), 0, 1e-14);
    EXPECT_EQ(gravity_option(*gravity), "1,-4,0");
  }
}

TEST(Proposals, GravityIsNotKnownWithoutForcesOnGrainsMassesOrTheMeaningOfColumns)
{
  auto frame = column({0, 0, 0});
  EXPECT_FALSE(suggested_gravity(frame, {}, {}));
  frame.grains.force.clear();
  EXPECT_FALSE(suggested_gravity(frame, masses, {}));
  frame = column({0, 0, 0});
  frame.contacts = {};
  frame.questions.push_back({"what the 5 columns mean", "--columns MAP", ""});
  EXPECT_FALSE(suggested_gravity(frame, masses, {}));
}

/// Discs of radius 0.5 at x = 0.25 and 3.75 in two rows: across the ends of a cell of `period` they
/// overlap by 3.5 - (period - 1).
ArchiveFrame across_the_ends(double shift)
{
  ArchiveFrame frame;
  frame.grains.id = {1, 2, 3, 4};
  frame.grains.radius = {0.5, 0.5, 0.5, 0.5};
  frame.grains.position = {
      {0.25 + shift, 0, 0}, {3.75 + shift, 0, 0}, {0.26 + shift, 2, 0}, {3.75 + shift, 2, 0}};
  frame.contacts.i = {1, 4};
  frame.contacts.j = {2, 3};
  frame.contacts.force = {{1, 0, 0}, {1, 0, 0}};
  return frame;
}

// Branches of 1 across the ends: the periods would be 4.5 and 4.49, of which overlaps make the least
// the likeliest.
TEST(Proposals, ACellIsPeriodicWhereContactsJoinItsEnds)
{
  const auto period = suggested_period(across_the_ends(0), 0);
  ASSERT_TRUE(period);
  EXPECT_EQ(period->contacts, 2u);
  EXPECT_EQ(period->low, 0);
  EXPECT_NEAR(period->high, 4.5, 1e-12);
  EXPECT_NEAR(suggested_period(across_the_ends(-2), 0)->low, -1.75, 1e-12);
  EXPECT_FALSE(suggested_period(across_the_ends(0), 1));
  auto one = across_the_ends(0);
  one.contacts.i = {1}, one.contacts.j = {2}, one.contacts.force = {{1, 0, 0}};
  EXPECT_FALSE(suggested_period(one, 0)) << "one contact may be an error";
  auto open = across_the_ends(0);
  open.contacts.i = {1, 3}, open.contacts.j = {3, 1};
  EXPECT_FALSE(suggested_period(open, 0));
}

TEST(Proposals, ADecimalNumberHasTheDigitsWithWhichItIsWritten)
{
  EXPECT_EQ(digits_of({{0.123456, 0, -5}}), 6);
  EXPECT_EQ(digits_of({{1e-7, 2.5e3, 0}}), 2);
  EXPECT_EQ(digits_of({{0.1 + 0.2, 0, 0}}), 17);
  EXPECT_EQ(digits_of({}), 0);
}

TEST(Proposals, TheBaseIsWhatNeverMovesWhileOtherGrainsDo)
{
  const auto first = column({0, 0, 0}).grains;
  auto question = question_of_base(first, resting_grains(first, nullptr));
  EXPECT_EQ(question.option, "--boundary 3");
  EXPECT_EQ(question.reason, "type 1: 2 grains, 1 wide; type 3: 1 grain, 1 wide, at rest");

  auto without_types = first;
  without_types.type.clear();
  question = question_of_base(without_types, resting_grains(without_types, nullptr));
  EXPECT_EQ(question.option, "--boundary-ids 11");

  auto later = first;
  later.position[0].x() = 0.1;  // at rest by chance
  question = question_of_base(first, resting_grains(first, &later));
  EXPECT_EQ(question.option, "--boundary none");
}

TEST(Proposals, ALidThatMovesAsOneBodyIsNotOfTheFlow)
{
  auto grains = column({0, 0, 0}).grains;
  for (int k = 0; k < 10; ++k) {
    grains.id.push_back(100 + k);
    grains.type.push_back(7);
    grains.radius.push_back(0.5);
    grains.position.emplace_back(k, 9, 0);
    grains.velocity.emplace_back(0.25, 0, 0);
  }
  const auto question = question_of_base(grains, resting_grains(grains, nullptr));
  EXPECT_EQ(question.option, "--boundary 3,7");
  EXPECT_NE(question.reason.find("type 7: 10 grains, 1 wide, with one velocity"),
            std::string::npos);
  grains.velocity.back().x() = 0.26;
  EXPECT_EQ(question_of_base(grains, resting_grains(grains, nullptr)).option, "--boundary 3");
}

TEST(Proposals, TheBaseIsNotKnownWhereNothingMoves)
{
  auto grains = column({0, 0, 0}).grains;
  for (auto& v : grains.velocity) v.setZero();
  EXPECT_EQ(question_of_base(grains, resting_grains(grains, nullptr)).option, "--boundary TYPES");
}

TEST(Proposals, TheNormalOfAFlowInSpaceIsTheAxisNearestToGravity)
{
  ArchiveFrame frame;
  auto& grains = frame.grains;
  grains.id = {1, 2, 3, 4};
  grains.radius = {0.5, 0.5, 0.5, 0.5};
  grains.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_FALSE(question_of_axes(frame, false, Vec3(3, -9, 0)));
  EXPECT_EQ(question_of_axes(frame, false, Vec3(3, 0, -9))->option, "--axes xz");
  EXPECT_EQ(question_of_axes(frame, false, Vec3(-9, 3, 0))->option, "--axes yx");
  EXPECT_FALSE(question_of_axes(frame, false, std::nullopt));
  frame.periodic = {true, true, false};
  EXPECT_EQ(question_of_axes(frame, false, std::nullopt)->option, "--axes xz");
}

TEST(Proposals, TheAxesOfAPlaneFlowAreThoseOfItsPlane)
{
  ArchiveFrame frame;
  auto& grains = frame.grains;
  grains.id = {1, 2, 3};
  grains.radius = {0.5, 0.5, 0.5};
  grains.position = {{0, 3, 0}, {1, 3, 0}, {0, 3, 1}};
  EXPECT_EQ(question_of_axes(frame, false, std::nullopt)->option, "--axes xz");
  EXPECT_FALSE(question_of_axes(frame, true, std::nullopt));
  for (auto& x : grains.position) std::swap(x.y(), x.z());
  EXPECT_FALSE(question_of_axes(frame, false, std::nullopt));
}

}  // namespace
}  // namespace grseg
