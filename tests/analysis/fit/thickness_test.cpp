// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

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

TEST(Thickness, ALayerWithoutANeighbourKeepsItsMean)
{
  const LinearBed bed;
  EXPECT_EQ(bed.b(1, Thickness::removed), bed.b(1, Thickness::kept));
  EXPECT_NE(bed.b(2, Thickness::removed), bed.b(2, Thickness::kept));
}

}  // namespace
}  // namespace grseg
