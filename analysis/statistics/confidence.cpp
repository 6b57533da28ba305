// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/confidence.hpp"

#include "analysis/statistics/dependence.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>

namespace grseg {

double StandardError::reach() const
{
  return degrees >= least_degrees && std::isfinite(error)
             ? gsl_cdf_tdist_Pinv(0.975, degrees) * error
             : std::numeric_limits<double>::quiet_NaN();
}

Estimate StandardError::around(double value) const
{
  if (!std::isfinite(value)) return {value};
  return {value, value - reach(), value + reach()};
}

Interval StandardError::interval_around(double value) const
{
  const auto estimate = around(value);
  return {estimate.low, estimate.high};
}

StandardError standard_error(const Eigen::VectorXd& influence, int fitted)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(influence.size());
  if (n < 2 || !influence.allFinite()) return {nan, 0};
  const double time = autocorrelation_time(influence, {static_cast<std::size_t>(influence.size())});
  const double degrees = n / time - fitted;
  if (!(degrees >= least_degrees)) return {nan, 0};
  return {std::sqrt(influence.squaredNorm() * time * (degrees + fitted) / degrees), degrees};
}

StandardError error_about_trend(const Eigen::VectorXd& influence)
{
  const auto n = influence.size();
  if (n < 3 || !influence.allFinite()) return {std::numeric_limits<double>::quiet_NaN(), 0};
  const auto differences = static_cast<double>(n - 1);
  const double squares = (influence.tail(n - 1) - influence.head(n - 1)).squaredNorm() / 2;
  return {std::sqrt(static_cast<double>(n) / differences * squares), 2 * differences / 3};
}

}  // namespace grseg
