// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/coarse_graining.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <numbers>

namespace grseg {
namespace {

constexpr int points_per_unit = 64;
// Least u of the series. Below it the rounding of -u/sqrt(2) alone costs 1e-15 of the primitive.
constexpr int lowest = -10;
constexpr std::size_t points = -lowest * points_per_unit + 1;
// Number of terms. The rest is largest half a spacing from the point at `lowest`: 3e-18 of Phi.
constexpr std::size_t terms = 11;

/// Coefficients of the primitive of Phi, in powers of the distance from a point.
using Series = std::array<double, terms>;

long double density(long double u)
{
  return std::exp(-u * u / 2) / std::sqrt(2 * std::numbers::pi_v<long double>);
}
long double below(long double u)
{
  return std::erfc(-u / std::numbers::sqrt2_v<long double>) / 2;
}

/// The primitive of Phi. The sum u Phi + phi is only 1/u^2 of its terms, hence long double.
long double below_primitive(long double u)
{
  return u * below(u) + density(u);
}

Series series_about(long double u)
{
  const long double phi = density(u);
  Series series{static_cast<double>(below_primitive(u)), static_cast<double>(below(u))};
  // The derivatives of phi are phi times Hermite polynomials; a coefficient is divided by n!.
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

/// Value of a polynomial. Separate sums of even and odd powers halve the chain of dependent steps.
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

/// The series about the point nearest to u (`lowest` to 0), and the distance of u from that point.
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

namespace {

// Functions of u = y/w, for a kernel of width 1.

// Distance in units of w beyond which the integral of a Gaussian is 1e-17.
constexpr double gauss_reach = 8.5;
// Length in units of w below which three_point_mean() is more accurate than two primitives.
constexpr double short_branch = 0.02;

double gauss(double u)
{
  return std::exp(-u * u / 2) / std::sqrt(2 * std::numbers::pi);
}

/// Mean of f from a to b by three Gauss-Legendre points, exact for polynomials up to degree 5.
double three_point_mean(double (*f)(double), double a, double b)
{
  const double middle = a + (b - a) / 2, offset = std::sqrt(0.6) * (b - a) / 2;
  return (5 * f(middle - offset) + 8 * f(middle) + 5 * f(middle + offset)) / 18;
}

/// True if a Gaussian changes so little from a to b that three points are more accurate than the
/// difference of two primitives. Requires |a| >= |b|.
bool is_short(double a, double b)
{
  return (b - a) * std::max(1.0, -a) < short_branch;
}

/// Mean of the Gaussian from a to b, a < b, mirrored to negative u, where primitives are small.
double gauss_mean(double a, double b)
{
  if (a + b > 0) return gauss_mean(-b, -a);
  if (is_short(a, b)) return three_point_mean(gauss, a, b);
  return (normal_below(b) - normal_below(a)) / (b - a);
}

double gauss_below_mean(double a, double b)
{
  if (a + b > 0) return 1 - gauss_below_mean(-b, -a);
  if (is_short(a, b)) return three_point_mean(normal_below, a, b);
  return (normal_below_primitive(b) - normal_below_primitive(a)) / (b - a);
}

}  // namespace

Kernel::Kernel(double width) : width_(width)
{
  if (!(width > 0) || !std::isfinite(width))
    throw UsageError(
        fmt::format("the coarse-graining width {:g} m is not positive; give e.g. 1dS", width));
}

double Kernel::reach() const
{
  return gauss_reach * width_;
}

double Kernel::value(double u) const
{
  return gauss(u / width_) / width_;
}

double Kernel::below(double u) const
{
  return normal_below(u / width_);
}

double Kernel::along(double y, double from, double to) const
{
  const double a = (y - std::max(from, to)) / width_, b = (y - std::min(from, to)) / width_;
  return a < b ? gauss_mean(a, b) / width_ : value(y - from);
}

double Kernel::below_along(double y, double from, double to) const
{
  const double a = (y - std::max(from, to)) / width_, b = (y - std::min(from, to)) / width_;
  return a < b ? gauss_below_mean(a, b) : below(y - from);
}

}  // namespace grseg
