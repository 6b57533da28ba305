// SPDX-License-Identifier: GPL-3.0-or-later
// Table and summary of the balance under several rules.
#include "analysis/balance/balance_table.hpp"
#include "analysis/balance/driving_forces.hpp"
#include "tests/analysis/balance/random_balance.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

double number_under(const std::vector<std::string>& columns, const std::vector<double>& row,
                    const std::string& column)
{
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c] == column) return row[c];
  ADD_FAILURE() << "no column " << column;
  return 0;
}

TEST(PartitionTable, EveryNumberStandsUnderItsRuleAndUnit)
{
  const auto frames = two_frames(12);
  const auto balance = momentum_of<2>(frames);
  const auto contacts = contacts_of<2>(frames);
  const auto species = two_sizes(0.2, 0.4);
  const auto columns = columns_of(partition_cells(balance, contacts, species, std::nullopt));
  const auto row = values_of(partition_cells(balance, contacts, species, 1));
  ASSERT_EQ(columns.size(), row.size());
  const auto forces = driving_forces(balance, 1);
  const auto half = rule_forces(forces, contacts, 1, 2);
  const auto small = contacts.mean(1, Species::small, 7);
  EXPECT_EQ(number_under(columns, row, "push@half[N/m^2]"), half.push);
  EXPECT_EQ(number_under(columns, row, "drag@half[N/m^2]"), half.drag);
  EXPECT_EQ(number_under(columns, row, "psi_L@half"), half.psi);
  EXPECT_EQ(number_under(columns, row, "contact_S_x@power:2[N/m^2]"), small.contact.x());
  EXPECT_EQ(number_under(columns, row, "interaction_S_y@power:2[N/m^2]"), small.interaction.y());
  EXPECT_EQ(number_under(columns, row, "N_L_y[N/m^2]"),
            contacts.contact_force(1, Species::large).y());
  EXPECT_EQ(number_under(columns, row, "p_zero"), push_over_share(forces, contacts, 1).zero());
}

TEST(PartitionTable, OfThreeSpeciesOfSpheresThereAreTheTermsOfEach)
{
  const SpeciesList species{{"SE", 0.2}, {"AM", 0.4}, {"CB", 0.6}};
  const std::vector frames{random_contacts<3>(13, 3)};
  const auto contacts = contacts_of<3>(frames, parse_rules({"half"}), 3);
  const auto balance = momentum_of<3>(frames, 3);
  const auto columns = columns_of(partition_cells(balance, contacts, species, std::nullopt));
  const auto row = values_of(partition_cells(balance, contacts, species, 1));
  ASSERT_EQ(columns.size(), row.size());
  EXPECT_EQ(columns.size(), 3u * 2 * 3 + 3 * 3);
  EXPECT_EQ(number_under(columns, row, "interaction_CB_z@half[N/m^3]"),
            contacts.mean(1, static_cast<Species>(2), 0).interaction.z());
  EXPECT_EQ(number_under(columns, row, "N_SE_z[N/m^3]"),
            contacts.contact_force(1, Species::small).z());
}

// Momentum density: kg m/s per m^2 or m^3.
TEST(PartitionTable, TheDriftHasTheUnitOfAMomentumDensity)
{
  const auto has = [](const auto& balance, const std::string& name) {
    const auto columns = columns_of(balance_cells(balance, two_sizes(1, 2), std::nullopt));
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  EXPECT_TRUE(has(momentum_of<2>({random_contacts<2>(12, 2)}), "drift[kg/(m s)]"));
  EXPECT_TRUE(has(momentum_of<3>({random_contacts<3>(13, 2)}), "drift[kg/(m^2 s)]"));
}

// p* is a ratio of sums a/b over n windows. Each window adds a_k - p* b_k to its error: the variance of
// these numbers over n, divided by the mean of b.
TEST(PartitionSummary, TheErrorOfPStarIsThatOfARatioOfSums)
{
  const auto layers = thin_layers<2>();
  const double large_diameter = 0.01;
  BalanceSummary<2> summary(layers, large_diameter, all_rules);
  std::vector<double> above, below;
  for (unsigned seed = 21; seed < 26; ++seed) {
    const auto frames = two_frames(seed);
    const auto window = momentum_of<2>(frames);
    const auto contacts = contacts_of<2>(frames);
    summary.add(window, &contacts);
    double none = 0, all = 0, weight = 0;
    for (const auto n : layers_inside(window, layers, large_diameter)) {
      const auto over = push_over_share(driving_forces(window, n), contacts, n);
      none += over.none;
      all += over.all;
      weight += std::abs(window.mean(n, Species::large).gravity.y());
    }
    above.push_back(none / weight);
    below.push_back((none - all) / weight);
  }
  const double n = 5;
  double a = 0, b = 0, squares = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    a += above[k] / n;
    b += below[k] / n;
  }
  for (std::size_t k = 0; k < 5; ++k) squares += std::pow(above[k] - a / b * below[k], 2);
  const auto zero = nlohmann::json::parse(summary.to_json({}))["summary"]["p_zero"];
  EXPECT_NEAR(zero["mean"].get<double>(), a / b, 1e-12);
  EXPECT_NEAR(zero["standard_error"].get<double>(), std::sqrt(squares / (n - 1) / n) / std::abs(b),
              1e-12);
}

// One window has no standard error: numbers are printed alone; for several windows the error is
// printed, too.
TEST(PartitionSummary, OfOneWindowHasNoErrors)
{
  BalanceSummary<2> summary(thin_layers<2>(), 0.01, all_rules);
  const auto add = [&](unsigned seed) {
    const auto frames = two_frames(seed);
    const auto contacts = contacts_of<2>(frames);
    summary.add(momentum_of<2>(frames), &contacts);
  };
  add(21);
  EXPECT_EQ(summary.text().find("nan"), std::string::npos) << summary.text();
  EXPECT_EQ(summary.text().find("+-"), std::string::npos) << summary.text();
  EXPECT_NE(summary.text().find("surface, of one window)"), std::string::npos);
  add(22);
  EXPECT_NE(summary.text().find("standard errors over 2 windows"), std::string::npos);
  EXPECT_NE(summary.text().find(" +- "), std::string::npos);
}

}  // namespace
}  // namespace grseg
