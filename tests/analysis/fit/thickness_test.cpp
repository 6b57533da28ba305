// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace grseg {
namespace {

/// A bed in which phi_L and the stress sigma vary linearly with the height y, m, and large grains
/// bear the share phi_L (1 + B phi_S) of the stress at every height.
struct LinearBed {
  double bottom = 0.02, top = 0.28, phi = 0.2, phi_slope = 2, stress = 50, stress_slope = -170;

  double phi_at(double y) const { return phi + phi_slope * y; }
  double stress_at(double y) const { return stress + stress_slope * y; }

  /// Means with a weight of this second moment, m^2, about the middle y of a layer of 1 m^2. B = 0.
  ContactSums<2> means(double y, double moment) const
  {
    const double large = phi_at(y) * stress_at(y) + phi_slope * stress_slope * moment;
    return synthetic::separate_sums(phi_at(y), (stress_at(y) - large) * Tensor2::Identity(),
                                    large * Tensor2::Identity());
  }

  /// B of layers of thickness h, whose fields are smoothed by a kernel of this variance, m^2.
  double b(int layers, Thickness thickness, const std::string& kernel = "", double width = 0,
           double variance = 0) const
  {
    const double h = (top - bottom) / layers;
    std::vector<synthetic::TableRow> rows;
    for (int k = 0; k < layers; ++k) {
      const double y = bottom + (k + 0.5) * h;
      rows.push_back({0, 1, 10, means(y, h * h / 12 + variance), y - h / 2, y + h / 2});
    }
    auto table = synthetic::stress_table(rows);
    table.header.emplace_back("layer", format_number(h));
    if (!kernel.empty()) {
      table.header.emplace_back("assign", kernel);
      table.header.emplace_back("width", format_number(width));
    }
    const auto data = synthetic::read({table});
    FitSettings settings;
    settings.thickness = thickness;
    return synthetic::fit(data, "size", settings).value.B;
  }

  /// The sum of phi_L' sigma' m/sigma over layers, over that of phi_L phi_S.
  double added(int layers, double variance = 0) const
  {
    const double h = (top - bottom) / layers;
    double excess = 0, weight = 0;
    for (int k = 0; k < layers; ++k) {
      const double y = bottom + (k + 0.5) * h;
      excess += phi_slope * stress_slope * (h * h / 12 + variance) / stress_at(y);
      weight += phi_at(y) * (1 - phi_at(y));
    }
    return excess / weight;
  }
};

TEST(Thickness, LayersAddTheProductOfTheirGradientsTimesASquareOfTheirThickness)
{
  const LinearBed bed;
  for (const int layers : {4, 8, 16, 64}) {
    EXPECT_NEAR(bed.b(layers, Thickness::kept), bed.added(layers), 1e-14) << layers;
    EXPECT_NEAR(bed.b(layers, Thickness::removed), 0, 1e-14) << layers;
  }
  EXPECT_LT(bed.added(4), -0.03);  // so that the test could fail
}

// The stress falls from 100 to 1 and 0.01 from layer to layer, so that no straight profile is positive.
TEST(Thickness, MoreThanStraightProfilesAddIsDoubted)
{
  std::vector<synthetic::TableRow> rows;
  for (const auto& [y, phi, stress] :
       {std::tuple{0.0, 0.2, 100.0}, {0.1, 0.5, 1.0}, {0.2, 0.8, 0.01}})
    rows.push_back({0, 1, 10,
                    synthetic::separate_sums(phi, (1 - phi) * stress * Tensor2::Identity(),
                                             phi * stress * Tensor2::Identity()),
                    y, y + 0.1});
  auto table = synthetic::stress_table(rows);
  table.header.emplace_back("layer", "0.1");
  const auto fit = synthetic::fit(synthetic::read({table}), "size");
  EXPECT_GT(std::abs(fit.of_thickness), 2.0 / 3);
  EXPECT_TRUE(synthetic::holds(fit.doubt, "straight profiles add at most 2/3: B is wrong"))
      << fit.doubt;
}

// Half of the grains are large ones. They bear the whole stress at B = 2, and more than it where small
// ones pull.
TEST(Bounds, ABOfMoreThanTheWholeStressIsDoubted)
{
  const auto doubt_at = [](double small, double large) {
    const auto sums =
        synthetic::separate_sums(0.5, small * Tensor2::Identity(), large * Tensor2::Identity());
    return synthetic::fit(synthetic::read({synthetic::stress_table({{0, 1, 10, sums}})}), "size")
        .doubt;
  };
  for (const auto& [small, large] : {std::pair{0.0, 1.0}, {1.0, 0.0}, {0.3, 0.7}})
    EXPECT_FALSE(synthetic::holds(doubt_at(small, large), "impossible")) << small;
  EXPECT_TRUE(synthetic::holds(doubt_at(-1, 3), "B = 4 is impossible: "));
  EXPECT_TRUE(synthetic::holds(doubt_at(3, -1), "lies between -2 and 2; some stresses are"))
      << doubt_at(3, -1);
}

TEST(Thickness, KernelsAddTheirVarianceToThatOfTheLayer)
{
  const LinearBed bed;
  const double w = 0.02;
  for (const auto& [kernel, variance] :
       {std::pair{"gauss", w * w}, {"lucy", w * w * 2 / 21}, {"heaviside", w * w / 3}}) {
    EXPECT_NEAR(bed.b(20, Thickness::kept, kernel, w, variance), bed.added(20, variance), 1e-14);
    EXPECT_NEAR(bed.b(20, Thickness::removed, kernel, w, variance), 0, 1e-14) << kernel;
  }
}

/// The coordinate in which a field varies: straight, or the distance r from an axis, so that means
/// have the weight r.
struct Coordinate {
  bool radial = false;
  double low = 0.02, side = 0.02;  // begin of the first cell, and the side of cells, m

  double begin(int cell) const { return low + cell * side; }
  double mean(int cell) const
  {
    const double a = begin(cell), b = begin(cell + 1);
    return radial ? 2 * (b * b * b - a * a * a) / (3 * (b * b - a * a)) : (a + b) / 2;
  }
  double moment(int cell) const  // second moment about the mean
  {
    const double a = begin(cell), b = begin(cell + 1);
    return radial ? (a * a + b * b) / 2 - mean(cell) * mean(cell) : side * side / 12;
  }
};

/// A bed in which phi_L and the stress vary linearly with both coordinates of a map, and large grains
/// bear the share phi_L of the stress at every place (B = 0).
struct LinearMap {
  Coordinate first{}, second{};
  std::string bins = "xy";
  int columns = 5, rows = 6;
  Vec2 phi_slope{2, -1.5}, stress_slope{-100, 60};

  double phi_at(const Vec2& place) const { return 0.4 + phi_slope.dot(place); }
  double stress_at(const Vec2& place) const { return 50 + stress_slope.dot(place); }
  Vec2 mean(int i, int j) const { return {first.mean(i), second.mean(j)}; }
  /// The products of the gradients inside a cell, which its means add to psi_L - phi_L.
  double added(int i, int j) const
  {
    return (phi_slope.x() * stress_slope.x() * first.moment(i) +
            phi_slope.y() * stress_slope.y() * second.moment(j)) /
           stress_at(mean(i, j));
  }

  Table table() const
  {
    std::vector<synthetic::TableRow> cells;
    std::vector<std::pair<double, double>> edges;  // along the first axis
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const Vec2 place = mean(i, j);
        const double stress = stress_at(place), large = (phi_at(place) + added(i, j)) * stress;
        cells.push_back(
            {0, 1, 10,
             synthetic::separate_sums(phi_at(place), (stress - large) * Tensor2::Identity(),
                                      large * Tensor2::Identity()),
             second.begin(j), second.begin(j + 1)});
        edges.emplace_back(first.begin(i), first.begin(i + 1));
      }
    auto table = synthetic::stress_table(cells);
    if (bins.starts_with("radius")) {
      table.header.emplace_back("bins", bins);
      return table;
    }
    for (auto& name : table.columns)
      if (name.starts_with("y")) name.front() = bins[1];
    table.columns.insert(table.columns.begin() + 2,
                         {bins.substr(0, 1) + "0[m]", bins.substr(0, 1) + "1[m]"});
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      table.rows[row].insert(table.rows[row].begin() + 2, {edges[row].first, edges[row].second});
    table.header.emplace_back("bins", bins);
    return table;
  }
  double b(Thickness thickness) const
  {
    FitSettings settings;
    settings.thickness = thickness;
    return synthetic::fit(synthetic::read({table()}), "size", settings).value.B;
  }
  /// B of the cells' means.
  double b_of_means() const
  {
    double excess = 0, weight = 0;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        excess += added(i, j);
        weight += phi_at(mean(i, j)) * (1 - phi_at(mean(i, j)));
      }
    return excess / weight;
  }
};

TEST(Thickness, CellsOfAMapAddTheProductsOfTheirGradientsInBothDirections)
{
  for (const double side : {0.005, 0.01, 0.02}) {
    LinearMap map;
    map.first.side = side;
    map.second.side = 1.5 * side;
    EXPECT_NEAR(map.b(Thickness::kept), map.b_of_means(), 1e-14) << side;
    EXPECT_NEAR(map.b(Thickness::removed), 0, 1e-14) << side;
  }
  LinearMap one_direction;
  one_direction.phi_slope.y() = 0;
  EXPECT_LT(one_direction.b_of_means(), -1e-4);  // so that the test could fail
  LinearMap other_direction;
  other_direction.phi_slope.x() = 0;
  EXPECT_LT(other_direction.b_of_means(), -1e-4);
}

TEST(Thickness, RoundAnAxisTheWeightGrowsWithTheDistance)
{
  LinearMap rz{{true, 0.0, 0.02}, {}, "rz"};
  EXPECT_NEAR(rz.b(Thickness::kept), rz.b_of_means(), 1e-14);
  EXPECT_NEAR(rz.b(Thickness::removed), 0, 1e-14);

  LinearMap annuli{{false, 0, 0}, {true, 0.0, 0.04}, "radius 0.1 0.1", 1};
  annuli.phi_slope = {0, 1};
  EXPECT_NEAR(annuli.b(Thickness::kept), annuli.b_of_means(), 1e-14);
  EXPECT_NEAR(annuli.b(Thickness::removed), 0, 1e-14);
  EXPECT_GT(annuli.b_of_means(), 1e-4);  // so that the test could fail
  // The innermost annulus is a disc: h^2/18 in place of h^2/12.
  EXPECT_NEAR(annuli.second.moment(0), 0.04 * 0.04 / 18, 1e-18);
}

TEST(Thickness, CellsOnBothSidesOfAPeriodAreNeighbours)
{
  LinearMap map;
  auto table = map.table();
  const auto keys = read_keys(table, "");
  const auto all = [](std::size_t) { return true; };
  const auto beside_first = [&] { return RowNeighbours(table, keys).beside(0, all)[0]; };
  EXPECT_FALSE(beside_first().below);
  table.header.emplace_back("periodic", "x");
  table.header.emplace_back("length", format_number(map.columns * map.first.side));
  EXPECT_EQ(beside_first().below, std::optional<std::size_t>(4));
  EXPECT_EQ(beside_first().above, std::optional<std::size_t>(1));
  EXPECT_EQ(RowNeighbours(table, keys).beside(4, all)[0].above, std::optional<std::size_t>(0));
  EXPECT_FALSE(RowNeighbours(table, keys).beside(0, all)[1].below);
}

TEST(Thickness, ALayerThatIsHalfEmptyIsNoNeighbour)
{
  LinearMap map;
  auto table = map.table();
  const auto removed = [&] {
    FitSettings settings;
    settings.thickness = Thickness::removed;
    return synthetic::fit(synthetic::read({table}), "size", settings).value.B;
  };
  // A cell with a third of the grains and of the stress, as at a surface.
  const auto scale = [&](const char* name) { table.rows[14][table.column(name)] /= 3; };
  for (const char* name : {"area_S", "area_L", "A_SS_yy", "A_LL_yy"}) scale(name);
  EXPECT_NEAR(removed(), 0, 1e-14);
}

TEST(Thickness, ALayerWithoutANeighbourKeepsItsMean)
{
  const LinearBed bed;
  EXPECT_EQ(bed.b(1, Thickness::removed), bed.b(1, Thickness::kept));
  EXPECT_NE(bed.b(2, Thickness::removed), bed.b(2, Thickness::kept));
}

}  // namespace
}  // namespace grseg
