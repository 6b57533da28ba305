// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/normal_distribution.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace grseg {
namespace {

constexpr int points_per_unit = 64;
// Below it the rounding of -u/sqrt(2) alone makes an error of 1e-15 in the primitive.
constexpr int lowest = -10;
constexpr std::size_t points = -lowest * points_per_unit + 1;
// At the lowest, half a spacing from a point, what comes after them is 3e-18 of Phi.
constexpr std::size_t terms = 11;

/// Of the primitive of Phi, in powers of the distance from a point.
using Series = std::array<double, terms>;

long double density(long double u)
{
  return std::exp(-u * u / 2) / std::sqrt(2 * std::numbers::pi_v<long double>);
}
long double below(long double u)
{
  return std::erfc(-u / std::numbers::sqrt2_v<long double>) / 2;
}

/// Here u Phi + phi cancels to 1/u^2 of its terms, hence long double.
long double below_primitive(long double u)
{
  return u * below(u) + density(u);
}

Series series_about(long double u)
{
  const long double phi = density(u);
  Series series{static_cast<double>(below_primitive(u)), static_cast<double>(below(u))};
  // phi times Hermite polynomials over factorials: the derivatives of phi.
  long double last = 0, now = phi / 2;
  for (std::size_t n = 2; n < terms; ++n) {
    series[n] = static_cast<double>(now);
    const auto order = static_cast<long double>(n);
    const long double next = -(u * now + last * (order - 2) / order) / (order + 1);
    last = now;
    now = next;
  }
  return series;
}

std::array<Series, points> series_about_all_points()
{
  std::array<Series, points> all;
  for (std::size_t k = 0; k < points; ++k)
    all[k] = series_about(-static_cast<long double>(k) / points_per_unit);
  return all;
}

/// Even and odd powers apart: half as long a chain of operations that wait for each other.
template <std::size_t terms, class Coefficient>
double polynomial(double x, const Coefficient& coefficient)
{
  double even = 0, odd = 0;
  for (std::size_t n = terms; n-- > 0;) {
    auto& sum = n % 2 == 0 ? even : odd;
    sum = sum * (x * x) + coefficient(n);
  }
  return even + x * odd;
}

/// The series about the point nearest to u, from `lowest` to 0, and the distance from there.
struct Place {
  const Series& series;
  double distance;
};
Place nearest(double u)
{
  static const auto all = series_about_all_points();
  const auto point = static_cast<std::size_t>(0.5 - points_per_unit * u);
  return {all[point], u + static_cast<double>(point) / points_per_unit};
}

}  // namespace

double normal_below(double u)
{
  if (u > 0) return 1 - normal_below(-u);
  if (!(u >= lowest)) return static_cast<double>(below(u));
  const auto place = nearest(u);
  return polynomial<terms - 1>(place.distance, [&](std::size_t n) {
    return static_cast<double>(n + 1) * place.series[n + 1];
  });
}

double normal_below_primitive(double u)
{
  if (u > 0) return u + normal_below_primitive(-u);
  if (!(u >= lowest)) return static_cast<double>(below_primitive(u));
  const auto place = nearest(u);
  return polynomial<terms>(place.distance, [&](std::size_t n) { return place.series[n]; });
}

}  // namespace grseg
