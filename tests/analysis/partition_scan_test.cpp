// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/partition_scan.hpp"

#include "formats/errors.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

using synthetic::neutral_data;
using synthetic::neutral_rows;
using synthetic::no_bootstrap;
using synthetic::read;
using synthetic::stress_table;

TEST(PartitionScan, EveryShareIsTheSingleFitOfItsRule)
{
  const auto data = neutral_data(0.1);
  const Bootstrap bootstrap(data.runs, 200, 4);
  const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.1"), {}, bootstrap);
  ASSERT_EQ(scan.fits.size(), 6u);
  for (const auto& one : scan.fits) {
    const auto single =
        fit_rule(data, {PartitionRule::Kind::uniform, one.rule.value}, {}, bootstrap);
    EXPECT_NEAR(one.value.B_half, single.value.B_half, 1e-12);
    EXPECT_NEAR(one.low.B_half, single.low.B_half, 1e-12);
    EXPECT_NEAR(one.high.B_direct, single.high.B_direct, 1e-12);
  }
}

// B_half = 2 (1 - s)/(1 + s) has the slope of -ln s at s = 1, and there the neutral model gives
// -d ln(y)/dp = m/(psi_S psi_L) = (1 + r)/(phi_L + r phi_S), averaged with the weights of the
// slope.
TEST(PartitionScan, NeutralContactsHaveNoSegregationAtTheShareBySize)
{
  for (const double r : {2.0, 3.0}) {
    const auto data = read({stress_table(neutral_rows(0, r), 0.005, 0.005 * r)});
    const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.005"), {}, no_bootstrap(data));
    double weight = 0, slope = 0;
    for (const auto& sample : data.samples) {
      weight += sample.weight;
      slope += sample.weight * (1 + r) / (sample.phi_large + r * (1 - sample.phi_large));
    }
    EXPECT_NEAR(scan.p_zero, r / (1 + r), 1e-12);
    EXPECT_NEAR(scan.dB_dp, slope / weight, 1e-10);
    EXPECT_TRUE(std::isnan(scan.p_low));
  }
}

TEST(PartitionScan, TheIntervalOfTheZeroHoldsIt)
{
  const auto data = neutral_data(0.2);
  const auto scan =
      scan_partition(data, parse_scan("0.5:0.8:0.01"), {}, Bootstrap(data.runs, 500, 1));
  EXPECT_LT(scan.p_low, scan.p_zero);
  EXPECT_GT(scan.p_high, scan.p_zero);
}

TEST(PartitionScan, ARangeWithoutAZeroSaysSo)
{
  const auto data = neutral_data(0);
  const auto scan = scan_partition(data, parse_scan("0.7:0.9:0.1"), {}, no_bootstrap(data));
  EXPECT_TRUE(std::isnan(scan.p_zero));
  EXPECT_TRUE(std::isnan(scan.dB_dp));
}

TEST(PartitionScan, SharesAreExactAndIncludeTheLast)
{
  const auto shares = parse_scan("0.4:0.9:0.005").shares();
  ASSERT_EQ(shares.size(), 101u);
  EXPECT_EQ(shares[40], 0.6);
  EXPECT_EQ(shares[100], 0.9);
  EXPECT_EQ(parse_scan("0:0.3:0.1").shares().size(), 4u);  // 0.3/0.1 is below 3 in binary
  for (const char* wrong : {"0.4:0.9", "0.4:0.9:0", "0.9:0.4:0.1", "0:1.1:0.1", "a:b:c", "0:1:0.1x",
                            "0:1:1e-9", "nan:1:0.1"})
    EXPECT_THROW(parse_scan(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace grseg
