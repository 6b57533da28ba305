// SPDX-License-Identifier: GPL-3.0-or-later
// Measurements of grseg-check on a column of discs at rest, which are known; then one property at a
// time is damaged.
#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "tests/analysis/check/checked_column.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

TEST_F(CheckedColumn, AtRestPassesEveryCheckThatItsFileAllows)
{
  const auto lines = lines_of(Column());
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  EXPECT_EQ(with(Verdict::skipped, lines), Names{"torque_balance"});
  for (const auto& line : lines) {
    if (line.verdict == Verdict::skipped) continue;
    EXPECT_LE(line.measured, 1e-12) << line.quantity;
  }
}

// After the checks of the file's content, the lines follow the order of the table of checks.
TEST_F(CheckedColumn, HasOneLinePerCheckInTheOrderOfTheTable)
{
  std::vector<std::string> names{"not_closed", "no_frames", "damaged_frames",
                                 "damaged_outside_frames"};
  auto of_spheres = names;
  for (const auto& check : checks::all) {
    of_spheres.emplace_back(check.name);
    if (!check.of_spheres_only) names.emplace_back(check.name);
  }
  const auto names_of = [](const std::vector<CheckLine>& lines) {
    std::vector<std::string> found;
    for (const auto& line : lines)
      if (found.empty() || found.back() != line.quantity) found.push_back(line.quantity);
    return found;
  };
  EXPECT_EQ(names_of(lines_of(Column())), names);
  EXPECT_EQ(names_of(lines_of(ColumnOf<3>())), of_spheres);
}

// Between the middles of discs n and n+1 the contact carries n_above discs, so a layer that spans a
// disc carries the discs above and half of its own.
TEST_F(CheckedColumn, CarriesInEachLayerTheDiscsAboveAndHalfOfItsOwn)
{
  const Column column({3, -weight});
  const Layers layers(2 * radius, length);
  WeightSums<2> sums(layers, {3, -weight}, small / 2);
  const auto& grains = column.description.grains;
  for (const auto& frame : column.frames) sums.add_to_mean(grains, frame);
  for (const auto& frame : column.frames) sums.add(grains, frame);
  const auto window = sums.window();
  ASSERT_EQ(window.stress.size(), discs);
  for (std::size_t n = 1; n < discs; ++n) {
    const double load = (static_cast<double>(discs - n) - 0.5) * grains.mass[1] / length;
    EXPECT_NEAR(window.stress[n].y(), load * weight, 1e-15);
    EXPECT_NEAR(window.stress[n].x(), -load * 3, 1e-15);
    EXPECT_NEAR(window.weight[n].y(), load * weight, 1e-15);
  }
}

TEST_F(CheckedColumn, ThatSlidesHasTheStressRatioOfTheSlopeLessItsAcceleration)
{
  const double g_x = 4, a = 1.5;
  const auto lines = lines_of(Column({g_x, -weight}, a));
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  int layers = 0;
  for (const auto& line : lines) {
    if (line.quantity != "slope") continue;
    ++layers;
    EXPECT_LE(line.measured, 1e-12);
    EXPECT_EQ(line.remark, fmt::format("stress ratio {0:.5f}, slope less acceleration {0:.5f}",
                                       (g_x - a) / weight));
  }
  EXPECT_EQ(layers, static_cast<int>(discs) - 1);
}

// One property is damaged at a time: its check fails, and no other.

TEST_F(CheckedColumn, FailsTheForceBalanceIfAForceIsChanged)
{
  Column column;
  column.frames[7].contacts.force[2] *= 1.01;
  EXPECT_EQ(failed(column), Names{"force_balance"});
}

// The force is off by 1 % of itself, and so by at most 1 % of the largest.
TEST_F(CheckedColumn, HoldsAnImportToTheBalanceThatItAccepted)
{
  Column column;
  column.frames[7].contacts.force[2] *= 1.01;
  column.description.parameters.numbers["import_tolerance"] = {0.02};
  EXPECT_EQ(failed(column), Names{});
  column.description.parameters.numbers["import_tolerance"] = {1e-4};
  EXPECT_EQ(failed(column), Names{"force_balance"});
}

TEST_F(CheckedColumn, FailsForceBalanceAndTensionIfAForceChangesSign)
{
  Column column;
  column.frames[7].contacts.force[2] *= -1;
  EXPECT_EQ(failed(column), (Names{"force_balance", "tension_largest", "tension_mean"}));
}

TEST_F(CheckedColumn, FailsTensionIfAContactPullsAlthoughForcesBalance)
{
  Column column;
  auto& frame = column.frames[7];
  Column::push(frame, 2, -2 * frame.contacts.force[2]);
  EXPECT_EQ(failed(column), (Names{"tension_largest", "tension_mean"}));
}

TEST_F(CheckedColumn, FailsCoulombsLawIfFrictionLeavesTheConeAlthoughForcesBalance)
{
  Column column;
  auto& frame = column.frames[7];
  const double normal = frame.contacts.force[2].y();
  Column::push(frame, 2, {0.49 * normal, 0});
  EXPECT_EQ(failed(column), Names{});
  Column::push(frame, 2, {0.02 * normal, 0});
  EXPECT_EQ(failed(column), (Names{"coulomb_largest", "coulomb_mean"}));
}

TEST_F(CheckedColumn, FailsTheSumOfPartialsIfABranchIsNotTheDistanceOfItsGrains)
{
  Column column;
  column.frames[7].contacts.branch[2] *= 1 + 1e-8;
  EXPECT_EQ(failed(column), Names{"sum_of_partials"});
}

TEST_F(CheckedColumn, FailsTotalMomentumIfTheBaseForceDoesNotChangeTheMomentum)
{
  Column column;
  column.observables[7][0] += 1e-6 * column.observables[7][1];
  EXPECT_EQ(failed(column), Names{"total_momentum"});
}

TEST_F(CheckedColumn, FailsTheOpenGapIfAForceActsWithoutTouch)
{
  Column column;
  Column::lift_top(column.frames[7], 1e-6 * small);
  EXPECT_EQ(failed(column), (Names{"open_gap_largest", "open_gap_mean"}));
}

// A gap of 30 micrometres. Gravity alone explains 0.75 h sqrt(g d_S) of it; the rest needs an
// approach speed of (gap - that)/(0.75 h) = 0.234 m/s before the step.
TEST_F(CheckedColumn, MayHaveAGapThatFreeFlightWouldCloseUnderTheSpeculativeLaw)
{
  const double gap = 30e-6, flight = 0.75 * h;
  const double excused = flight * std::sqrt(weight * small);
  const double approach = (gap - excused) / flight;
  for (const double faster : {-1e-3, 1e-3}) {
    Column column;
    column.description.parameters.texts["contact_law"] = "speculative";
    column.description.parameters.numbers["horizon"] = {0.75};
    auto& frame = column.frames[7];
    Column::lift_top(frame, gap);
    // The disc below does not change its velocity: its force balances that of the contact further down.
    for (std::size_t c = 0; c < discs; ++c)
      Column::push(frame, c, {0, column.description.grains.mass[1] * (approach + faster) / h});
    EXPECT_EQ(failed(column), faster > 0 ? Names{} : (Names{"open_gap_largest", "open_gap_mean"}));
  }
}

// A contact law that the program does not know is not checked as if it were another one.
TEST_F(CheckedColumn, OfAnUnknownContactLawIsRefused)
{
  Column column;
  column.description.parameters.texts["contact_law"] = "late";
  EXPECT_THROW(failed(column), FormatError);
}

// The plate of a shear cell is pushed back within the step; the file states the margin, because
// there is no gravity.
TEST_F(CheckedColumn, AllowsForABoundaryThatMovedBeforeTheStep)
{
  const double gap = 30e-6, flight = 0.75 * h;
  for (const double margin : {29e-6, 31e-6}) {
    Column column;
    column.description.parameters.texts["contact_law"] = "speculative";
    column.description.parameters.numbers["horizon"] = {0.75};
    column.description.parameters.numbers["contact_margin"] = {margin};
    Column::lift_top(column.frames[7], gap);
    EXPECT_EQ(failed(column),
              margin > gap ? Names{} : (Names{"open_gap_largest", "open_gap_mean"}));
  }
  ContactRules rules;
  rules.step = h;
  rules.look_ahead = rules.horizon = 0.75;
  Column column;
  auto& frame = column.frames[0];
  frame.contacts.gap[0] = gap;
  frame.contacts.branch[0].y() += gap;
  frame.velocity[0].y() = 0.1;
  frame.force[0].y() = column.description.grains.mass[0] * (0.1 - 1.01 * gap / flight) / h;
  ContactViolations violations(rules);
  violations.add(column.description.grains, frame);
  EXPECT_EQ(violations.open_gap.largest, 0);
}

TEST_F(CheckedColumn, FailsTheApproachIfDiscsKeepApproaching)
{
  Column column;
  for (auto& frame : column.frames) frame.velocity[discs] = {0, -4};
  EXPECT_EQ(failed(column), (Names{"approach_largest", "approach_mean"}));
}

// A disc that touches after an approach at 0.4 m/s must separate at 0.1 m/s if e = 1/4. A disc at a
// distance of 30 micrometres may close its gap within 0.75 steps, at 0.4 m/s.
TEST_F(CheckedColumn, HasASeparationVelocityByNewtonsLawOrByTheGap)
{
  ContactRules rules;
  rules.restitution = 0.25;
  rules.step = h;
  rules.horizon = rules.look_ahead = 0.75;
  const auto lacking = [&](double gap, double before, double after) {
    Column column;
    auto& frame = column.frames[0];
    Column::lift_top(frame, gap);
    frame.velocity[discs].y() = after;
    frame.force[discs].y() = column.description.grains.mass[discs] * (after - before) / h;
    ContactViolations violations(rules);
    violations.add(column.description.grains, frame);
    return violations.approach.largest / h;
  };
  EXPECT_NEAR(lacking(0, -0.4, 0.1), 0, 1e-12);
  EXPECT_NEAR(lacking(0, -0.4, 0.04), 0.06, 1e-12);
  EXPECT_NEAR(lacking(0, -0.4, -0.04), 0.14, 1e-12);
  EXPECT_NEAR(lacking(30e-6, -0.6, -0.4), 0, 1e-12);
  EXPECT_NEAR(lacking(30e-6, -0.6, -0.5), 0.1, 1e-12);
}

TEST_F(CheckedColumn, IsNotCheckedBeforeTheTilt)
{
  Column column;
  for (std::size_t k = 0; k < column.frames.size(); ++k) {
    auto& frame = column.frames[k];
    frame.step -= 1500;
    frame.time -= 1500 * h;
    if (k < 3)
      for (auto& force : frame.contacts.force) force *= 1.1;
  }
  EXPECT_EQ(failed(column), Names{});
}

TEST_F(CheckedColumn, FailsTheOverlapIfItIsDeep)
{
  Column column;
  for (auto& frame : column.frames) Column::lift_top(frame, -0.11 * small);
  EXPECT_EQ(failed(column), (Names{"overlap_largest", "overlap_mean"}));
}

TEST_F(CheckedColumn, FailsTheOverlapDriftIfASmallOverlapGrows)
{
  Column column;
  for (std::size_t k = 0; k < column.frames.size(); ++k)
    Column::lift_top(column.frames[k], -1e-4 * small * static_cast<double>(k));
  EXPECT_EQ(failed(column), Names{"overlap_drift"});
}

TEST_F(CheckedColumn, FailsTheWeightIfLayersCarryTooLittleAlthoughForcesBalance)
{
  Column column;
  for (auto& frame : column.frames)
    for (std::size_t c = 0; c < discs; ++c) Column::push(frame, c, -0.02 * frame.contacts.force[c]);
  EXPECT_EQ(failed(column), Names{"weight"});
}

TEST_F(CheckedColumn, FailsTheSlopeIfTheStressRatioDiffersAlthoughForcesBalance)
{
  Column column({3, -weight});
  for (auto& frame : column.frames)
    for (std::size_t c = 0; c < discs; ++c)
      Column::push(frame, c, {-0.02 * frame.contacts.force[c].x(), 0});
  EXPECT_EQ(failed(column), Names{"slope"});
}

TEST_F(CheckedColumn, FailsTheXDriftIfGrainsMoveWithoutVelocity)
{
  Column column;
  for (std::size_t k = 0; k < column.frames.size(); ++k)
    column.frames[k].image[1][0] = static_cast<std::int32_t>(k);
  EXPECT_EQ(failed(column), Names{"x_drift"});
}

/// Deviation of `check` in these lines; NaN if it is not there.
double measured(const char* check, const std::vector<CheckLine>& lines)
{
  for (const auto& line : lines)
    if (line.quantity == check) return line.measured;
  return NAN;
}

// A step of a run ends half a step after its positions, with a velocity that is larger by a h/2.
TEST_F(CheckedColumn, ThatAcceleratesMovesAsFarAsItsVelocitySays)
{
  const double a = 9;
  ASSERT_GT(a * h / 2, 1e-3 * std::sqrt(weight * small)) << "the half step counts";
  EXPECT_NEAR(measured("x_drift", lines_of(Column({a, -weight}, a))), 0, 1e-12);
  const Vec3 along = a * Vec3::UnitX();
  EXPECT_NEAR(measured("x_drift", lines_of(ColumnOf<3>(along - weight * Vec3::UnitY(), a))), 0,
              1e-12);
}

TEST_F(CheckedColumn, OfAnotherProgramHasPositionsAndVelocitiesOfOneInstant)
{
  Column column({9, -weight}, 9);
  column.description.parameters.texts["import_format"] = "lammps";
  column.description.parameters.texts["import_images"] = "known";
  for (auto& frame : column.frames)
    for (std::size_t g = 1; g <= discs; ++g) frame.velocity[g].x() = 9 * frame.time;
  EXPECT_NEAR(measured("x_drift", lines_of(column)), 0, 1e-12);
}

TEST_F(CheckedColumn, FailsTheEnergyDefectIfEnergyIsMissingUnlessNothingMoves)
{
  Column column({3, -weight}, 0.5);
  column.observables[7][2] = 1e-9;
  EXPECT_EQ(failed(column), Names{"energy_defect"});
  Column at_rest;
  at_rest.observables[7][2] = 1e-9;
  EXPECT_EQ(failed(at_rest), Names{});
}

TEST_F(CheckedColumn, FailsTheEnergyDriftIfMoreAndMoreEnergyIsMissing)
{
  Column column({3, -weight}, 0.5);
  for (std::size_t k = 0; k < column.frames.size(); ++k)
    column.observables[k][2] = 1e-11 * static_cast<double>(k);
  EXPECT_EQ(failed(column), (Names{"energy_defect", "energy_defect_drift"}));
}

// Friction f_x at a contact changes the spin of a disc by f_x r/(m r^2/2) per time; so does
// friction at every other contact for its two discs.
TEST_F(CheckedColumn, HasTorquesThatChangeTheSpinsOfConsecutiveSteps)
{
  const double g_x = 2;
  const auto turning = [&] {
    Column column({g_x, -weight}, 0, 1);
    const double mass = column.description.grains.mass[1];
    for (std::size_t k = 0; k < column.frames.size(); ++k) {
      for (std::size_t g = 1; g <= discs; ++g) {
        const auto& force = column.frames[k].contacts.force;
        const double sum = force[g - 1].x() + (g < discs ? force[g].x() : 0);
        column.frames[k].angular_velocity[g] =
            sum * radius / (mass * radius * radius / 2) * h * static_cast<double>(k);
      }
    }
    return column;
  };
  const auto lines = lines_of(turning());
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  EXPECT_EQ(with(Verdict::skipped, lines), Names{});
  auto column = turning();
  column.frames[7].angular_velocity[3] *= 1 + 1e-6;
  EXPECT_EQ(failed(column), Names{"torque_balance"});
}

// --- Files with less data, or damaged ones. ---

TEST_F(CheckedColumn, WithoutForcesOfGrainsSkipsTheChecksThatNeedThemWithTheReason)
{
  Column().write(path);
  tamper([](hid_t file) { H5Ldelete(file, "/particles/grains/force", H5P_DEFAULT); });
  const auto lines = lines_of_file();
  EXPECT_EQ(with(Verdict::failed, lines), (Names{"damaged_frames", "damaged_outside_frames"}));
  EXPECT_EQ(with(Verdict::skipped, lines),
            (Names{"approach_largest", "approach_mean", "force_balance", "open_gap_largest",
                   "open_gap_mean", "torque_balance"}));
  for (const auto& line : lines) {
    if (line.quantity == "force_balance") {
      EXPECT_EQ(line.remark, "the file holds no `force` of grains");
    }
  }
}

TEST_F(CheckedColumn, WithoutObservablesAndFrictionSkipsTheChecksThatNeedThem)
{
  Column column;
  column.description.observables.clear();
  for (auto& values : column.observables) values.clear();
  column.description.parameters.numbers.erase("friction");
  const auto lines = lines_of(column);
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  EXPECT_EQ(with(Verdict::skipped, lines),
            (Names{"coulomb_largest", "coulomb_mean", "energy_defect", "energy_defect_drift",
                   "torque_balance", "total_momentum"}));
}

TEST_F(CheckedColumn, WithFewFramesSkipsTheChecksThatNeedWindows)
{
  Column column;
  column.frames.resize(7);
  const auto lines = lines_of(column);
  EXPECT_EQ(with(Verdict::failed, lines), Names{});
  EXPECT_EQ(with(Verdict::skipped, lines), (Names{"energy_defect_drift", "overlap_drift", "slope",
                                                  "torque_balance", "weight", "x_drift"}));
}

TEST_F(CheckedColumn, WithoutFramesFails)
{
  Column column;
  column.frames.clear();
  const auto lines = lines_of(column);
  EXPECT_EQ(with(Verdict::failed, lines), Names{"no_frames"});
  EXPECT_EQ(with(Verdict::skipped, lines), Names{"physics"});
}

TEST_F(CheckedColumn, FailsIfAFrameDisagreesWithItsDigest)
{
  Column().write(path);
  tamper([](hid_t file) {
    const hid_t spins = H5Dopen2(file, "/particles/grains/angular_velocity/value", H5P_DEFAULT);
    std::vector<double> values(20 * (discs + 1));
    H5Dread(spins, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values[7 * (discs + 1) + 3] = 1e-300;
    H5Dwrite(spins, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(spins);
  });
  const auto lines = lines_of_file();
  EXPECT_EQ(with(Verdict::failed, lines), Names{"damaged_frames"});
  EXPECT_EQ(lines.at(2).remark, "frame 7 is the first that is not as written");
}

TEST_F(CheckedColumn, FailsIfTheFileWasNeverClosed)
{
  Column().write(path);
  tamper([](hid_t file) {
    const hid_t seal = H5Dopen2(file, "/grseg/seal", H5P_DEFAULT);
    const std::vector<std::uint64_t> empty(4);
    H5Dwrite(seal, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, empty.data());
    H5Dclose(seal);
  });
  EXPECT_EQ(with(Verdict::failed, lines_of_file()), Names{"not_closed"});
}

}  // namespace
}  // namespace grseg
