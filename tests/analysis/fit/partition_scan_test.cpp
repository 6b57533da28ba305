// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_pairs.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grseg {
namespace {

using synthetic::neutral_data;
using synthetic::neutral_rows;
using synthetic::read;
using synthetic::stress_table;

PartitionRule uniform(double share)
{
  return {PartitionRule::Kind::uniform, share};
}

TEST(PartitionScan, EveryShareIsTheSingleFitOfItsRule)
{
  const auto data = neutral_data(0.1);
  const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.1"), {});
  ASSERT_EQ(scan.fits.size(), 6u);
  for (const auto& one : scan.fits) {
    const auto single = fit_rule(data, uniform(one.rule.value), {});
    EXPECT_NEAR(one.value.B, single.value.B, 1e-14);
    EXPECT_NEAR(one.low.B, single.low.B, 1e-13);
    EXPECT_NEAR(one.high.B, single.high.B, 1e-13);
    EXPECT_NEAR(one.neutral, single.neutral, 1e-14);
    EXPECT_EQ(one.doubt, single.doubt);
    EXPECT_EQ(one.points, single.points);
  }
}

/// 120 windows in which contacts between large grains are correlated over ten windows and mixed
/// contacts are not.
FitData of_two_memories()
{
  synthetic::Ar1 slow(0.8), quick(0);
  const Eigen::VectorXd large = slow.series(120), mixed = quick.series(120);
  std::vector<synthetic::TableRow> rows;
  for (Eigen::Index window = 0; window < 120; ++window) {
    auto sums = synthetic::neutral_sums(0.5, 2);
    sums.of(OwnSum::inside, 1) *= 1 + 0.02 * large[window];
    for (const auto part : {PairSum::whole, PairSum::by_size, PairSum::up_to_contact})
      sums.of(part, 0) *= 1 + 0.1 * mixed[window];
    const auto begin = static_cast<double>(window);
    rows.push_back({begin, begin + 1, 25, sums});
  }
  return read({stress_table(rows)});
}

// The error is the root of a sum of squares that are linear in the share, so the band is as smooth
// as B: a step of 0.002 changes its half-width, which halves over some tenths, by less than two per
// cent.
TEST(PartitionScan, TheBandOfBIsSmooth)
{
  const auto scan = scan_partition(of_two_memories(), parse_scan("0.5:0.8:0.002"), {});
  const auto half_width = [](const RuleFit& fit) { return (fit.high.B - fit.low.B) / 2; };
  for (std::size_t k = 1; k < scan.fits.size(); ++k)
    EXPECT_NEAR(half_width(scan.fits[k]) / half_width(scan.fits[k - 1]), 1, 0.02);
}

// The neutral model gives d(psi_L)/dp = phi_L phi_S (1 + r)/(phi_L + r phi_S); its sum divided by the
// sum of phi_L phi_S is the slope of B.
TEST(PartitionScan, NeutralContactsHaveNoSegregationAtTheShareBySize)
{
  for (const double r : {2.0, 3.0}) {
    const auto data = read({stress_table(neutral_rows(0, r), 0.005, 0.005 * r)});
    const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.005"), {});
    double weight = 0, slope = 0;
    for (const auto& sample : data.samples) {
      const double product = sample.frames * sample.phi_large * (1 - sample.phi_large);
      weight += product;
      slope += product * (1 + r) / (sample.phi_large + r * (1 - sample.phi_large));
    }
    EXPECT_NEAR(scan.line.p_zero.value, r / (1 + r), 1e-12);
    EXPECT_NEAR(scan.line.dB_dp.value, slope / weight, 1e-10);
  }
}

// If contacts count in the layer of the grain's centre (--assign grain), the contacts that small
// grains of a layer lose are not the ones that its large grains gain.
FitData at_centres()
{
  auto data = neutral_data(0.1);
  for (auto& sums : data.rows) {
    sums.at_centres = true;
    for (std::size_t k = 0; k < 2; ++k) sums.of(OwnSum::halves, k) = sums.of(OwnSum::inside, k);
    sums.of(PairSum::at_larger, 0) = 1.1 * sums.of(PairSum::whole, 0);
    sums.of(PairSum::at_smaller, 0) = 0.8 * sums.of(PairSum::whole, 0);
  }
  return data;
}

// B(p) is no straight line then: between B(0) and B(1) the line is off by 0.01 and more.
TEST(PartitionScan, TheShareOfARuleGivesItsBOfPartsAtTheGrainsToo)
{
  const auto data = at_centres();
  EXPECT_NEAR(fit_rule(data, parse_rule("half"), {}).share, 0.5, 1e-12);
  const auto size = fit_rule(data, parse_rule("size"), {});
  EXPECT_NEAR(fit_rule(data, uniform(size.share), {}).value.B, size.value.B, 1e-12);
  const auto b_at = [&](double share) { return fit_rule(data, uniform(share), {}).value.B; };
  EXPECT_GT(std::abs(b_at(0.5) - (b_at(0) + b_at(1)) / 2), 0.01);
}

TEST(PartitionScan, AScanOfPartsAtTheGrainsIsTheFitOfEachRule)
{
  const auto data = at_centres();
  for (const auto& one : scan_partition(data, parse_scan("0.4:0.8:0.2"), {}).fits)
    EXPECT_NEAR(one.value.B, fit_rule(data, uniform(one.rule.value), {}).value.B, 1e-14);
}

TEST(PartitionScan, TheZeroIsTheSameWhicheverRuleIsFitted)
{
  const auto data = neutral_data(0.1);
  const auto size = synthetic::fit(data, "size"), drop = synthetic::fit(data, "drop");
  EXPECT_EQ(size.line.p_zero.value, drop.line.p_zero.value);
  EXPECT_EQ(size.line.dB_dp.error.error, drop.line.dB_dp.error.error);
}

TEST(PartitionScan, TheSlopeAtTheZeroIsThatOfBOfPartsAtTheGrainsToo)
{
  const auto data = at_centres();
  const auto b_at = [&](double share) { return fit_rule(data, uniform(share), {}).value.B; };
  const auto line = line_over_share(data, {}, Population::windows);
  const double zero = line.p_zero.value;
  constexpr double step = 1e-5;
  EXPECT_NEAR(b_at(zero), 0, 1e-12);
  EXPECT_NEAR(line.dB_dp.value, (b_at(zero + step) - b_at(zero - step)) / (2 * step), 1e-7);
}

TEST(PartitionScan, BIsAStraightLineOverTheShare)
{
  const auto data = neutral_data(0.1);
  const auto line = line_over_share(data, {}, Population::windows);
  for (const double share : {0.0, 0.4, 1.0})
    EXPECT_NEAR(fit_rule(data, uniform(share), {}).value.B,
                line.dB_dp.value * (share - line.p_zero.value), 1e-12);
  const auto half = fit_rule(data, parse_rule("half"), {});
  EXPECT_NEAR(half.value.B, line.dB_dp.value * (half.share - line.p_zero.value), 1e-12);
}

TEST(PartitionScan, TheIntervalOfTheZeroHoldsIt)
{
  const auto data = neutral_data(0.2);
  const auto scan = scan_partition(data, parse_scan("0.5:0.8:0.01"), {});
  EXPECT_LT(scan.line.p_zero.estimate().low, scan.line.p_zero.value);
  EXPECT_GT(scan.line.p_zero.estimate().high, scan.line.p_zero.value);
}

// dB = dB/dp dp: the interval of the zero times the slope is the interval of B there.
TEST(PartitionScan, TheIntervalOfTheZeroIsThatOfBOverItsSlope)
{
  const auto data = neutral_data(0.2);
  const auto scan = scan_partition(data, parse_scan("0.5:0.8:0.01"), {});
  const auto at_zero = fit_rule(data, uniform(scan.line.p_zero.value), {});
  EXPECT_NEAR(at_zero.value.B, 0, 1e-12);
  const auto interval = scan.line.p_zero.estimate();
  EXPECT_NEAR(
      (interval.high - interval.low) * scan.line.dB_dp.value / (at_zero.high.B - at_zero.low.B), 1,
      0.01);
}

// B(p) is the same in all windows of three runs, of which one has four times as many frames.
TEST(PartitionScan, RunsThatDifferInWeightAloneHaveASlopeWithoutError)
{
  std::vector<Table> tables;
  for (const int frames : {10, 40, 20}) {
    auto rows = neutral_rows(0, 2, 10);
    for (auto& row : rows) {
      row.frames = frames;
      // Another pressure makes it another run.
      for (const std::size_t species : {0, 1})
        row.sums.of(OwnSum::inside, species) *= 1 + 0.01 * frames;
      for (const auto part : {PairSum::whole, PairSum::by_size, PairSum::up_to_contact})
        row.sums.of(part, 0) *= 1 + 0.01 * frames;
    }
    tables.push_back(stress_table(rows));
  }
  const auto data = read(tables);
  const auto line = line_over_share(data, {}, Population::runs);
  const auto slope = line.dB_dp.estimate();
  EXPECT_NEAR(slope.high - slope.low, 0, 1e-9 * line.dB_dp.value);
}

/// 48 windows of seven layers of neutral contacts; each type of contact scatters by two per cent.
FitData scattered_neutral_data(synthetic::Ar1& noise)
{
  std::vector<synthetic::TableRow> rows;
  for (const double phi : synthetic::compositions) {
    const Eigen::MatrixX3d normal = noise.series({48, 48, 48}, 0).reshaped(48, 3);
    for (Eigen::Index window = 0; window < 48; ++window) {
      auto sums = synthetic::neutral_sums(phi, 2);
      sums.of(OwnSum::inside, 1) *= 1 + 0.02 * normal(window, 0);
      sums.of(OwnSum::inside, 0) *= 1 + 0.02 * normal(window, 1);
      sums.of(PairSum::whole, 0) *= 1 + 0.02 * normal(window, 2);
      rows.push_back(
          {1. * static_cast<double>(window), 1. + static_cast<double>(window), 25, sums});
    }
  }
  return read({stress_table(rows)});
}

// Three standard deviations of 300 trials below 93 % and above 97 %.
TEST(PartitionScan, TheIntervalsOfZeroAndSlopeHoldTheTruth)
{
  const auto known = neutral_data(0);
  const double slope = scan_partition(known, parse_scan("0.6:0.7:0.1"), {}).line.dB_dp.value;
  synthetic::Ar1 noise(0.5);
  double zero_held = 0, slope_held = 0;
  for (unsigned k = 1; k <= 300; ++k) {
    const auto data = scattered_neutral_data(noise);
    const auto scan = scan_partition(data, parse_scan("0.6:0.7:0.1"), {});
    zero_held += synthetic::holds(scan.line.p_zero.estimate(), 2. / 3) / 300.;
    slope_held += synthetic::holds(scan.line.dB_dp.estimate(), slope) / 300.;
  }
  for (const double held : {zero_held, slope_held}) {
    EXPECT_GT(held, 0.93 - 3 * std::sqrt(0.93 * 0.07 / 300));
    EXPECT_LE(held, 0.97 + 3 * std::sqrt(0.97 * 0.03 / 300));
  }
}

TEST(PartitionScan, ARangeWithoutTheZeroKnowsItAllTheSame)
{
  const auto data = neutral_data(0);
  const auto scan = scan_partition(data, parse_scan("0.7:0.9:0.1"), {});
  EXPECT_NEAR(scan.line.p_zero.value, 2. / 3, 1e-12);
}

// Without mixed contacts no share changes anything.
TEST(PartitionScan, WithoutMixedContactsThereIsNoZero)
{
  const auto data = read({stress_table(
      {{0, 1, 10,
        synthetic::separate_sums(0.3, synthetic::any_tensor(), synthetic::any_tensor())}})});
  const auto line = line_over_share(data, {}, Population::windows);
  EXPECT_TRUE(std::isnan(line.p_zero.value) && std::isnan(line.dB_dp.value));
}

TEST(PartitionScan, SharesAreExactAndIncludeTheLast)
{
  const auto shares = parse_scan("0.4:0.9:0.005").shares();
  ASSERT_EQ(shares.size(), 101u);
  EXPECT_EQ(shares[40], 0.6);
  EXPECT_EQ(shares[100], 0.9);
  EXPECT_EQ(parse_scan("0:0.3:0.1").shares().size(), 4u);  // 0.3/0.1 is below 3 in binary
  for (const char* wrong : {"0.4:0.9", "0.4:0.9:0", "0.9:0.4:0.1", "0:1.1:0.1", "a:b:c", "0:1:0.1x",
                            "0:1:1e-9", "nan:1:0.1", "0.4:0.9:inf"})
    EXPECT_THROW(parse_scan(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace grseg
