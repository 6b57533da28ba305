// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_pairs.hpp"

#include "analysis/fit/fit_report.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/stress/contact_sums.hpp"
#include "formats/cli/provenance.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

/// 30 windows of 4 layers with different compositions. Species nu carries the part phi^nu
/// s^a/sum(phi s^a) of the stress, times 1 + noise.
Table table_with_exponent(const SpeciesList& species, double a, double noise, int dimension = 3)
{
  Table table;
  table.name = "sums.tsv";
  table.header = {{"program", "grseg-stress"},
                  {"small_diameter", format_number(species.front().diameter)},
                  {"large_diameter", format_number(species.back().diameter)}};
  if (dimension == 3) table.header.emplace_back("dimension", "3");
  if (names_species(species)) table.header.emplace_back("species", species_text(species));
  const TableKind kind{.dimension = dimension};
  auto names = content_columns(species, dimension);
  for (const auto& name : sum_column_names(species, kind)) names.push_back(name);
  table.columns = with_key_columns(dimension, names);
  std::size_t drawn = 0;
  for (int window = 0; window < 30; ++window)
    for (int layer = 0; layer < 4; ++layer) {
      std::vector<double> phi(species.size());
      double all = 0, total = 0;
      for (std::size_t s = 0; s < phi.size(); ++s)
        all += phi[s] = 1 + 0.4 * std::cos(static_cast<double>(s) + layer);
      for (std::size_t s = 0; s < phi.size(); ++s) {
        phi[s] /= all;
        total += phi[s] * std::pow(species[s].diameter, a);
      }
      ContactSums<3> sums(species.size());
      sums.volume = 1;
      std::vector<double> cells;
      for (const double content : phi) cells.push_back(0.6 * content);
      for (std::size_t s = 0; s < phi.size(); ++s)
        sums.of(OwnSum::inside, s)(1, 1) = phi[s] * std::pow(species[s].diameter, a) / total *
                                           (1 + noise * synthetic::scatter(drawn++));
      if (dimension == 3) {
        for (const double cell : sum_cells(sums, kind)) cells.push_back(cell);
      } else {
        ContactSums<2> plane(species.size());
        for (std::size_t s = 0; s < phi.size(); ++s)
          plane.of(OwnSum::inside, s)(1, 1) = sums.of(OwnSum::inside, s)(1, 1);
        for (const double cell : sum_cells(plane, kind)) cells.push_back(cell);
      }
      table.rows.push_back(with_key({static_cast<double>(window), window + 1.0,
                                     static_cast<double>(layer), layer + 1.0, 10, 1},
                                    cells));
    }
  return table;
}

std::vector<RuleFit> fits_of(const Table& table)
{
  const std::vector<PartitionRule> rules{{}};
  const std::vector<Table> tables{table};
  const auto read = read_fit_tables(tables, Quantity::contact, rules);
  return fit_pairs(read, Quantity::contact, {}, all_pairs(read[0].species.size()), rules, {}, true);
}

const SpeciesList five{{"p", 1}, {"q", 1.3}, {"r", 2}, {"s", 2.2}, {"t", 4}};

TEST(SizeExponent, ThatStressWasSharedWithIsFoundExactly)
{
  for (const double a : {-1.0, 0.0, 0.058, 2.0})
    for (const auto& species : {SpeciesList{{"small", 1}, {"large", 2}}, five})
      for (const auto& fit : fits_of(table_with_exponent(species, a, 0)))
        EXPECT_NEAR(fit.size_exponent->value, a, 1e-13);
}

TEST(SizeExponent, OfTwoSpeciesIsThatOfTheirLogarithms)
{
  for (const int dimension : {2, 3}) {
    const auto fit =
        fits_of(table_with_exponent({{"small", 1}, {"large", 2}}, 0.06, 0.3, dimension))[0];
    const auto& exponent = *fit.size_exponent;
    EXPECT_NEAR(exponent.value, fit.value.minus_ln_s / std::log(2), 1e-14);
    EXPECT_NEAR(exponent.low, fit.low.minus_ln_s / std::log(2), 1e-10);
    EXPECT_NEAR(exponent.high, fit.high.minus_ln_s / std::log(2), 1e-10);
    EXPECT_LT(exponent.low, exponent.value);
  }
}

// For two species, minus_ln_s is -ln s = a ln r.
TEST(FitPairs, GiveBOfEveryTwoSpecies)
{
  const auto fits = fits_of(table_with_exponent(five, 0.3, 0));
  ASSERT_EQ(fits.size(), 10u);
  for (const auto& fit : fits) {
    const double ratio = five[fit.pair.larger].diameter / five[fit.pair.smaller].diameter;
    EXPECT_NEAR(fit.value.minus_ln_s, 0.3 * std::log(ratio), 1e-13);
    EXPECT_EQ(fit.points, 120u);
  }
  EXPECT_EQ(fits[1].pair.smaller, 0u);
  EXPECT_EQ(fits[1].pair.larger, 2u);
}

TEST(FitPairs, AreNamedInTheTable)
{
  FitReport report;
  report.species = five;
  report.rules = fits_of(table_with_exponent(five, 0.3, 0));
  const auto text = to_tsv(report);
  EXPECT_NE(text.find("\nrule\tflow\tpair\tcomponent\tquantity\t"), std::string::npos);
  EXPECT_NE(text.find("\tq+s\tyy\tB\t"), std::string::npos);
  EXPECT_NE(to_json(report).find("\"size_exponent\""), std::string::npos);
}

TEST(FitPairs, AreChosenByNameOrNumberInAnyOrder)
{
  const auto by_name = parse_pair("s,q", five), by_number = parse_pair("2,4", five);
  EXPECT_EQ(by_name.smaller, 1u);
  EXPECT_EQ(by_name.larger, 3u);
  EXPECT_EQ(by_number.smaller, 1u);
  EXPECT_EQ(by_number.larger, 3u);
  for (const char* wrong : {"q", "q,q", "q,f", "", "0,1", "1,6"})
    EXPECT_THROW(parse_pair(wrong, five), UsageError) << wrong;
}

TEST(FitPairs, OfTablesWithOtherSpeciesOrDimensionsAreRefused)
{
  const std::vector<PartitionRule> rules{{}};
  const SpeciesList three{{"p", 1}, {"q", 2}, {"z", 3}}, others{{"p", 1}, {"q", 2}, {"r", 3}};
  const std::vector<Table> tables{table_with_exponent(three, 0, 0),
                                  table_with_exponent(others, 0, 0)};
  EXPECT_THROW(read_fit_tables(tables, Quantity::contact, rules), FormatError);
  const std::vector<Table> mixed{table_with_exponent(three, 0, 0, 2),
                                 table_with_exponent(three, 0, 0, 3)};
  EXPECT_THROW(read_fit_tables(mixed, Quantity::contact, rules), FormatError);
}

}  // namespace
}  // namespace grseg
