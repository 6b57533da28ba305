// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/judge.hpp"

#include "formats/core/errors.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

using lammps_text::mentions;

/// Context of spheres of two sizes under gravity (0, -10, 0), with masses from --density.
CheckContext context_of(bool has_force = true)
{
  CheckContext context;
  context.has_force = has_force;
  context.gravity = {0, -10, 0};
  context.axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  context.step = 0.01;
  context.masses_are_given = true;
  context.tolerance = 0.05;
  context.size_ratio = 2;
  context.species = {{"small", "1", 0.01, 0.01, 0.009, 0.011},
                     {"large", "2", 0.02, 0.02, 0.02, 0.02}};
  return context;
}

/// A frame from which gravity follows with a standard error.
CheckNumbers frame_with(const Vec3& gravity, double error)
{
  CheckNumbers frame;
  frame.medians = 1;
  frame.acceleration = 100;
  frame.balance_grains = 100;
  frame.all = frame.smaller = frame.larger = {100, gravity, error};
  return frame;
}

Finding gravity_of(const Vec3& found, double error, CheckContext context = context_of())
{
  return judge_gravity({frame_with(found, error)}, context);
}

TEST(JudgeGravity, ThreeDegreesAreSeenWhereTheErrorIsSmall)
{
  const double three = 3 * lammps_text::pi / 180;
  EXPECT_EQ(gravity_of({0, -10, 0}, 0.01).verdict, Verdict::passed);
  const auto half_a_degree = gravity_of({0.1, -10, 0}, 0.01);
  EXPECT_EQ(half_a_degree.verdict, Verdict::passed);
  EXPECT_TRUE(mentions(half_a_degree.sentence, "; as given it is 10 along (0, -1, 0)"));
  EXPECT_FALSE(mentions(gravity_of({0, -10, 0}, 0.01).sentence, "as given"));
  const auto off = gravity_of({10 * std::sin(three), -10 * std::cos(three), 0}, 0.01);
  EXPECT_EQ(off.verdict, Verdict::failed);
  EXPECT_NEAR(off.measure, 2 * std::sin(three / 2), 1e-12);
  EXPECT_TRUE(mentions(off.sentence, "slope 3.0 degrees"));
  EXPECT_TRUE(mentions(off.sentence, "--gravity 0.5234,-9.986,0"));
  EXPECT_EQ(gravity_of({0, -10, 0}, 0.2).verdict, Verdict::undecided)
      << "three degrees are 0.52: 0.2 is too blunt";
  EXPECT_EQ(gravity_of({0.5, -10, 0}, 0.2).verdict, Verdict::undecided);
}

// Contacts of a grain at rest carry its weight, 10 m/s^2 times its mass, or more. Here they carry a
// thousandth of it, or a hundred million times it; 0.2 is too blunt for another verdict.
TEST(JudgeGravity, ThatContactsCannotCarryIsRefusedAlsoFromOneFrame)
{
  const auto carrying = [](double acceleration, bool has_estimate) {
    auto frame = frame_with({0, -10, 0}, 0.2);
    if (!has_estimate) frame.all = {};
    frame.acceleration = acceleration;
    return judge_gravity({frame}, context_of());
  };
  for (const bool has_estimate : {true, false}) {
    EXPECT_EQ(carrying(100, has_estimate).verdict, Verdict::undecided);
    EXPECT_EQ(carrying(0, has_estimate).verdict, Verdict::undecided) << "no grain has contacts";
    const auto light = carrying(0.01, has_estimate);
    EXPECT_EQ(light.verdict, Verdict::failed);
    EXPECT_TRUE(mentions(light.sentence, "carry 0.001 times its weight"));
  }
  const auto heavy = carrying(1e9, false);
  EXPECT_EQ(heavy.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(heavy.sentence, "check --gravity, --units and --density"));
  EXPECT_EQ(carrying(1e9, true).verdict, Verdict::passed) << "pressed, as by a plate";
}

// Four frames, each with gravity accurate to 0.01; the slope in the last two is 20 degrees larger.
TEST(JudgeGravity, ThatTurnsWithinTheArchiveIsRefused)
{
  const double twenty = 20 * lammps_text::pi / 180;
  const Vec3 flat(0, -10, 0), steep(10 * std::sin(twenty), -10 * std::cos(twenty), 0);
  CheckSeries series;
  for (const auto& gravity : {flat, flat, steep, steep}) {
    series.push_back(frame_with(gravity, 0.01));
    series.back().time = static_cast<double>(series.size());
  }
  const auto finding = judge_gravity(series, context_of());
  EXPECT_EQ(finding.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(finding.sentence, "gravity changes within the archive"));
  EXPECT_TRUE(mentions(finding.sentence, "slope 20.0 degrees (t = 3 to 4)"));
  EXPECT_NEAR(finding.measure, 2 * std::sin(twenty / 2), 1e-9);
}

// Displacements are velocity times time in the first half, and twice that in the second half.
TEST(JudgeTime, ThatRunsTwiceAsFastInTheSecondHalfIsRefused)
{
  CheckSeries series(8);
  for (std::size_t k = 0; k < series.size(); ++k) {
    series[k].step = static_cast<std::int64_t>(k);
    const double slope = k < 4 ? 1 : 2;
    for (int g = 1; g <= 10; ++g) series[k].motion.add(Vec3(g, 0, 0), Vec3(slope * g, 0, 0));
  }
  const auto finding = judge_time(series, context_of());
  EXPECT_EQ(finding.verdict, Verdict::failed);
  EXPECT_TRUE(
      mentions(finding.sentence, "in the first half of the frames and 2 times in the second"));
}

TEST(JudgeMasses, AreOpenWhereTheySuggestOtherGrainsThanWereTold)
{
  auto context = context_of();
  context.masses_are_given = false;
  const CheckSeries series{frame_with({0, -10, 0}, 0.001)};
  const auto gravity = judge_gravity(series, context);
  EXPECT_EQ(judge_masses(series, context, gravity).verdict, Verdict::passed);
  context.doubt_of_masses = "their densities differ by a factor of 2, or they are spheres";
  EXPECT_EQ(judge_masses(series, context, gravity).verdict, Verdict::undecided);
  EXPECT_EQ(judge_masses(series, context, gravity).sentence, context.doubt_of_masses);
}

TEST(JudgeGravity, ThatAgreesButPointsAwayFromTheBaseMeansOtherAxes)
{
  auto upside_down = context_of();
  upside_down.gravity = {4, 9, 0};
  const auto finding = gravity_of({4, 9, 0}, 0.001, upside_down);
  EXPECT_EQ(finding.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(finding.sentence, "points away from the base: name the axes"));
}

TEST(JudgeCompleteness, IsOpenWhereUnlistedPairsMayPart)
{
  auto frame = frame_with({0, -10, 0}, 0.01);
  const auto verdict = [&] { return judge({frame}, context_of())[1].verdict; };
  EXPECT_EQ(verdict(), Verdict::passed);
  frame.unlisted = 0.02;
  frame.unlisted_pairs = 1;
  EXPECT_EQ(verdict(), Verdict::failed);
  frame.unlisted_may_part = 1;
  EXPECT_EQ(verdict(), Verdict::undecided);
  frame.rigid = 0.5;
  EXPECT_EQ(verdict(), Verdict::failed);
}

// A bed at rest without the contacts with its walls: inner grains are in balance, grains at the sides
// are not.
TEST(JudgeBalance, IsUndecidedWhereMostGrainsBalanceButNotAll)
{
  auto frame = frame_with({0, -10, 0}, 0.01);
  const auto verdict_with = [&](double median, double worst) {
    frame.balance = median;
    frame.balance_worst = worst;
    return judge({frame}, context_of())[4];
  };
  EXPECT_EQ(verdict_with(1e-6, 1.5).verdict, Verdict::undecided);
  EXPECT_EQ(verdict_with(1e-6, 1.5).measure, 1.5);
  EXPECT_EQ(verdict_with(1e-6, 0.04).verdict, Verdict::passed);
  EXPECT_EQ(verdict_with(0.1, 1.5).verdict, Verdict::failed);
}

TEST(JudgeGravity, ThreeTimesUpwardAndNoneAreWrong)
{
  const auto three_times = gravity_of({0, -10.0 / 3, 0}, 0.01);
  EXPECT_EQ(three_times.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(three_times.sentence, "or masses are 0.333 times the masses by --density"));
  EXPECT_EQ(gravity_of({0, 10, 0}, 0.01).verdict, Verdict::failed);
  EXPECT_EQ(gravity_of({0, 0, 0}, 0.01).verdict, Verdict::failed);
  auto none = context_of();
  none.gravity = Vec3::Zero();
  EXPECT_EQ(gravity_of({0, -10, 0}, 0.01, none).verdict, Verdict::failed);
  EXPECT_EQ(gravity_of({0, 1e-6, 0}, 1e-7, none).verdict, Verdict::passed)
      << "contacts accelerate grains by 100";
}

TEST(JudgeGravity, IsSaidInTheUnitsAndAxesOfTheArchive)
{
  auto context = context_of();
  context.axes = {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
  context.units = {.length = 0.01, .time = 1, .mass = 0.001};
  const auto finding = gravity_of({0, -5, 0}, 0.01, context);
  EXPECT_TRUE(mentions(finding.sentence, "suggests gravity 500 along (0, 0, -1), slope 0.0"));
  EXPECT_TRUE(mentions(finding.sentence, "--gravity 0,0,-500"));
}

// Sums over all grains that alternate between -9 and -11: the mean is -10, and neighbours differ.
TEST(JudgeGravity, FromSumsNeedsEightPairsOfFrames)
{
  CheckSeries series;
  for (int k = 0; k <= 8; ++k) {
    auto frame = frame_with({0, k % 2 == 0 ? -9.9 : -10.1, 0}, 0);
    frame.medians = 0;
    frame.time = k;
    EXPECT_TRUE(k < 8 || judge_gravity(series, context_of(false)).verdict == Verdict::undecided);
    series.push_back(frame);
  }
  EXPECT_EQ(judge_gravity(series, context_of(false)).verdict, Verdict::passed);
  auto upward = context_of(false);
  upward.gravity = {0, 10, 0};
  EXPECT_EQ(judge_gravity(series, upward).verdict, Verdict::failed);
  EXPECT_TRUE(mentions(judge_gravity(series, upward).sentence, "or contacts with the base"));
}

// If masses scale as r^3 instead of r^2, the ratio of weight to mass of small grains is twice that of
// large ones.
TEST(JudgeMasses, SpheresForDiscsShowInTheWeightOfSmallAndLargeGrains)
{
  auto frame = frame_with({0, -10, 0}, 0.01);
  frame.smaller.gravity = {0, -12, 0};
  frame.larger.gravity = {0, -6, 0};
  const Finding gravity{"gravity", Verdict::passed, "", 0};
  const auto wrong = judge_masses({frame}, context_of(), gravity);
  EXPECT_EQ(wrong.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(wrong.sentence, "is 2 times that of larger ones"));
  EXPECT_TRUE(mentions(wrong.sentence, "--grains-are"));
  frame.smaller.error = frame.larger.error = 3;
  EXPECT_EQ(judge_masses({frame}, context_of(), gravity).verdict, Verdict::undecided);
  EXPECT_EQ(judge_masses({frame_with({0, -10, 0}, 0.01)}, context_of(), gravity).verdict,
            Verdict::passed);
}

TEST(JudgeMasses, WithoutForcesOnlyTheWeightIsKnown)
{
  const Finding gravity{"gravity", Verdict::passed, "", 0};
  const CheckSeries series{frame_with({0, -10, 0}, 0.01)};
  auto context = context_of(false);
  const auto finding = judge_masses(series, context, gravity);
  EXPECT_EQ(finding.verdict, Verdict::undecided);
  EXPECT_TRUE(mentions(finding.sentence, "the archive shows only the weight, mass times gravity"));
  context.masses_are_given = false;
  EXPECT_EQ(judge_masses(series, context, gravity).verdict, Verdict::passed);
}

/// Sums for grains that move with y = k x, for several x.
SlopeSums line(double k, double noise = 0)
{
  SlopeSums sums;
  for (int g = 1; g <= 20; ++g)
    sums.add(Vec3(g, 0.5 * g, 0),
             k * Vec3(g, 0.5 * g, 0) + Vec3(g % 2 == 0 ? noise : -noise, 0, 0));
  return sums;
}

TEST(JudgeMasses, ForceOverAccelerationIsTheMass)
{
  const Finding gravity{"gravity", Verdict::passed, "", 0};
  auto frame = frame_with({0, -10, 0}, 0.01);
  frame.force = line(2);
  const auto finding = judge_masses({frame}, context_of(), gravity);
  EXPECT_EQ(finding.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(finding.sentence,
                       "either masses are 2 times the masses by --density, or "
                       "the time step is 0.5 times as long"));
}

Finding time_of(const SlopeSums& motion)
{
  CheckNumbers frame;
  frame.motion = motion;
  return judge_time({CheckNumbers(), frame}, context_of());
}

TEST(JudgeTime, AStepTenTimesTooLongIsRefusedWithTheStepThatFits)
{
  EXPECT_EQ(time_of(line(1)).verdict, Verdict::passed);
  const auto finding = time_of(line(0.1));
  EXPECT_EQ(finding.verdict, Verdict::failed);
  EXPECT_TRUE(mentions(finding.sentence, "suggests a step of 0.001 (--step); as given it is 0.01"));
  EXPECT_EQ(time_of(line(10)).verdict, Verdict::failed);
  EXPECT_EQ(time_of(line(0.5, 0.5)).verdict, Verdict::failed);
}

TEST(JudgeTime, TheLimitStandsBesideTheMeasure)
{
  for (const auto& motion : {line(1), line(0.1), line(1.15, 0.3)})
    EXPECT_TRUE(
        mentions(time_of(motion).sentence, "velocity times time (limits: 0.9 and 1.1), with"));
  EXPECT_TRUE(mentions(why_undecided({.value = 1, .error = 0.1}),
                       "a verdict needs an uncertainty of at most 0.4"));
  EXPECT_TRUE(mentions(why_undecided({.value = 1.15, .error = 0.02}),
                       "beyond a limit by less than its uncertainty"));
}

TEST(JudgeTime, APackingAtRestProvesNothing)
{
  EXPECT_EQ(time_of({}).verdict, Verdict::undecided);
  EXPECT_EQ(time_of(line(0.1, 3)).verdict, Verdict::undecided) << "noise";
  EXPECT_EQ(judge_time({CheckNumbers()}, context_of()).verdict, Verdict::undecided);
}

TEST(JudgeSizes, SmallAndLargeExchangedAreRefusedWithTheExchange)
{
  auto context = context_of();
  EXPECT_EQ(judge_sizes(context).verdict, Verdict::passed);
  std::swap(context.species[0].mean, context.species[1].mean);
  std::swap(context.species[0].smallest, context.species[1].smallest);
  std::swap(context.species[0].largest, context.species[1].largest);
  std::swap(context.species[0].nominal, context.species[1].nominal);
  EXPECT_TRUE(mentions(judge_sizes(context).sentence, "exchange them, --small 2 --large 1"));
  context = context_of();
  context.species[0].nominal = 0.04;
  EXPECT_TRUE(mentions(judge_sizes(context).sentence, "is far from the diameters of its grains"));
}

TEST(Waivers, WaiveOneCheckEachUpToItsMeasure)
{
  const Waivers waivers({"0.1", "overlap=0.6"});
  const auto verdict = [&](const char* check, Verdict before, double measure) {
    return waivers.applied_to({check, before, "", measure}).verdict;
  };
  EXPECT_EQ(verdict("balance", Verdict::failed, 0.09), Verdict::waived);
  EXPECT_EQ(verdict("balance", Verdict::failed, 0.11), Verdict::failed);
  EXPECT_EQ(verdict("balance", Verdict::passed, 0.04), Verdict::passed);
  EXPECT_EQ(verdict("gravity", Verdict::failed, 0.09), Verdict::failed);
  EXPECT_EQ(verdict("overlap", Verdict::undecided, 0), Verdict::waived);
  EXPECT_EQ(Waivers({"balance=1e-9"}).applied_to({"balance", Verdict::passed, "", 0.04}).verdict,
            Verdict::failed)
      << "less than the program's own tolerance";
  for (const char* text : {"weight=1", "balance=", "balance=-1", "nan", "=1", "overlap"})
    EXPECT_THROW(Waivers({text}), UsageError) << text;
  EXPECT_THROW(Waivers({"0.1", "balance=0.2"}), UsageError);
}

}  // namespace
}  // namespace grseg
