// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/flow_verdict.hpp"

#include "analysis/fit/time_series.hpp"
#include "analysis/frames/composition.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace grseg {
namespace {

using namespace synthetic;
using OverTime = std::function<double(double)>;  // a number of the time t, s

constexpr double last = 37.5;  // end of neutral_rows(), s

/// Table of grains whose velocity along x is `shear` times the height; the density is 2. B by size
/// grows by `of_b`.
Table flowing(
    const OverTime& shear, const OverTime& of_b = [](double) { return 0; })
{
  auto rows = neutral_rows(0.1);
  for (auto& row : rows) row.sums.of(OwnSum::inside, 1) *= 1 + of_b(row.begin);
  auto table = stress_table(rows);
  table.header.emplace_back("density", "2");
  table.header.emplace_back("gravity_x", "3.83");
  for (const auto& name : motion_columns(2)) table.columns.push_back(name);
  for (auto& row : table.rows) {
    const double u = shear(row[0]) * (row[2] + row[3]) / 2, area = row[6] + row[7];
    row.push_back(area * u);
    row.push_back(area * u * u);
  }
  return table;
}

FlowVerdict verdict_on(const std::vector<Table>& tables, const std::string& rule = "size")
{
  const auto read_tables = read_all(tables);
  const auto data = select_fit_data(read_tables, Quantity::contact, {}, {{0, 1}});
  return grseg::verdict_on(read_tables, data, fit_rule(data, parse_rule(rule), {}), {});
}

/// All sentences and doubts, line by line.
std::string text_of(const FlowVerdict& verdict)
{
  std::string text;
  for (const auto& sentence : verdict.sentences) text += sentence + '\n';
  for (const auto& doubt : verdict.doubts) text += "doubt: " + doubt + '\n';
  return text;
}

OverTime constant(double value)
{
  return [value](double) { return value; };
}

// gamma d sqrt(rho/sigma_yy), with the mean of d over the grains' area and of sigma_yy = 1.1 N/m
// times neutral_sums() over the volume.
TEST(FlowVerdict, StatesTheInertialNumberOfALinearProfile)
{
  const std::vector<Table> table{flowing(constant(3))};
  const auto tables = read_all(table);
  const auto data = select_fit_data(tables, Quantity::contact, {}, {{0, 1}});
  double area = 0, diameter = 0, stress = 0;
  for (const auto& row : tables[0].rows) {
    const double a = row.sums.content[0] + row.sums.content[1];
    area += a;
    diameter += row.sums.content[0] * 0.005 + row.sums.content[1] * 0.01;
    stress += a * partial_stress(row.sums, {}, BasePart::contact_point).total(1, 1);
  }
  const auto motion = motion_of_windows(tables, data, BasePart::contact_point);
  ASSERT_EQ(motion.inertial_number.size(), 1u);
  EXPECT_NEAR(motion.inertial_number[0], 3 * diameter / area * std::sqrt(2 * area / stress), 1e-12);
}

TEST(FlowVerdict, OfASteadyFlowHasNoDoubt)
{
  const auto verdict = verdict_on({flowing(constant(3))});
  EXPECT_TRUE(verdict.doubts.empty()) << text_of(verdict);
  EXPECT_TRUE(holds(text_of(verdict), "flows: inertial number 0.0")) << text_of(verdict);
  EXPECT_TRUE(holds(text_of(verdict), "steady in these times")) << text_of(verdict);
  EXPECT_FALSE(verdict.changes);
}

TEST(FlowVerdict, SaysThatABedRestsOrCreeps)
{
  const auto verdict = verdict_on({flowing(constant(3e-3))});
  EXPECT_TRUE(holds(text_of(verdict), "rests or creeps: inertial number")) << text_of(verdict);
  EXPECT_TRUE(holds(text_of(verdict), "doubt: the inertial number is below 0.001"))
      << text_of(verdict);
}

// The energy doubles, as in a chute that is too steep: the speed grows by the root of 2.
TEST(FlowVerdict, SaysThatAFlowAccelerates)
{
  const auto verdict = verdict_on({flowing([](double t) { return 3 * std::sqrt(1 + t / last); })});
  EXPECT_TRUE(holds(text_of(verdict), "accelerates: the speed goes from")) << text_of(verdict);
  EXPECT_TRUE(holds(text_of(verdict), "doubt: the flow is not steady")) << text_of(verdict);
}

// Four windows of a speed that doubles: of no three of them is the speed steady, and two show nothing.
TEST(FlowVerdict, SaysThatAFlowAcceleratesInFourWindows)
{
  auto table = flowing([](double t) { return 3 * (1 + t / 5); });
  table.rows.resize(4 * compositions.size());
  const auto verdict = verdict_on({table});
  EXPECT_TRUE(holds(text_of(verdict), "accelerates: the speed goes from")) << text_of(verdict);
}

// The speed relaxes within 1.5 s.
TEST(FlowVerdict, SaysSinceWhenAFlowIsSteady)
{
  const auto verdict =
      verdict_on({flowing([](double t) { return 3 * (1 - 0.9 * std::exp(-t / 1.5)); })});
  EXPECT_TRUE(holds(text_of(verdict), "steady since t = ")) << text_of(verdict);
  EXPECT_TRUE(
      holds(text_of(verdict), "doubt: the start of the flow differs from the rest; --begin"))
      << text_of(verdict);
}

TEST(FlowVerdict, DoesNotSayHowLongABedThatRestsShouldLast)
{
  EXPECT_FALSE(holds(text_of(verdict_on({flowing(constant(3e-3))})), "needs"));
}

TEST(FlowVerdict, ForetellsTheNeededTimeFromTwelveWindowsOn)
{
  auto table = flowing(constant(3));
  const auto foretells = [&](std::size_t windows) {
    table.rows.resize(windows * compositions.size());
    const auto text = text_of(verdict_on({table}));
    return holds(text, "B +- 0.01 needs") || holds(text, "B is known to");
  };
  EXPECT_TRUE(foretells(12));
  EXPECT_FALSE(foretells(11));
}

TEST(FlowVerdict, SaysThatBFallsAndNeedsRunsRatherThanTime)
{
  const auto verdict =
      verdict_on({flowing(constant(3), [](double t) { return 0.4 * (1 - t / last); })});
  EXPECT_TRUE(verdict.changes);
  EXPECT_TRUE(holds(text_of(verdict), "not steady: B falls from ")) << text_of(verdict);
  EXPECT_TRUE(holds(text_of(verdict), " such runs (an order of magnitude)\n")) << text_of(verdict);
  EXPECT_FALSE(holds(text_of(verdict), " s of this flow")) << text_of(verdict);
}

// Large grains take the place of small ones above the middle and give up theirs below it.
TEST(FlowVerdict, SaysThatGrainsStillSegregateAndThatIntervalsAreOverTheseTimesAlone)
{
  auto table = flowing(constant(3));
  double middle = 0;
  for (const auto& row : table.rows)
    middle += (row[2] + row[3]) / 2 / static_cast<double>(table.rows.size());
  for (auto& row : table.rows) {
    const double part = 0.5 * row[0] / last * ((row[2] + row[3]) / 2 - middle) / middle;
    const double moved = part * row[6] * row[7] / (row[6] + row[7]);
    row[6] -= moved;
    row[7] += moved;
  }
  const auto verdict = verdict_on({table});
  EXPECT_TRUE(holds(text_of(verdict), "still segregating")) << text_of(verdict);
  EXPECT_TRUE(holds(text_of(verdict), "large grains rise by ")) << text_of(verdict);
  EXPECT_TRUE(verdict.changes);
  EXPECT_FALSE(holds(text_of(verdict), " s of this flow")) << text_of(verdict);
}

// Two runs, each with windows of 1.25 s; u = 3 y, so that the mean square velocity is 9 times that of y.
TEST(TimeSeries, HasARowForEachWindowOfEachRun)
{
  auto early = flowing(constant(3)), late = flowing(constant(3), constant(0.01));
  early.rows.resize(3 * compositions.size());
  late.rows.resize(4 * compositions.size());
  late.header.emplace_back("scene", "friction = 0.4");
  const std::vector<Table> tables{early, late};
  const auto read_tables = read_all(tables);
  const auto data = select_fit_data(read_tables, Quantity::contact, {}, {{0, 1}});
  const auto rows = time_series(read_tables, data, parse_rules({"size,half"}), {});
  ASSERT_EQ(rows.size(), number_of_windows(data.runs));
  EXPECT_EQ(columns_of(rows.front()),
            (std::vector<std::string>{"run", "t0[s]", "t1[s]", "B_size", "B_half", "phi_L",
                                      "y_L_minus_y_S[m]", "speed[m/s]", "stress_ratio"}));
  double b = 0, weight = 0, square = 0, area = 0;
  for (const auto& row : read_tables[0].rows) {
    if (row.key.begin > 0) continue;
    const double large = row.sums.content[1] / row.content(),
                 y = (row.key.bottom + row.key.top) / 2;
    const auto stress = partial_stress(row.sums, {}, BasePart::contact_point);
    b += stress.large()(1, 1) / stress.total(1, 1) - large;
    weight += large * (1 - large);
    square += 9 * y * y * row.content();
    area += row.content();
  }
  const auto first = values_of(rows.front());
  EXPECT_EQ(first[0], 1);
  EXPECT_EQ(first[2], 1.25);
  EXPECT_NEAR(first[3], b / weight, 1e-12);
  EXPECT_NEAR(first[5], 0.5, 1e-12);  // the mean of `compositions`
  EXPECT_NEAR(first[7], std::sqrt(square / area), 1e-12);
  EXPECT_NEAR(first[8], 0.41 / 1.1, 1e-12);  // any_tensor()
}

TEST(FlowVerdict, OfTablesWithoutVelocitiesSaysThatMotionIsUnknown)
{
  const auto verdict = verdict_on({stress_table(neutral_rows(0.1))});
  EXPECT_TRUE(holds(text_of(verdict), "motion unknown: the tables have no velocities; "));
}

// Contacts carry no shear stress in the first 4 of 40 windows, as if grains began to move.
TEST(FlowVerdict, FindsAStartInTheShearStressOfTablesWithoutVelocities)
{
  auto rows = neutral_rows(0.1, 2, 40);
  const auto text = [&] { return text_of(verdict_on({stress_table(rows)})); };
  EXPECT_TRUE(holds(text(), "the stress is steady in these times")) << text();
  for (std::size_t k = 0; k < 4 * compositions.size(); ++k)
    for (const auto part : {OwnSum::inside}) {
      for (std::size_t s = 0; s < 2; ++s) rows[k].sums.of(part, s)(0, 1) *= 0.5;
    }
  const auto words = text();
  ASSERT_TRUE(holds(words, "leaves it out")) << words;
  // The four windows, and more where noise resembles them, but at most half of 50 s.
  const double begin = std::stod(words.substr(words.find("--begin ") + 8));
  EXPECT_GE(begin, 5);
  EXPECT_LE(begin, 25);
}

}  // namespace
}  // namespace grseg
