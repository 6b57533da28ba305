// SPDX-License-Identifier: GPL-3.0-or-later
// Segregation and diffusion in a bed, against closed forms.
#include "analysis/segregation/transport.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace grseg {
namespace {

constexpr double height = 0.3;  // m

TransportLaw uniform(double S, double D)
{
  return [=](double, double) { return TransportRates{S, D}; };
}

/// Cells with phi_L = of(y) at their centres.
template <class Of>
std::vector<double> cells(std::size_t count, const Of& of)
{
  std::vector<double> phi(count);
  for (std::size_t k = 0; k < count; ++k)
    phi[k] = of((static_cast<double>(k) + 0.5) * height / static_cast<double>(count));
  return phi;
}

double sum(const std::vector<double>& phi)
{
  return std::accumulate(phi.begin(), phi.end(), 0.0);
}

/// Largest difference of two beds with the same cells.
double most(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    difference = std::max(difference, std::abs(a[k] - b[k]));
  return difference;
}

/// Large grains fill the bed up to a height; a cell that is cut has a part of them.
std::vector<double> filled_up_to(std::size_t count, double top)
{
  const double cell = height / static_cast<double>(count);
  std::vector<double> phi(count);
  for (std::size_t k = 0; k < count; ++k)
    phi[k] = std::clamp(top / cell - static_cast<double>(k), 0.0, 1.0);
  return phi;
}

/// Error at the steady state of a bed that is half large, with S = 3 mm/s and D = 1e-4 m^2/s:
/// ln(phi_L/phi_S) = S (y - height/2)/D (Gray & Chugunov 2006), by symmetry about mid-height.
double error_of_steady_state(std::size_t count)
{
  constexpr double S = 3e-3, D = 1e-4;
  TransportColumn bed(cells(count, [](double) { return 0.5; }), height);
  bed.advance(2000, uniform(S, D));
  return most(bed.phi_large(),
              cells(count, [](double y) { return 1 / (1 + std::exp(-S * (y - height / 2) / D)); }));
}

TEST(TransportColumn, ASegregatedBedEndsWithTheLogisticProfileOfGrayAndChugunov)
{
  const double coarse = error_of_steady_state(50), fine = error_of_steady_state(100);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.2);  // an error of second order in the cell
}

/// Error of phi_L = 0.5 + 0.4 cos(pi y/height) exp(-D (pi/height)^2 t) after one decay time.
double error_of_diffusion(std::size_t count)
{
  constexpr double D = 1e-4, wave = std::numbers::pi / height, time = 1 / (D * wave * wave);
  TransportColumn bed(cells(count, [](double y) { return 0.5 + 0.4 * std::cos(wave * y); }),
                      height);
  bed.advance(time, uniform(0, D));
  return most(bed.phi_large(), cells(count, [](double y) {
                return 0.5 + 0.4 * std::cos(wave * y) * std::exp(-1.0);
              }));
}

TEST(TransportColumn, AWaveOfCompositionDecaysAtTheRateOfItsDiffusivity)
{
  const double coarse = error_of_diffusion(25), fine = error_of_diffusion(50);
  EXPECT_LT(fine, 2e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.2);
}

TEST(TransportColumn, AShockRisesWithTheSpeedOfGrayAndThornton)
{
  // A mixture with phi_L = 0.4, S = 2 mm/s, no diffusion: the small grains sink onto the base, and
  // the edge of the layer without large grains rises at S phi_S = 1.2 mm/s; the edge of the layer
  // without small grains sinks from the surface at S phi_L = 0.8 mm/s (Gray & Thornton 2005).
  constexpr double S = 2e-3, phi = 0.4, time = 75;
  constexpr std::size_t count = 600;
  TransportColumn bed(cells(count, [](double) { return phi; }), height);
  bed.advance(time, uniform(S, 0));
  const double below = S * (1 - phi) * time, above = height - S * phi * time;
  const auto expected = cells(count, [&](double y) { return y < below ? 0 : y > above ? 1 : phi; });
  double area = 0;
  for (std::size_t k = 0; k < count; ++k) area += std::abs(bed.phi_large()[k] - expected[k]);
  EXPECT_LT(area, 6);  // in cells: each of two shocks is spread over some cells
  EXPECT_LT(bed.phi_large()[150], 1e-6);
  EXPECT_NEAR(bed.phi_large()[360], phi, 1e-6);
  EXPECT_GT(bed.phi_large()[540], 1 - 1e-6);
}

TEST(TransportColumn, ARarefactionOfLargeGrainsFromTheBaseConvergesToItsFan)
{
  // Large grains below rise into small ones above: phi_L = (1 - (y - top)/(S t))/2 between
  // top - S t and top + S t, while the fan reaches neither base nor surface.
  constexpr double S = 2e-3, top = height / 2, time = 60;
  const auto error = [&](std::size_t count) {
    TransportColumn bed(filled_up_to(count, top), height);
    bed.advance(time, uniform(S, 0));
    const auto fan = cells(
        count, [&](double y) { return std::clamp((1 - (y - top) / (S * time)) / 2, 0.0, 1.0); });
    double all = 0;
    for (std::size_t k = 0; k < count; ++k) all += std::abs(bed.phi_large()[k] - fan[k]);
    return all / static_cast<double>(count);
  };
  // The scheme's own diffusivity, S cell/2, spreads an edge by sqrt(S cell time) at most; the error
  // of a monotone scheme decreases at least with the square root of the cell (Kuznetsov 1976).
  EXPECT_LT(error(400), std::sqrt(S * height / 400 * time) / height);
  EXPECT_GT(error(100) / error(400), 2);
}

TEST(TransportColumn, LargeGrainsAreConservedAndTheirShareStaysBetweenNoneAndAll)
{
  for (const double S : {5e-2, -5e-2, 2e-3})
    for (const double D : {0.0, 1e-6, 1e-3}) {
      TransportColumn bed(filled_up_to(37, 0.4321 * height), height);
      const double before = sum(bed.phi_large());
      // The coefficients differ between places and compositions, as those of Trewhela et al. do.
      bed.advance(13, [=](double y, double phi) {
        return TransportRates{S * (1 + phi) / (0.1 + height - y), D * (1 + phi)};
      });
      EXPECT_NEAR(sum(bed.phi_large()), before, 1e-11) << S << ' ' << D;
      const auto [least, greatest] = std::ranges::minmax(bed.phi_large());
      EXPECT_GE(least, 0);
      EXPECT_LE(greatest, 1);
    }
}

TEST(TransportColumn, SmallGrainsThatRiseMirrorLargeGrainsThatSink)
{
  constexpr double S = 3e-3, D = 5e-5;
  const auto from = filled_up_to(60, 0.1);
  TransportColumn rising(from, height), sinking({from.rbegin(), from.rend()}, height);
  rising.advance(20, uniform(S, D));
  sinking.advance(20, uniform(-S, D));
  const std::vector<double> mirrored(sinking.phi_large().rbegin(), sinking.phi_large().rend());
  EXPECT_LT(most(rising.phi_large(), mirrored), 1e-12);
}

/// Rise of of(phi_L) between the cells at a quarter and at three quarters of 100 cells at the end.
template <class Of>
double final_rise(const TransportLaw& law, const Of& of)
{
  TransportColumn bed(cells(100, [](double) { return 0.5; }), height);
  bed.advance(2000, law);
  return of(bed.phi_large()[75]) - of(bed.phi_large()[25]);
}

TEST(TransportColumn, TheSteadyProfileFollowsCoefficientsThatDependOnHeightAndComposition)
{
  constexpr double S = 1e-3, D = 1e-4, low = 0.255 * height, high = 0.755 * height;
  // D (1 + y/height): ln(phi_L/phi_S) = S height/D ln(1 + y/height) + constant.
  EXPECT_NEAR(final_rise(
                  [](double y, double) {
                    return TransportRates{S, D * (1 + y / height)};
                  },
                  [](double phi) { return std::log(phi / (1 - phi)); }),
              S * height / D * std::log((height + high) / (height + low)), 1e-3);
  // S (1 + phi_L): ln(phi_L/sqrt(1 - phi_L^2)) = S y/D + constant.
  EXPECT_NEAR(final_rise(
                  [](double, double phi) {
                    return TransportRates{S * (1 + phi), D};
                  },
                  [](double phi) { return std::log(phi / std::sqrt(1 - phi * phi)); }),
              S / D * (high - low), 1e-3);
}

TEST(TransportColumn, NothingMovesWithoutRates)
{
  const auto from = filled_up_to(20, 0.13);
  TransportColumn bed(from, height);
  bed.advance(100, uniform(0, 0));
  EXPECT_EQ(bed.phi_large(), from);
}

}  // namespace
}  // namespace grseg
