// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/flows.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::read_all;
using synthetic::run_of;

using Numbers = std::vector<std::size_t>;

TEST(Flows, TablesThatDifferInTheirSeedAloneAreRunsOfOne)
{
  const std::vector<Table> tables{run_of(0.45), run_of(0.301), run_of(0.3), run_of(0.452)};
  auto read = read_all(tables);
  const auto flows = find_flows(read, "auto");
  ASSERT_EQ(flows.size(), 2u);
  EXPECT_EQ(flows[0].tables, (Numbers{1, 2}));
  EXPECT_EQ(flows[1].tables, (Numbers{0, 3}));
  EXPECT_EQ(flows[0].name, "Phi_L = 0.30");
  EXPECT_NEAR(flows[1].phi_large(), 0.451, 1e-12);  // of both tables
  EXPECT_EQ(read[3].flow, 1u);
}

// 0.315 is as near to 0.3 as to 0.33.
TEST(Flows, AreTheSameInAnyOrderOfTheTables)
{
  std::vector<double> compositions{0.3, 0.315, 0.33};
  do {
    const auto tables = listed(compositions, [](double phi) { return run_of(phi); });
    auto read = read_all(tables);
    const auto flows = find_flows(read, "auto");
    ASSERT_EQ(flows.size(), 2u);
    EXPECT_NEAR(flows[0].phi_large(), 0.3075, 1e-12);
  } while (std::next_permutation(compositions.begin(), compositions.end()));
}

TEST(Flows, IntervalsAreTheSameInAnyOrderOfTheTables)
{
  std::vector<Table> tables;
  for (const int windows : {20, 30, 50})
    tables.push_back(synthetic::stress_table(synthetic::neutral_rows(0.002 * windows, 2, windows)));
  const auto fit = [&](Population over) {
    return synthetic::fit(synthetic::read(tables), "half", {.over = over});
  };
  for (const auto over : {Population::windows, Population::runs}) {
    const auto forward = fit(over);
    std::swap(tables[0], tables[2]);
    std::swap(tables[1], tables[2]);
    const auto backward = fit(over);
    EXPECT_NEAR(backward.low.B, forward.low.B, 1e-12);
    EXPECT_NEAR(backward.high.B, forward.high.B, 1e-12);
    EXPECT_NEAR(backward.line.p_zero.error.error, forward.line.p_zero.error.error, 1e-12);
  }
}

TEST(Flows, AreToldApartByAllThatTablesRecordOfTheFlow)
{
  const std::vector<Table> tables{run_of(0.3), run_of(0.301, "4.3"), run_of(0.302, "3.8300001")};
  auto read = read_all(tables);
  const auto flows = find_flows(read, "auto");
  ASSERT_EQ(flows.size(), 2u);
  EXPECT_EQ(flows[0].tables, (Numbers{0, 2}));
  EXPECT_EQ(flows[0].name, "Phi_L = 0.30, gravity_x = 3.83");
  EXPECT_EQ(flows[1].name, "Phi_L = 0.30, gravity_x = 4.3");
}

// Gravity of 9.8 m/s^2 that is inclined by 21 and 26 degrees.
TEST(Flows, AreToldApartByTheirSlopeIfGravityTurnsInTheirPlane)
{
  const auto inclined = [](double slope, const std::string& across) {
    const double angle = slope * std::acos(-1.0) / 180;
    auto table = run_of(0.3 + 1e-5 * slope, std::to_string(9.8 * std::sin(angle)));
    for (auto& [key, value] : table.header)
      if (key == "gravity_y") value = std::to_string(-9.8 * std::cos(angle));
    table.header.emplace_back("gravity_z", across);
    return table;
  };
  const auto flows_of = [](const std::vector<Table>& tables) {
    auto read = read_all(tables);
    return find_flows(read, "auto");
  };
  const auto flows = flows_of({inclined(21, "0"), inclined(26, "0")});
  ASSERT_EQ(flows.size(), 2u);
  EXPECT_EQ(flows[0].name, "Phi_L = 0.30, slope = 21 degrees");
  ASSERT_EQ(flows[1].settings.size(), 1u);
  EXPECT_EQ(flows[1].settings[0].first, "slope[degree]");
  EXPECT_NEAR(std::stod(flows[1].settings[0].second), 26, 1e-5);
  EXPECT_EQ(flows_of({inclined(21, "0"), inclined(26, "1")})[0].settings.size(), 3u);
}

// For spheres the cell also has a width. A value that only one of two tables records also
// distinguishes them.
TEST(Flows, AreToldApartByTheirMaterialAndTheWidthOfTheCell)
{
  int runs = 0;
  const auto with = [&runs](std::vector<HeaderLine> lines) {
    auto table = run_of(0.3 + 1e-4 * runs++ / 100);
    table.header.insert(table.header.end(), lines.begin(), lines.end());
    return table;
  };
  for (const char* key : {"density", "friction", "restitution", "length_z"}) {
    const std::vector<Table> tables{with({{key, "0.3"}}), with({{key, "0.8"}}), with({}),
                                    with({{key, "0.3"}}), with({{key, "unknown"}})};
    auto read = read_all(tables);
    const auto flows = find_flows(read, "auto");
    ASSERT_EQ(flows.size(), 3u) << key;
    EXPECT_EQ(flows[0].tables, (Numbers{0, 3}));
    EXPECT_EQ(flows[0].name, std::string("Phi_L = 0.30, ") + key + " = 0.3");
    EXPECT_EQ(flows[2].name, std::string("Phi_L = 0.30, ") + key + " = unknown");
    EXPECT_EQ(flows[2].tables, (Numbers{2, 4}));
  }
}

TEST(Flows, TheWordsNameWhatTheTablesRecord)
{
  EXPECT_EQ(grouping_words("auto", {run_of(0.3)}),
            "runs of one flow agree in what their tables record of the flow (diameters, gravity), "
            "diameters to 1 %, and in overall composition, to 0.02");
  auto with_friction = run_of(0.3);
  with_friction.header.insert(with_friction.header.end(),
                              {{"density", "unknown"}, {"friction", "0.5"}});
  EXPECT_NE(
      grouping_words("auto", {run_of(0.3), with_friction}).find("(diameters, friction, gravity)"),
      std::string::npos);
}

// Nominal diameters of imported runs are measured on the grains, which differ from seed to seed.
TEST(Flows, DiametersMeasuredOnTheGrainsOfSeedsAreThoseOfOne)
{
  int runs = 0;
  const auto with = [&runs](const char* large, const char* species) {
    auto table = run_of(0.3 + 1e-6 * runs++);
    for (auto& [key, value] : table.header)
      if (key == "large_diameter") value = large;
    table.header.emplace_back("species", species);
    return table;
  };
  const std::vector<Table> tables{
      with("0.01", "S 0.005, L 0.01"), with("0.009997", "S 0.005, L 0.009997"),
      with("0.0098", "S 0.005, L 0.0098"), with("0.01", "S 0.005, X 0.01")};
  auto read = read_all(tables);
  const auto flows = find_flows(read, "auto");
  ASSERT_EQ(flows.size(), 3u);
  EXPECT_EQ(flows[0].tables, (Numbers{0, 1}));
}

// Initial mixing and bed depth are recorded in the scene only; different seeds and times are not different
// flows.
TEST(Flows, DifferInTheKeysOfTheirScenesButSeedsAndTimes)
{
  int runs = 0;
  const auto of_scene = [&runs](const char* scene) {
    auto table = run_of(0.3 + 1e-6 * runs++);
    if (scene[0] != 0) table.header.emplace_back("scene", scene);
    return table;
  };
  const std::vector<Table> tables{
      of_scene("initial = mixed; depth = 0.3; seed = 1; duration = 60"),
      of_scene("initial = mixed; depth = 0.30000000000001; seed = 2; duration = 150"),
      of_scene("initial = large-below; depth = 0.3; seed = 1; duration = 60"),
      of_scene("initial = mixed; depth = 0.6; seed = 1; duration = 60"), of_scene("")};
  auto read = read_all(tables);
  const auto flows = find_flows(read, "auto");
  ASSERT_EQ(flows.size(), 3u);
  EXPECT_EQ(flows[0].tables, (Numbers{0, 1, 4}));
  EXPECT_EQ(flows[1].name, "Phi_L = 0.30, depth = 0.3, initial = large-below");
  ASSERT_EQ(flows[2].settings.size(), 2u);
  EXPECT_EQ(flows[2].settings[0], (std::pair<std::string, std::string>{"depth[m]", "0.6"}));
}

// The text of a scene states keys of all geometries, and the mass of a plate follows from the length
// of the cell.
TEST(Flows, AreNotToldApartByKeysOfOtherGeometries)
{
  const auto flows_of = [](const std::string& geometry) {
    std::vector<Table> tables{run_of(0.3), run_of(0.301)};
    tables[0].header.emplace_back("scene", geometry + "; plate-mass = 1; fill = 0.4");
    tables[1].header.emplace_back("scene", geometry + "; plate-mass = 2; fill = 0.4");
    auto read = read_all(tables);
    return find_flows(read, "auto");
  };
  EXPECT_EQ(flows_of("geometry = bed").size(), 1u);
  const auto flows = flows_of("geometry = shear");
  ASSERT_EQ(flows.size(), 2u);
  EXPECT_EQ(flows[1].name, "Phi_L = 0.30, plate-mass = 2");
}

// Where the slope turns, gravity is recorded as nan, and only the scene tells the slope at t = 0.
TEST(Flows, ThatTurnDifferInTheirSlopesAtTheStart)
{
  int runs = 0;
  const auto turning = [&runs](const char* scene) {
    auto table = run_of(0.3 + 1e-6 * runs++, "nan");
    table.header.emplace_back("scene", scene);
    return table;
  };
  const std::vector<Table> tables{turning("slope = 21; slope-rate = 0.1"),
                                  turning("slope = 24; slope-rate = 0.1"),
                                  turning("slope = 21; slope-rate = 0.1")};
  auto read = read_all(tables);
  const auto flows = find_flows(read, "auto");
  ASSERT_EQ(flows.size(), 2u);
  EXPECT_EQ(flows[0].tables, (Numbers{0, 2}));
  EXPECT_EQ(flows[1].name, "Phi_L = 0.30, slope = 24");
}

// A list that starts with the same number may still be different.
TEST(Flows, AListIsNotItsFirstNumber)
{
  std::vector<Table> tables{run_of(0.3), run_of(0.3001)};
  tables[0].header.emplace_back("friction", "0.5, 0.3");
  tables[1].header.emplace_back("friction", "0.5, 0.4");
  auto read = read_all(tables);
  EXPECT_EQ(find_flows(read, "auto").size(), 2u);
}

TEST(Flows, AreAsTheUserSays)
{
  const std::vector<Table> tables{run_of(0.3), run_of(0.301), run_of(0.5)};
  auto read = read_all(tables);
  const auto flows = find_flows(read, "1,2");
  ASSERT_EQ(flows.size(), 2u);
  EXPECT_EQ(flows[1].tables, (Numbers{1, 2}));
  for (const char* wrong : {"2", "4", "1,2,0", "", "1,-1", "x", "1;2", "99999999999999999999"})
    EXPECT_THROW(find_flows(read, wrong), UsageError) << wrong;
}

TEST(Flows, ThePartOfOneIsWhatItsTablesGiveAlone)
{
  const std::vector<Table> tables{run_of(0.3, "1", 0.2), run_of(0.5, "1", 0.4),
                                  run_of(0.31, "1", -0.1)};
  auto read = read_all(tables);
  find_flows(read, "auto");
  const auto both = select_fit_data(read, Quantity::contact, {}, {{0, 1}});
  const auto alone = select_fit_data({read[0], read[2]}, Quantity::contact, {}, {{0, 1}});
  const auto part = of_flow(both, 0);
  EXPECT_EQ(part.runs, alone.runs);
  EXPECT_EQ(part.rows.size(), alone.rows.size());
  const PartitionRule half = parse_rule("half");
  EXPECT_EQ(fit_rule(part, half, {}).value.B, fit_rule(alone, half, {}).value.B);
  const double products = 0.3 * 0.7 + 0.31 * 0.69;
  EXPECT_NEAR(weight_shares(both, 2)[0], products / (products + 0.25), 1e-12);
}

}  // namespace
}  // namespace grseg
