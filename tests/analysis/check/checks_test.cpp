// SPDX-License-Identifier: GPL-3.0-or-later
// Table of checks, comparison of a measurement with its tolerance, and drifts over a run.
#include "analysis/check/checks.hpp"

#include "analysis/check/physics_check.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace grseg {
namespace {

using checks::named;
namespace fs = std::filesystem;

/// Text of docs/**/check.md.
std::string document()
{
  for (const auto& entry : fs::recursive_directory_iterator(GRSEG_DOCS))
    if (entry.path().filename() == "check.md") {
      std::ifstream file(entry.path());
      return std::string(std::istreambuf_iterator<char>(file), {});
    }
  return "";
}

TEST(Checks, HaveNamesOfTheirOwn)
{
  std::set<std::string> names;
  for (const auto& check : checks::all) EXPECT_TRUE(names.insert(check.name).second) << check.name;
}

TEST(Checks, AreExplainedInTheDocumentWithTheirTolerance)
{
  const auto text = document();
  ASSERT_FALSE(text.empty());
  for (const auto& check : checks::all) {
    std::string name = check.name;
    for (const std::string suffix : {"_largest", "_mean"})
      if (name.ends_with(suffix)) name.resize(name.size() - suffix.size());
    EXPECT_NE(text.find(fmt::format("`{}`", name)), std::string::npos) << name;
    const auto option = fmt::format("`--{}`", CheckTolerances::option_of(check.tolerance));
    if (check.tolerance != &CheckTolerances::round_off) {
      EXPECT_TRUE(text.find(option.substr(0, option.size() - 1)) != std::string::npos) << option;
    }
  }
}

TEST(Checks, AreListedInTheHelpWithTheirTolerance)
{
  const auto text = checks::listed();
  EXPECT_NE(text.find("  x_drift "), std::string::npos);
  EXPECT_NE(text.find("   --largest-approach; Newton's law of restitution\n"), std::string::npos);
}

TEST(CheckTolerances, RefuseNegativeValuesAndProbabilitiesOfOne)
{
  CheckTolerances tolerances;
  EXPECT_NO_THROW(tolerances.require_valid());
  tolerances.weight = -1;
  EXPECT_THROW(tolerances.require_valid(), UsageError);
  tolerances.weight = 0;
  EXPECT_NO_THROW(tolerances.require_valid());
  tolerances.false_alarm = 1;
  EXPECT_THROW(tolerances.require_valid(), UsageError);
}

TEST(Judge, FailsTheLargestValueBeyondTheToleranceAndNamesItsPlace)
{
  WorstCase worst;
  worst.add(0.2, 1.5, 7);
  worst.add(0.6, 2.5, 9);
  const Judge judge({}, false);
  const auto line = judge.largest(named("overlap_largest"), worst, "contact", 2);
  EXPECT_EQ(line.quantity, "overlap_largest");
  EXPECT_DOUBLE_EQ(line.measured, 0.3);
  EXPECT_EQ(line.tolerance, 0.1);
  EXPECT_EQ(line.verdict, Verdict::failed);
  EXPECT_EQ(line.remark, "at t = 2.5 s, contact 9");
  EXPECT_EQ(judge.largest(named("overlap_largest"), worst, "contact", 6).verdict, Verdict::passed);
  EXPECT_DOUBLE_EQ(judge.mean(named("overlap_mean"), worst, 2).measured, 0.2);
}

TEST(Judge, AllowsMoreRoundOffInSinglePrecisionAndOnlyRoundOff)
{
  WorstCase worst;
  worst.add(1e-7, 0, 0);
  EXPECT_EQ(Judge({}, false).largest(named("force_balance"), worst, "").verdict, Verdict::failed);
  EXPECT_EQ(Judge({}, true).largest(named("force_balance"), worst, "").verdict, Verdict::passed);
  EXPECT_EQ(Judge({}, true).largest(named("overlap_largest"), worst, "").tolerance, 0.1);
}

// Student's t with 2 degrees of freedom exceeds 31.599 with the probability 0.0005 on either side. The
// deviation is smaller, but an error as large as the tolerance could not have been seen: not passed.
TEST(Judge, LeavesOpenWhatChanceAloneExplainsAndFailsWhatItDoesNot)
{
  const Judge judge({}, false);
  const auto line = judge.statistical(named("weight"), -0.3, 0.01, 3, 1);
  EXPECT_NEAR(line.tolerance, 31.599 * 0.01, 1e-5);
  EXPECT_EQ(line.measured, 0.3);
  EXPECT_EQ(line.error, 0.01);
  EXPECT_EQ(line.verdict, Verdict::undecided);
  EXPECT_EQ(judge.statistical(named("weight"), -0.32, 0.01, 3, 1).verdict, Verdict::failed);
  EXPECT_EQ(judge.statistical(named("weight"), -0.32, 0.01, 3, 2).verdict, Verdict::undecided);
  // With a hundredth of that error: 0.00316 by chance, less than the tolerance of 0.01.
  const auto precise = judge.statistical(named("weight"), 0.009, 0.0001, 3, 1);
  EXPECT_EQ(precise.tolerance, 0.01);
  EXPECT_EQ(precise.verdict, Verdict::passed);
  EXPECT_EQ(judge.statistical(named("weight"), 0.011, 0.0001, 3, 1).verdict, Verdict::failed);
  // The verdict does not depend on a small deviation if chance alone may exceed the tolerance.
  EXPECT_EQ(judge.statistical(named("weight"), 0.001, 0.01, 3, 1).verdict, Verdict::undecided);
}

TEST(CheckReport, NamesWhatIsUndecidedWithTheNumberOfItsLayersAndCountsIt)
{
  CheckReport report;
  EXPECT_EQ(report.undecided(), "");
  const Judge judge({}, false);
  for (int layer = 0; layer < 3; ++layer)
    report.lines.push_back(judge.statistical(named("weight"), 0, 0.01, 3, 1));
  report.lines.push_back(judge.statistical(named("x_drift"), 0, 0.01, 3, 1));
  report.lines.push_back(judge.statistical(named("slope"), 0, 0, 3, 1));
  EXPECT_EQ(report.undecided(),
            "undecided, because chance alone can exceed the tolerance: weight (3 layers), "
            "x_drift; a longer run decides");
  EXPECT_EQ(report.failures(), "");
  EXPECT_NE(to_json(report).find("\"undecided\": 4"), std::string::npos);
  EXPECT_NE(to_tsv(report).find("\tundecided\t"), std::string::npos);
}

TEST(Drift, OfALineIsItsSlopeTimesItsLengthWithoutError)
{
  const auto [change, error] = change_over({1, 2, 4}, {5, 3, -1});
  EXPECT_NEAR(change, -6, 1e-13);
  EXPECT_NEAR(error, 0, 1e-7);
}

// Mean 2, variance (4 + 0 + 4)/2, standard error 2/sqrt(3).
TEST(Drift, AMeanHasTheStandardErrorOfIndependentValues)
{
  const auto [mean, error] = mean_of({0, 2, 4});
  EXPECT_NEAR(mean, 2, 1e-15);
  EXPECT_NEAR(error, 2 / std::sqrt(3.0), 1e-15);
}

TEST(Drift, MeansOfWindowsComeFromTheSumsAtTheirBeginnings)
{
  const WindowMeans means(
      {{.time = 0},
       {.time = 2, .stray = 1, .overlap = 6, .overlaps = 3, .energy_defect = 8, .frames = 4},
       {.time = 6, .stray = 3, .overlap = 6, .overlaps = 3, .energy_defect = 9, .frames = 6}});
  EXPECT_EQ(means.time, (std::vector<double>{1, 4}));
  EXPECT_EQ(means.overlap, (std::vector<double>{2, 0}));
  EXPECT_EQ(means.energy_defect, (std::vector<double>{2, 0.5}));
  EXPECT_EQ(means.stray_rate, (std::vector<double>{0.5, 0.5}));
}

}  // namespace
}  // namespace grseg
