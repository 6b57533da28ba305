// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_data.hpp"

#include "analysis/fit/data_doubts.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::any_tensor;
using synthetic::compositions;
using synthetic::fit;
using synthetic::holds;
using synthetic::neutral_rows;
using synthetic::neutral_sums;
using synthetic::read;
using synthetic::sentence_of;
using synthetic::separate_sums;
using synthetic::stress_table;
using synthetic::TableRow;

TEST(FitData, AWeightIsFramesTimesGrainsOfTheRarerSpecies)
{
  const auto data =
      read({stress_table({{0, 1, 10, neutral_sums(0.2, 2)}, {0, 1, 30, neutral_sums(0.9, 2)}})});
  // The weight is the number of grains of the rarer species per small area: phi_L/4 = 0.05 against
  // 0.8 in the first sample; phi_S = 0.1 against 0.225 in the second.
  EXPECT_NEAR(data.samples[1].weight / data.samples[0].weight, 3 * 0.1 / 0.05, 1e-12);
  EXPECT_NEAR(data.samples[0].phi_large, 0.2, 1e-15);
  EXPECT_EQ(data.samples[0].size_ratio, 2);
}

TEST(FitData, LayersOfOneWindowShareItAndRunsFollowOneAnother)
{
  const auto sums = neutral_sums(0.3, 2);
  const auto a = stress_table({{0, 1, 9, sums}, {0, 1, 9, sums}, {1, 2, 9, sums}});
  const auto b = stress_table({{1, 2, 9, neutral_sums(0.4, 2)}, {0, 1, 9, neutral_sums(0.41, 2)}});
  const auto data = read({a, b});
  EXPECT_EQ(data.runs, (RunLengths{2, 2}));
  std::vector<std::size_t> windows;
  for (const auto& sample : data.samples) windows.push_back(sample.window);
  EXPECT_EQ(windows, (std::vector<std::size_t>{0, 0, 1, 3, 2}));
}

/// Table of windows of a run with this history, from time `begin` on.
Table table_of_run(const std::vector<std::string>& history, int begin, double noise)
{
  std::vector<TableRow> rows;
  for (int k = begin; k < begin + 10; ++k) {
    auto sums = neutral_sums(0.4, 2);
    sums.of(OwnSum::inside, 1) *= 1 + noise * synthetic::scatter(static_cast<std::size_t>(k));
    rows.push_back({1.0 * k, k + 1.0, 9, sums});
  }
  auto table = stress_table(rows);
  for (const auto& line : history) table.header.emplace_back("history", line);
  table.header.emplace_back("history", "grseg-stress");
  table.header.emplace_back("input", "xxh3 " + history.back() + std::to_string(noise));
  return table;
}

// The order of the files and their digests have no effect.
TEST(FitData, ARunAndItsContinuationAreOneRunWithItsWindowsInLine)
{
  const auto early = table_of_run({"grseg-sim a.ini"}, 0, 0.1);
  const auto late = table_of_run({"grseg-sim a.ini", "grseg-sim --restart a.chk"}, 10, 0.1);
  const auto data = read({late, early});
  EXPECT_EQ(data.runs, (RunLengths{20}));
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(data.samples[k].window, (k + 10) % 20);
  const auto other = table_of_run({"grseg-sim b.ini"}, 0, 0.2);
  EXPECT_EQ(read({late, early, other}).runs, (RunLengths{20, 10}));
}

// Equivalent to twice as many layers per window: the interval is that of one of the two tables.
TEST(FitData, ATwinAddsNoObservations)
{
  const std::string twin = "grseg-sim --restart a.chk --perturb 1e-6 --seed-perturbation ";
  const auto a = table_of_run({"grseg-sim a.ini", twin + "1"}, 0, 0.1);
  const auto b = table_of_run({"grseg-sim a.ini", twin + "2"}, 0, 0.10001);
  const auto both = read({a, b}), one = read({a});
  EXPECT_EQ(both.runs, (RunLengths{10}));
  EXPECT_EQ(both.samples.size(), 20u);
  const auto width = [](const FitData& data) {
    const auto fit = fit_rule(data, {}, {});
    return fit.high.B - fit.low.B;
  };
  EXPECT_NEAR(width(both) / width(one), 1, 0.01);
}

TEST(FitData, AMeanOfRunsOfSeveralSeedsIsDoubted)
{
  auto table = table_of_run({"grseg-sim a.ini"}, 0, 0.1);
  const auto doubts = [&] {
    const std::vector<Table> tables{table};
    return doubts_of_tables(tables, synthetic::read_all(tables), read(tables));
  };
  EXPECT_TRUE(doubts().empty());
  std::erase_if(table.header, [](const HeaderLine& line) {
    return line.first == "history" || line.first == "input";
  });
  for (const char* seed : {"1", "2"}) {
    table.header.emplace_back("history", fmt::format("grseg-sim a.ini --seed {}", seed));
    table.header.emplace_back("input", fmt::format("xxh3 {}", seed));
    table.header.emplace_back("bed", fmt::format("grains 3, sizes 3, crc32 {0}, seed {0}", seed));
  }
  const auto found = doubts();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(synthetic::holds(found[0], "is the mean of 2 runs of other seeds")) << found[0];
}

TEST(FitData, HorizontalLayersOfADrumAreDoubtedAndItsAnnuliAreNot)
{
  auto table = table_of_run({"grseg-sim a.ini"}, 0, 0.1);
  table.header.emplace_back("scene", "spread = 0; geometry = drum; fill = 0.4");
  const auto doubts = [&] {
    const std::vector<Table> tables{table};
    return doubts_of_tables(tables, synthetic::read_all(tables), read(tables));
  };
  const auto found = doubts();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(synthetic::holds(found[0], "has horizontal layers of a drum")) << found[0];
  table.header.emplace_back("bins", "radius");
  EXPECT_TRUE(doubts().empty());
}

TEST(FitData, WindowsInWhichNothingMovesAreOneObservationWithoutAnInterval)
{
  const auto still = table_of_run({"grseg-sim a.ini"}, 0, 1e-9);
  const auto data = read({still});
  EXPECT_EQ(data.runs, (RunLengths{1}));
  EXPECT_EQ(data.still, 9u);
  EXPECT_EQ(data.samples.size(), 10u);
  const auto fit = fit_rule(data, {}, {});
  EXPECT_TRUE(std::isnan(fit.low.B) && std::isnan(fit.high.B));
  EXPECT_EQ(
      fit.doubt,
      "one window is one observation, too few for an interval; make more with a shorter --window");
}

TEST(FitData, EachFilterCountsWhatItRemoves)
{
  auto rows = std::vector<TableRow>(5, {2, 3, 9, neutral_sums(0.5, 2)});
  rows.push_back({0, 1, 9, neutral_sums(0.5, 2)});        // too early
  rows.push_back({8, 9, 9, neutral_sums(0.5, 2)});        // too late
  rows.push_back({2, 3, 9, neutral_sums(0.5, 2, 0.39)});  // thin: below half of 0.8
  rows.push_back({2, 3, 9, neutral_sums(0.5, 2, 0.41)});  // just above half of 0.8
  rows.push_back({2, 3, 9, neutral_sums(0.005, 2)});      // x = 199
  rows.push_back({2, 3, 9, separate_sums(0, any_tensor(), Tensor2::Zero())});
  rows.push_back({2, 3, 9, separate_sums(1, Tensor2::Zero(), any_tensor())});
  ContactSums<2> nothing;
  nothing.volume = 1;
  rows.push_back({2, 3, 9, nothing});
  const auto data = read({stress_table(rows)}, {{.begin = 2, .end = 8}});
  EXPECT_EQ(data.count.sentence(),
            "13 rows, 2 outside --begin and --end, 1 without grains, 1 without small grains, 1 "
            "without large grains, 1 outside --ratio-range, 1 below --min-solid");
  EXPECT_EQ(data.count.used, 6u);
  EXPECT_EQ(data.samples.size(), 6u);
}

TEST(FitData, LayersTakePartThatLieWhollyBetweenTheHeights)
{
  std::vector<TableRow> rows;
  for (int layer = 0; layer < 4; ++layer)
    rows.push_back({0, 1, 9, neutral_sums(0.5, 2), 0.02 * layer, 0.02 * (layer + 1)});
  const auto used = [&](const char* heights) {
    return read({stress_table(rows)}, {{.heights = heights}}).count.used;
  };
  EXPECT_EQ(used("all"), 4u);
  EXPECT_EQ(used(":"), 4u);
  EXPECT_EQ(used("4dS:"), 3u);
  EXPECT_EQ(used("4dS:12dS"), 2u);
  EXPECT_EQ(used(":0.059m"), 2u);
  const auto sentence = sentence_of<RunError>({stress_table(rows)}, {{.heights = "1m:"}});
  EXPECT_TRUE(holds(sentence, "4 outside --heights"));
  EXPECT_THROW(used("4:five"), UsageError);
  EXPECT_THROW(used("4dS"), UsageError);
}

/// A bed of ten layers that loses its upper five before the time 1 s, and half of the grains of the
/// others.
Table emptied_bed()
{
  std::vector<TableRow> rows;
  for (int window = 0; window < 4; ++window)
    for (int k = 0; k < (window < 2 ? 10 : 5); ++k) {
      const double solid = window < 2 ? 0.8 : 0.4;
      const auto sums = neutral_sums(0.3 + 0.05 * k, 2, solid);
      rows.push_back({0.5 * window, 0.5 * window + 0.5, 9, synthetic::moved(sums, window), 0.01 * k,
                      0.01 * (k + 1)});
    }
  return stress_table(rows);
}

// After 1 s the bed is 0.05 m high and uniform: `inside` is from 0.02 to 0.03 m.
TEST(FitData, SurfaceAndMedianAreOfTheTimesThatAreFitted)
{
  const auto all = emptied_bed();
  auto late = all;
  std::erase_if(late.rows, [](const std::vector<double>& row) { return row[0] < 1; });
  FitFilters filters;
  filters.heights = "inside";
  filters.min_solid = 0.9;
  const auto of_late = read({late}, filters);
  ASSERT_EQ(of_late.samples.size(), 2u);
  filters.begin = 1;
  const auto of_all = read({all}, filters);
  ASSERT_EQ(of_all.samples.size(), 2u);
  EXPECT_EQ(of_all.samples[0].key.bottom, of_late.samples[0].key.bottom);
  EXPECT_DOUBLE_EQ(of_all.samples[0].key.bottom, 0.02);
}

TEST(FitData, WhereNothingIsLeftTheSentenceNamesTheFilter)
{
  const auto table = stress_table(neutral_rows(0));
  EXPECT_TRUE(holds(sentence_of<RunError>({table}, {{}, 500, 600}), "210 outside --ratio-range"));
  EXPECT_TRUE(holds(sentence_of<RunError>({table}, {{.min_solid = 1.5}}), "210 below --min-solid"));
  EXPECT_TRUE(holds(sentence_of<RunError>({table}, {{.begin = 1000}}), "--begin"));
  EXPECT_TRUE(holds(sentence_of<RunError>({stress_table({})}), "0 rows"));
}

TEST(FitData, AnEmptySpeciesIsNamed)
{
  const auto only_small =
      stress_table({{0, 1, 9, separate_sums(0, any_tensor(), Tensor2::Zero())}});
  const auto sentence = sentence_of<RunError>({only_small});
  EXPECT_TRUE(holds(sentence, "1 without large grains"));
  EXPECT_TRUE(holds(sentence, "both species"));
}

TEST(FitData, TheSameWindowsOfTheSameRunAreNotCountedTwice)
{
  auto early = stress_table({{0, 1, 9, neutral_sums(0.5, 2)}});
  auto late = stress_table({{1, 2, 9, neutral_sums(0.5, 2)}});
  early.header.emplace_back("input", "run.h5 0123456789abcdef");
  late.header.emplace_back("input", "run.h5 0123456789abcdef");
  EXPECT_EQ(sentence_of<UsageError>({early, late}), "");
  EXPECT_TRUE(holds(sentence_of<UsageError>({early, late, early}),
                    "both contain the time from 0 s of the same run"));
  auto between = stress_table({{0.5, 1.5, 9, neutral_sums(0.4, 2)}});
  EXPECT_EQ(sentence_of<UsageError>({early, between}), "");
  between.header.emplace_back("input", "run.h5 0123456789abcdef");
  EXPECT_TRUE(holds(sentence_of<UsageError>({early, between}), "of the same run (run.h5 0123"));
}

TEST(FitData, TheSameNumbersUnderAnotherDigestAreTheSameRun)
{
  auto a = stress_table({{0, 1, 9, neutral_sums(0.5, 2)}, {0, 1, 9, neutral_sums(0.4, 2)}});
  auto b = a;
  a.header.emplace_back("input", "xxh3 1");
  b.header.emplace_back("input", "xxh3 2");
  EXPECT_TRUE(holds(sentence_of<UsageError>({a, b}), "(all numbers are the same)"));
  b.rows[1][b.column("M_yy")] *= 1 + 1e-15;  // changed in its last bit
  EXPECT_EQ(sentence_of<UsageError>({a, b}), "");
}

TEST(FitData, NumbersThatCannotBeAreRefusedWithTheirRow)
{
  const auto good =
      stress_table({{0, 1, 9, neutral_sums(0.5, 2)}, {0, 1, 9, neutral_sums(0.4, 2)}});
  const auto refusal = [&](const std::string& column, double value) {
    auto table = good;
    table.rows[1][table.column(column)] = value;
    return sentence_of<FormatError>({table});
  };
  EXPECT_EQ(sentence_of<FormatError>({good}), "");
  for (const double volume : {0.0, -2.0})
    EXPECT_TRUE(holds(refusal("V", volume), "sums.tsv: row 2: a volume V of"));
  EXPECT_TRUE(holds(refusal("V", std::nan("")), "sums.tsv: row 2, column V[m^2]: nan"));
  EXPECT_TRUE(holds(refusal("area_S", -0.1),
                    "row 2, column area_S[m^2]: -0.10000000000000001 "
                    "should not be negative"));
  for (const double frames : {0.0, -1.0, 2.5})
    EXPECT_TRUE(holds(refusal("frames", frames), "row 2: "));
  EXPECT_TRUE(holds(refusal("t1", 0), "row 2: a window from 0 to 0 s"));
  EXPECT_TRUE(holds(refusal("y1", 0.01), "row 2: a layer from 0.0202 to 0.01 m"));
  EXPECT_TRUE(holds(refusal("M_yy", std::nan("")), "row 2, column M_yy[N m]"));
  for (const char* diameter : {"0", "-1", "nan", "0x1", "4dS"}) {
    auto table = good;
    table.header[1].second = diameter;
    EXPECT_TRUE(holds(sentence_of<FormatError>({table}), "'# small_diameter: ")) << diameter;
  }
}

TEST(FitData, ASumThatWasNotKeptIsRefusedWhereARuleNeedsIt)
{
  auto table = stress_table({{0, 1, 9, neutral_sums(0.5, 2)}, {0, 1, 9, neutral_sums(0.4, 2)}});
  const auto column = table.column("Mcp_yy");
  table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(column));
  for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
  EXPECT_TRUE(holds(sentence_of<FormatError>({table}), "no column 'Mcp_yy'"));
  table.header.emplace_back("not kept", "n_SS Mcp_yy");
  const auto data = read({table});
  EXPECT_GT(fit(data, "size").value.paper_s, 0);
  try {
    fit(data, "contact-point");
    ADD_FAILURE() << "the sum was made up";
  } catch (const FormatError& error) {
    EXPECT_TRUE(holds(error.what(), "sums.tsv: the stress (yy) by contact-point is not finite"));
  }
}

Table kinetic_table(double slope)
{
  Table table;
  table.name = "kinetic.tsv";
  table.header = {{"small_diameter", "0.005"}, {"large_diameter", "0.01"}};
  table.columns = {"t0[s]",      "t1[s]",      "y0[m]",     "y1[m]",     "frames",    "V[m^2]",
                   "mass_S[kg]", "mass_L[kg]", "K_S_xx[J]", "K_S_yy[J]", "K_L_xx[J]", "K_L_yy[J]"};
  double bottom = 0;
  for (const double phi : compositions) {
    table.rows.push_back({0, 1, bottom, bottom + 0.02, 25, 2, 1 - phi, phi, 9 * (1 - phi),
                          slope * (1 - phi), phi, phi});
    bottom += 0.02;
  }
  return table;
}

// The slope of the kinetic stresses is the ratio of the mean squared fluctuations, weighted by mass.
TEST(FitData, KineticStressesAreFittedWithMassesForComposition)
{
  const auto data = read({kinetic_table(1.44)}, {}, Quantity::kinetic);
  const auto yy = fit(data, "size");
  EXPECT_NEAR(yy.value.paper_s, 1.44, 1e-13);
  EXPECT_NEAR(yy.value.paper_B, ((1 - 1.44) + (1 - 1.44) / 1.44) / 2, 1e-13);
  EXPECT_TRUE(std::isnan(yy.neutral));
  EXPECT_TRUE(std::isnan(yy.minus_size.value));
  EXPECT_NEAR(fit(data, "size", {.component = Component::pressure}).value.paper_s, (9 + 1.44) / 2,
              1e-13);
}

// Large grains have twice the density: their share of the mass exceeds phi_L.
TEST(FitData, CompositionOfAKineticTableIsThatOfItsAreas)
{
  const auto by_area = fit(read({kinetic_table(1.44)}, {}, Quantity::kinetic), "size").value;
  auto table = kinetic_table(1.44);
  const auto small = table.column("mass_S"), large = table.column("mass_L");
  table.columns.insert(table.columns.end(), {"area_S[m^2]", "area_L[m^2]"});
  for (auto& row : table.rows) {
    row.insert(row.end(), {row[small], row[large]});
    row[large] *= 2;
  }
  const auto dense = fit(read({table}, {}, Quantity::kinetic), "size").value;
  EXPECT_EQ(dense.B, by_area.B);
  EXPECT_EQ(dense.paper_a, by_area.paper_a);
}

TEST(FitData, ATableOfAnotherToolIsRefusedWithTheNameOfTheRightOne)
{
  EXPECT_TRUE(
      holds(sentence_of<FormatError>({stress_table(neutral_rows(0))}, {}, Quantity::kinetic),
            "grseg-kinetic"));
  EXPECT_TRUE(holds(sentence_of<FormatError>({kinetic_table(1)}), "grseg-stress"));
}

TEST(FitData, BaseContactsCountAsFarAsTheChosenBaseSays)
{
  auto sums = separate_sums(0.5, Tensor2::Identity(), Tensor2::Identity());
  sums.of(OwnSum::base, 0) = 2 * Tensor2::Identity();
  sums.of(OwnSum::whole_base, 0) = 6 * Tensor2::Identity();
  const auto data = read({stress_table({{0, 1, 9, sums}})});
  EXPECT_NEAR(fit(data, "size", {.base = BasePart::contact_point}).value.paper_s, 3, 1e-14);
  EXPECT_NEAR(fit(data, "size", {.base = BasePart::half}).value.paper_s, 4, 1e-14);
  EXPECT_NEAR(fit(data, "size", {.base = BasePart::none}).value.paper_s, 1, 1e-14);
}

TEST(FitData, TablesOfOneBedShareARunOnlyIfTheyAreOfOneFlow)
{
  std::vector<Table> tables(4);
  for (std::size_t k = 0; k < tables.size(); ++k) tables[k].name = std::string(1, "abcd"[k]);
  std::vector<FitTable> read(4);
  for (std::size_t k = 0; k < read.size(); ++k) read[k].table = &tables[k];
  read[1].flow = 1;
  read[3].run = 1;
  EXPECT_EQ(tables_of_shared_runs(read), (std::vector<std::vector<std::string>>{{"a", "c"}}));
}

}  // namespace
}  // namespace grseg
