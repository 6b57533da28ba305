// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/confidence.hpp"

#include "analysis/statistics/dependence.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace grseg {

double StandardError::reach() const
{
  return degrees >= least_degrees && std::isfinite(error)
             ? gsl_cdf_tdist_Pinv(0.975, degrees) * error
             : no_number;
}

Estimate StandardError::around(double value) const
{
  if (!std::isfinite(value)) return {value};
  return {value, value - reach(), value + reach()};
}

constexpr StandardError unknown{no_number, 0};

StandardError standard_error(const Eigen::VectorXd& influence, int fitted)
{
  const auto n = static_cast<double>(influence.size());
  if (n < 2 || !influence.allFinite()) return unknown;
  const double time = autocorrelation_time(influence, {static_cast<std::size_t>(influence.size())});
  const double degrees = n / time - fitted;
  if (!(degrees >= least_degrees)) return unknown;
  return {std::sqrt(influence.squaredNorm() * time * (degrees + fitted) / degrees), degrees};
}

StandardError error_about_trend(const Eigen::VectorXd& influence)
{
  const auto n = influence.size();
  if (n < 3 || !influence.allFinite()) return unknown;
  const auto differences = static_cast<double>(n - 1);
  const double squares = (influence.tail(n - 1) - influence.head(n - 1)).squaredNorm() / 2;
  return {std::sqrt(static_cast<double>(n) / differences * squares), 2 * differences / 3};
}

StandardError scatter_of_runs(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight)
{
  const double whole = weight.sum();
  const double runs = whole > 0 ? whole * whole / weight.squaredNorm() : 0;
  if (!(runs > 1) || influence.size() < 2 || !influence.allFinite()) return unknown;
  const Eigen::VectorXd rest = influence - influence.sum() / whole * weight;
  return {std::sqrt(runs / (runs - 1) * rest.squaredNorm()), runs - 1};
}

StandardError added(const std::vector<StandardError>& parts)
{
  if (parts.empty()) return unknown;
  double squares = 0, fourths = 0, least = parts.front().degrees, all = 0;
  for (const auto& part : parts) {
    if (!(part.degrees > 0)) return unknown;
    const double square = part.error * part.error;
    squares += square;
    fourths += square * square / (part.degrees + 2);
    least = std::min(least, part.degrees);
    all += part.degrees;
  }
  const double degrees = fourths > 0 ? squares * squares / fourths - 2 : least;
  return {std::sqrt(squares), std::clamp(degrees, least, all)};
}

StandardError scatter_of_values(const Eigen::VectorXd& values)
{
  return scatter_of_runs((values.array() - values.mean()) / static_cast<double>(values.size()),
                         Eigen::VectorXd::Ones(values.size()));
}

MeanOfEquals mean_of_equals(const std::vector<Measured>& numbers)
{
  const auto count = static_cast<double>(numbers.size());
  const auto values = numbers_of(numbers, &Measured::value);
  std::vector<StandardError> parts;
  for (const auto& [value, error] : numbers) parts.push_back({error.error / count, error.degrees});
  return {values.mean(), added(parts), scatter_of_values(values)};
}

}  // namespace grseg
