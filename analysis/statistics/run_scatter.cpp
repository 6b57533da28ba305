// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/run_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr StandardError unknown{std::numeric_limits<double>::quiet_NaN(), 0};

}  // namespace

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
  Eigen::VectorXd values(static_cast<Eigen::Index>(numbers.size()));
  std::vector<StandardError> parts;
  parts.reserve(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    values[static_cast<Eigen::Index>(k)] = numbers[k].value;
    parts.push_back({numbers[k].error.error / count, numbers[k].error.degrees});
  }
  return {values.mean(), added(parts), scatter_of_values(values)};
}

}  // namespace grseg
