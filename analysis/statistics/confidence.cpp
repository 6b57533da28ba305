// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/confidence.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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
  const auto parts = listed(numbers, [&](const Measured& number) {
    return StandardError{number.error.error / count, number.error.degrees};
  });
  return {values.mean(), added(parts), scatter_of_values(values)};
}

namespace {

/// The series minus the mean of each run.
Eigen::VectorXd about_run_means(Eigen::VectorXd series, const RunLengths& runs)
{
  std::size_t first = 0;
  for (const auto length : runs) {
    auto run = series.segment(index(first), index(length));
    if (length > 0) run.array() -= run.mean();
    first += length;
  }
  return series;
}

/// Sum of products of windows that are `lag` apart in one run.
double product_at_lag(const Eigen::VectorXd& series, const RunLengths& runs, std::size_t lag)
{
  double sum = 0;
  std::size_t first = 0;
  for (const auto length : runs) {
    if (length > lag)
      sum += series.segment(index(first), index(length - lag))
                 .dot(series.segment(index(first + lag), index(length - lag)));
    first += length;
  }
  return sum;
}

using Correlation = std::function<double(std::size_t)>;

/// Autocorrelation time, 1 + 2 sum of the correlation to the first lag >= 5 times the result. The
/// last factor corrects for the subtracted mean of n windows, which lowers each term (Wolff 2004).
double time_by_summing(const Correlation& correlation, double n)
{
  const auto windows = static_cast<std::size_t>(n);
  double time = 1;
  std::size_t lag = 1;
  for (; lag < windows; ++lag) {
    time += 2 * correlation(lag);
    if (static_cast<double>(lag) >= 5 * time) break;
  }
  return time * (1 + (2 * static_cast<double>(lag) + 1) / n);
}

/// Autocorrelation time of the AR(1) series with this correlation of neighbours, corrected for its
/// bias -(1 + 3 rho)/n (Kendall 1954). For few windows it varies less than the sum of correlations.
double time_of_ar1(const Correlation& correlation, double n)
{
  if (n < 4) return 1;
  const double rho = std::min((n * correlation(1) + 1) / (n - 3), 1 - 2 / n);
  return (1 + rho) / (1 - rho);
}

/// Effective number of terms with weights b: (sum b)^2 / sum b^2.
double effective_number(const Eigen::VectorXd& weight)
{
  const double sum = weight.sum();
  return sum > 0 ? sum * sum / weight.squaredNorm() : 0;
}

Eigen::VectorXd sum_by_run(const Eigen::VectorXd& weight, const RunLengths& runs)
{
  Eigen::Index end = 0;
  return numbers_of(runs, [&](std::size_t windows) {
    end += index(windows);
    return weight.segment(end - index(windows), index(windows)).sum();
  });
}

}  // namespace

std::size_t number_of_windows(const RunLengths& runs)
{
  return std::accumulate(runs.begin(), runs.end(), std::size_t{0});
}

double neighbour_correlation(double time)
{
  return (time - 1) / (time + 1);
}

double autocorrelation_time(const Eigen::VectorXd& series, const RunLengths& runs)
{
  const Eigen::VectorXd deviation = about_run_means(series, runs);
  const double square = deviation.squaredNorm();
  if (!(square > 0)) return 1;
  const double per_run =
      static_cast<double>(number_of_windows(runs)) / static_cast<double>(runs.size());
  const auto correlation = [&](std::size_t lag) {
    return product_at_lag(deviation, runs, lag) / square;
  };
  return std::max({1.0, time_by_summing(correlation, per_run), time_of_ar1(correlation, per_run)});
}

std::size_t block_length(double time, const RunLengths& runs)
{
  if (runs.empty()) return 1;
  const auto windows = static_cast<double>(number_of_windows(runs));
  const auto count = static_cast<double>(runs.size());
  const double rho = neighbour_correlation(time);
  const double best =
      std::pow(std::sqrt(6.0) * rho / (1 - rho * rho), 2.0 / 3) * std::cbrt(windows / count);
  const double longest = std::floor(windows / (count + 1));
  return static_cast<std::size_t>(std::max(1.0, std::min(std::ceil(best), longest)));
}

Dependence dependence(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight,
                      const RunLengths& runs)
{
  const double time = autocorrelation_time(influence, runs);
  return {time, block_length(time, runs), effective_number(weight),
          effective_number(sum_by_run(weight, runs))};
}

Dependence worse(const Dependence& a, const Dependence& b)
{
  const Dependence& longer = a.time >= b.time ? a : b;
  return {longer.time, longer.block, std::min(a.effective_windows, b.effective_windows),
          std::min(a.effective_runs, b.effective_runs)};
}

}  // namespace grseg
