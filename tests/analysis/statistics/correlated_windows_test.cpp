// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/analysis/correlated_windows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

using namespace synthetic;

/// Error of a sum over windows of equal weight.
Deviation of_equal(const Eigen::VectorXd& influence, const RunLengths& runs)
{
  return deviation_of_windows(influence, Eigen::VectorXd::Ones(influence.size()), runs);
}

/// cos(pi j (k + 1/2)/n) for k = 0 ... n - 1, and a quick wave that makes neighbours unlike.
Eigen::VectorXd wave(int j, Eigen::Index n)
{
  Eigen::VectorXd values(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double phase = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    values[k] = std::cos(j * phase) + 1.2 * std::cos(static_cast<double>(n - 1) * phase);
  }
  return values;
}

// Two independent windows that differ by 2 have the variance 2; their sum has twice that, with one
// degree of freedom.
TEST(ErrorOverWindows, OfTwoWindowsIsThatOfStudent)
{
  const auto error = of_equal(Eigen::Vector2d(1, -1), {2}).error();
  EXPECT_NEAR(error.error, 2, 1e-14);
  EXPECT_NEAR(error.degrees, 1, 1e-14);
}

// 64 windows: J = 64^(2/3)/4 = 4 waves, each with a sum of squares of 32. A series that contains one
// of them has the variance 2/4 x 32^2; a quicker wave has none, nor has a constant.
TEST(ErrorOverWindows, IsTheMeanSquareOfTheSlowestWaves)
{
  for (const int j : {1, 2, 3, 4}) {
    const auto error = of_equal(wave(j, 64), {64}).error();
    EXPECT_NEAR(error.error, std::sqrt(512), 1e-11) << j;
    EXPECT_NEAR(error.degrees, 4, 1e-12);
  }
  EXPECT_NEAR(of_equal(wave(5, 64), {64}).error().error, 0, 1e-11);
  EXPECT_NEAR(of_equal(Eigen::VectorXd::Ones(64), {64}).error().error, 0, 1e-11);
}

// 27 windows: J = 9/4. The third wave counts by a quarter: its series has the variance 2/J x 1/4 x
// (27/2)^2, and there are J^2/(1 + 1 + 1/16) degrees of freedom.
TEST(ErrorOverWindows, CountsTheLastWaveByTheFractionOfTheirNumber)
{
  const auto error = of_equal(wave(3, 27), {27}).error();
  EXPECT_NEAR(error.error, std::sqrt(2 / 2.25 * 0.25 * 13.5 * 13.5), 1e-11);
  EXPECT_NEAR(error.degrees, 2.25 * 2.25 / (2 + 1. / 16), 1e-12);
}

// One slow wave alone: its neighbours are alike. In four waves an AR(1) series of their correlation
// would keep the mean of (1 - rho)^2/(1 - 2 rho cos(pi j/64) + rho^2) over j = 1 ... 4.
TEST(ErrorOverWindows, IsDividedByWhatTheWavesKeepOfACorrelatedSeries)
{
  constexpr Eigen::Index n = 64;
  Eigen::VectorXd slow(n);
  for (Eigen::Index k = 0; k < n; ++k)
    slow[k] = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / n);
  const double c = slow.head(n - 1).dot(slow.tail(n - 1)) / slow.squaredNorm();
  const double rho = std::min((n * c + 1) / (n - 3), 1 - 2. / n);
  double kept = 0;
  for (int j = 1; j <= 4; ++j)
    kept +=
        (1 - rho) * (1 - rho) / (1 - 2 * rho * std::cos(std::numbers::pi * j / n) + rho * rho) / 4;
  EXPECT_LT(kept, 0.5);
  EXPECT_NEAR(of_equal(slow, {n}).error().error, std::sqrt(512 / kept), 1e-9);
}

// A fit to composition that took the first wave whole leaves no noise in it: the next four count. If it
// took half of it, that wave is worth a half, and the fifth one makes up for the rest: J = 4, and degrees
// J^2/(1/4 + 3 + 1/4).
TEST(ErrorOverWindows, DividesByTheNoiseThatAFitToCompositionLeft)
{
  Eigen::VectorXd first(64);
  for (Eigen::Index k = 0; k < 64; ++k)
    first[k] = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / 64);
  const auto error = [&](int j, double part) {
    return deviation_of_windows(wave(j, 64), Eigen::VectorXd::Ones(64), {64},
                                std::sqrt(part / 32) * first)
        .error();
  };
  EXPECT_NEAR(error(5, 0).error, 0, 1e-11);
  EXPECT_NEAR(error(5, 1).error, std::sqrt(512), 0.2);
  EXPECT_NEAR(error(1, 0.5).error, std::sqrt(512), 1e-11);
  EXPECT_NEAR(error(5, 0.5).error, std::sqrt(256), 1e-11);
  EXPECT_NEAR(error(5, 0.5).degrees, 16 / 3.5, 1e-12);
}

// Runs of 64 and 8 windows have 4 waves and 1: degrees 72^2/(64^2/4 + 8^2/1). What a whole run is
// off by is no noise of its windows.
TEST(ErrorOverWindows, OfSeveralRunsIsTheSumOfTheirSquares)
{
  Eigen::VectorXd both(72);
  both << wave(1, 64), wave(1, 8);
  both.head(64).array() += 3;
  const auto error = of_equal(both, {64, 8}).error();
  EXPECT_NEAR(error.error, std::sqrt(512 + 2 * 16), 1e-11);
  EXPECT_NEAR(error.degrees, 72. * 72 / (1024 + 64), 1e-12);
}

// A window of twice the weight lasts twice as long: its two halves are nearly the same series.
TEST(ErrorOverWindows, PlacesTheWavesByTheWeightOfTheWindows)
{
  const Eigen::VectorXd fine = Ar1(0.9).series(400);
  Eigen::VectorXd weight(300), joined(300);
  for (Eigen::Index k = 0; k < 300; ++k) {
    weight[k] = k < 100 ? 2 : 1;
    joined[k] = k < 100 ? fine[2 * k] + fine[2 * k + 1] : fine[k + 100];
  }
  const auto waves = [](const Deviation& of) -> Eigen::VectorXd {
    return of.parts.head(10).normalized();
  };
  EXPECT_LT(
      (waves(deviation_of_windows(joined, weight, {300})) - waves(of_equal(fine, {400}))).norm(),
      0.01);
}

// The variance of a sum over n windows of an AR(1) series is n (1 + rho)/(1 - rho). 20000 windows
// have 184 waves, so the error is known to 1/sqrt(2 x 184) = 5 %; the tolerance is three times that.
TEST(ErrorOverWindows, GrowsWithTheRootOfTheCorrelationTime)
{
  for (const double rho : {0.0, 0.5, 0.8}) {
    const auto error = of_equal(Ar1(rho).series(20000), {20000}).error();
    EXPECT_NEAR(error.error / std::sqrt(20000 * (1 + rho) / (1 - rho)), 1, 0.16) << rho;
  }
}

// Windows of the same frames, two or four times as long: waves are the same but for what a window
// averages over, sin(x)/x with x = pi j/(2 n), and so are interval and error.
TEST(ErrorOverWindows, ChangesSmoothlyWithTheLengthOfTheWindows)
{
  const Eigen::VectorXd fine = Ar1(0.95).series(480);
  double last = of_equal(fine, {480}).error().error;
  for (const Eigen::Index length : {2, 4, 8}) {
    const Eigen::VectorXd longer = fine.reshaped(length, 480 / length).colwise().sum();
    const double error = of_equal(longer, {static_cast<std::size_t>(longer.size())}).error().error;
    EXPECT_NEAR(error / last, 1, 0.35) << length;
    last = error;
  }
}

TEST(ErrorOverWindows, OneWindowHasNone)
{
  EXPECT_TRUE(std::isnan(of_equal(Eigen::VectorXd::Ones(1), {1}).error().error));
  EXPECT_TRUE(std::isnan(mean_over_windows(Eigen::VectorXd::Ones(1), {1}).estimate().low));
}

/// Number of trials; coverage is the share of those in which an interval contains the truth.
constexpr int trials = 500;

/// Bounds of an observed coverage if the true one is 93 to 97 %: three standard deviations of the
/// binomial distribution on either side.
constexpr double trial_count = trials;
const double least = 0.93 - 3 * std::sqrt(0.93 * 0.07 / trial_count);  // 0.896
const double most = 0.97 + 3 * std::sqrt(0.97 * 0.03 / trial_count);   // 0.993

// tau = (1 + rho)/(1 - rho); the estimate from 20000 windows is accurate to a few per cent.
TEST(Autocorrelation, TimeOfAFirstOrderSeriesIsTheKnownOne)
{
  for (const double rho : {0.0, 0.5, 0.8})
    EXPECT_NEAR(autocorrelation_time(Ar1(rho).series(20000), {20000}) * (1 - rho) / (1 + rho), 1,
                0.15);
}

TEST(Autocorrelation, TwoRunsOfDifferentMeanAreNotTakenForOneCorrelatedRun)
{
  Eigen::VectorXd both = Ar1(0).series(400);
  both.head(200).array() += 5;
  EXPECT_LT(autocorrelation_time(both, {200, 200}), 1.5);
  EXPECT_GT(autocorrelation_time(both, {400}), 20);
}

TEST(Autocorrelation, AnAlternatingOrConstantSeriesCountsAsIndependent)
{
  Eigen::VectorXd alternating(100);
  for (Eigen::Index k = 0; k < 100; ++k) alternating[k] = k % 2 == 0 ? 1 : -1;
  EXPECT_EQ(autocorrelation_time(alternating, {100}), 1);
  EXPECT_EQ(autocorrelation_time(Eigen::VectorXd::Ones(100), {100}), 1);
}

TEST(Coverage, OfTheMeanOfAHundredAndTwentyWindowsIsAsSaid)
{
  for (const double rho : {0.0, 0.5, 0.8}) {
    Ar1 noise(rho);
    double share = 0;
    for (int k = 0; k < trials; ++k)
      share += holds(mean_over_windows(noise.series(120), {120}).estimate(), 0) / trial_count;
    EXPECT_GT(share, least) << rho;
    EXPECT_LT(share, most) << rho;
  }
}

TEST(Coverage, OfTheStrengthOfSegregationIsThatOfAMean)
{
  Ar1 noise(0.8);
  const double truth = ScatteredStress::truth(0).B;
  double share = 0;
  for (int k = 0; k < trials; ++k) {
    const auto fit = fit_rule(ScatteredStress::windows({120}, 0, noise), {}, {});
    share += holds(fit.estimate(&Estimators::B), truth) / trial_count;
  }
  EXPECT_GT(share, least);
  EXPECT_LT(share, most);
}

// While layers segregate, their compositions drift. If B depends on composition, so do the values
// of the windows. This trend is not noise: the error is that of the scatter of B.
TEST(Coverage, OfAFlowThatSegregatesIsThatOfASteadyOne)
{
  Ar1 noise(0.5);
  const auto known = ScatteredStress::drifting(120, nullptr);
  const double truth = estimators_of(fit_points(known, {}, {})).B;
  double share = 0, error = 0, squares = 0;
  for (int k = 0; k < trials; ++k) {
    const auto fit = fit_rule(ScatteredStress::drifting(120, &noise), {}, {});
    share += holds(fit.estimate(&Estimators::B), truth) / trial_count;
    error += fit.error.B / trial_count;
    squares += (fit.value.B - truth) * (fit.value.B - truth) / trial_count;
  }
  EXPECT_GT(share, least);
  EXPECT_LT(share, most);
  EXPECT_NEAR(error / std::sqrt(squares), 1, 0.2);
}

// Twelve windows of an alternating series are not correlated. A random walk is, for as long as it
// lasts.
TEST(DoubtOfWindows, IsVoicedWhereTheyAreCorrelatedForLong)
{
  const auto doubt = [](const Eigen::VectorXd& noise, const RunLengths& runs) {
    return doubt_of_windows(noise, Eigen::VectorXd::Ones(noise.size()), runs);
  };
  EXPECT_EQ(doubt(Ar1(0).series(24), {24}), "");
  EXPECT_EQ(doubt(Ar1(0.5).series(120), {120}), "");
  EXPECT_NE(doubt(Ar1(0.97).series(120), {120}).find("long for 120 windows in 1 run:"),
            std::string::npos);
  EXPECT_NE(doubt(Ar1(0.9).series({12, 12, 12, 12}, 0), {12, 12, 12, 12})
                .find("long for 48 windows in 4 runs:"),
            std::string::npos);
}

TEST(DoubtOfWindows, IsVoicedWhereTheyAreFew)
{
  EXPECT_EQ(
      doubt_of_windows(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1), {1}),
      "one window is one observation, too few for an interval; make more with a shorter --window");
  EXPECT_TRUE(doubt_of_windows(Ar1(0).series(11), Eigen::VectorXd::Ones(11), {11})
                  .starts_with("11 windows do not show how long they are correlated"));
}

TEST(DoubtOfRuns, IsVoicedWhereRunsAreTooFew)
{
  EXPECT_EQ(
      doubt_of_runs(Eigen::Vector2d(48, 48)),
      "2 runs, worth 2 of equal weight, show little of how runs differ; more runs, of other seeds, give a "
      "narrower interval");
  EXPECT_EQ(doubt_of_runs(Eigen::Vector4d::Ones()), "");
  EXPECT_DOUBLE_EQ(effective_number(Eigen::Vector3d(2, 2, 1)), 25. / 9);
}

}  // namespace
}  // namespace grseg
