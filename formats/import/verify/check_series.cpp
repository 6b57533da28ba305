// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/check_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace grseg {
namespace {

/// Relative rounding error of contact forces in text of six digits.
constexpr double digits = 1e-6;
/// Limits for a fitted slope: the largest unexplained fraction of the squares of y, and the
/// smallest number of grains.
constexpr double largest_rest = 0.1, fewest_grains = 3;

struct Weighted {
  double weight;
  Vec3 value;
};

Vec3 mean_of(const std::vector<Weighted>& values)
{
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (const auto& [weight, value] : values) sum += weight * value, weights += weight;
  return sum / weights;
}

/// Squared standard error of the mean. Includes correlations of frames up to `lag` apart, with
/// weights that decrease to 0 (Newey and West 1987).
double squared_error(const std::vector<Weighted>& values, const Vec3& mean, std::size_t lag)
{
  double total = 0;
  for (const auto& [weight, value] : values) total += weight;
  const auto product = [&](std::size_t a, std::size_t b) {
    return values[a].weight * values[b].weight *
           (values[a].value - mean).dot(values[b].value - mean);
  };
  double variance = 0;
  for (std::size_t apart = 0; apart <= lag; ++apart) {
    const double fade =
        apart == 0 ? 1 : 2 * (1 - static_cast<double>(apart) / static_cast<double>(lag + 1));
    for (std::size_t k = apart; k < values.size(); ++k) variance += fade * product(k, k - apart);
  }
  const auto n = static_cast<double>(values.size());
  return std::max(0.0, variance) / (total * total) * n / (n - 1);
}

Estimate from_medians(const std::vector<Weighted>& values, double squared_within)
{
  Estimate estimate;
  estimate.value = mean_of(values);
  estimate.frames = values.size();
  estimate.medians = true;
  for (const auto& [weight, value] : values) estimate.grains += weight;
  const double within = std::sqrt(squared_within) / estimate.grains;
  const double between =
      values.size() > 2 ? std::sqrt(squared_error(values, estimate.value, 0)) : 0;
  estimate.error = std::max(within, between);
  estimate.grains /= static_cast<double>(values.size());
  return estimate;
}

/// The results of `find` in both halves of the series, if they `differ`; otherwise empty.
template <class Find, class Differ>
auto differing_halves(const CheckSeries& series, const Find& find, const Differ& differ)
{
  const auto middle = series.begin() + static_cast<std::ptrdiff_t>(series.size() / 2);
  const auto first = find(CheckSeries(series.begin(), middle));
  const auto second = find(CheckSeries(middle, series.end()));
  const bool change = first && second && differ(*first, *second);
  return change ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

}  // namespace

SlopeSums& SlopeSums::operator+=(const SlopeSums& other)
{
  grains += other.grains, xx += other.xx, xy += other.xy, yy += other.yy;
  xx_xx += other.xx_xx, xx_xy += other.xx_xy, xy_xy += other.xy_xy;
  return *this;
}

CheckNumbers in_si(CheckNumbers numbers, const Units& units)
{
  const double acceleration = units.acceleration(), square = acceleration * acceleration;
  numbers.time *= units.time;
  numbers.acceleration *= acceleration;
  for (auto* estimate : {&numbers.all, &numbers.smaller, &numbers.larger}) {
    estimate->gravity *= acceleration;
    estimate->error *= acceleration;
  }
  auto& force = numbers.force;
  for (auto* sum : {&force.xx, &force.xy, &force.yy}) *sum *= square;
  for (auto* sum : {&force.xx_xx, &force.xx_xy, &force.xy_xy}) *sum *= square * square;
  return numbers;
}

const std::vector<Observable>& check_observables()
{
  static const std::vector<Observable> all{{"check_distance", ""}, {"check_gap", ""},
                                           {"check_overlap", ""},  {"check_pull", ""},
                                           {"check_unlisted", ""}, {"check_balance", ""}};
  return all;
}

std::vector<double> check_values(const CheckNumbers& numbers)
{
  return {numbers.distance, numbers.gap,      numbers.overlap,
          numbers.pull,     numbers.unlisted, numbers.balance};
}

std::optional<Estimate> gravity_from(const CheckSeries& series,
                                     GravityEstimate CheckNumbers::*which)
{
  std::vector<Weighted> medians, sums;
  double squared_within = 0, grains = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto& of = series[k].*which;
    if (of.grains == 0) continue;
    if (series[k].medians != 0) {
      medians.push_back({of.grains, of.gravity});
      const double error = std::hypot(of.error, digits * series[k].acceleration);
      squared_within += of.grains * of.grains * error * error;
    } else if (k > 0) {
      sums.push_back({series[k].time - series[k - 1].time, of.gravity});
      grains += of.grains;
    }
  }
  if (!medians.empty()) return from_medians(medians, squared_within);
  const std::size_t n = sums.size();
  if (n < fewest_pairs) return std::nullopt;
  Estimate estimate;
  estimate.value = mean_of(sums);
  estimate.frames = n;
  estimate.grains = grains / static_cast<double>(n);
  const auto lag = static_cast<std::size_t>(std::cbrt(static_cast<double>(n)));
  estimate.error = std::sqrt(squared_error(sums, estimate.value, lag));
  return estimate;
}

std::optional<Slope> slope_of(const SlopeSums& s)
{
  if (s.grains < fewest_grains || !(s.xx > 0) || !(s.yy > 0)) return std::nullopt;
  Slope slope;
  slope.grains = s.grains;
  slope.value = s.xy / s.xx;
  slope.doubt = std::max(0.0, 1 - s.xy * s.xy / (s.xx * s.yy));
  if (slope.doubt > largest_rest || !(slope.value > 0)) return std::nullopt;
  const double k = slope.value;
  slope.error = std::sqrt(std::max(0.0, s.xy_xy - 2 * k * s.xx_xy + k * k * s.xx_xx)) / s.xx;
  return slope;
}

SlopeSums sums_of(const CheckSeries& series, SlopeSums CheckNumbers::*which)
{
  SlopeSums sums;
  for (const auto& numbers : series) sums += numbers.*which;
  return sums;
}

std::optional<Halves<Estimate>> change_of_gravity(const CheckSeries& series, double tolerance)
{
  return differing_halves(
      series, [](const CheckSeries& half) { return gravity_from(half, &CheckNumbers::all); },
      [&](const Estimate& first, const Estimate& second) {
        return !((second.value - first.value).norm() <=
                 std::max(tolerance, 5 * std::hypot(first.error, second.error)));
      });
}

std::string in_words(const Slope& slope, const std::string& what)
{
  return fmt::format("{:.4g} times {} (limits: {:g} and {:g}), with a standard error of {:.2g}",
                     slope.value, what, 1 - slope_tolerance, 1 + slope_tolerance, slope.error);
}

std::string why_undecided(const Slope& slope)
{
  return slope.uncertainty() > sharp_slope
             ? fmt::format("a verdict needs an uncertainty of at most {:g}", sharp_slope)
             : "it lies beyond a limit by less than its uncertainty";
}

std::optional<Halves<Slope>> change_of_slope(const CheckSeries& series,
                                             SlopeSums CheckNumbers::*which)
{
  return differing_halves(
      series, [&](const CheckSeries& half) { return slope_of(sums_of(half, which)); },
      [](const Slope& first, const Slope& second) {
        return !(std::abs(second.value - first.value) <=
                 slope_tolerance + (first.uncertainty() + second.uncertainty()));
      });
}

}  // namespace grseg
