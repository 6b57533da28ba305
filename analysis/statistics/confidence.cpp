// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/confidence.hpp"

#include <fmt/format.h>
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

StandardError error_about_trend(const Eigen::VectorXd& influence)
{
  const auto n = influence.size();
  if (n < 3 || !influence.allFinite()) return unknown;
  const auto differences = static_cast<double>(n - 1);
  const double squares = (influence.tail(n - 1) - influence.head(n - 1)).squaredNorm() / 2;
  return {std::sqrt(static_cast<double>(n) / differences * squares), 2 * differences / 3};
}

double effective_number(const Eigen::VectorXd& weight)
{
  const double sum = weight.sum();
  return sum > 0 ? sum * sum / weight.squaredNorm() : 0;
}

Deviation deviation_of_runs(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight)
{
  const double runs = effective_number(weight);
  if (!(runs > 1) || influence.size() < 2 || !influence.allFinite()) return {};
  return {std::sqrt(runs / (runs - 1)) * (influence - influence.sum() / weight.sum() * weight),
          runs - 1};
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

std::string doubt_of_runs(const Eigen::VectorXd& weight)
{
  const double runs = effective_number(weight);
  if (runs > 3.5) return {};
  return fmt::format(
      "{} runs, worth {:.3g} of equal weight, show {} how runs differ; more runs, of other seeds, "
      "give a narrower interval",
      weight.size(), runs, runs < 1 + least_degrees ? "nothing of" : "little of");
}

}  // namespace grseg
