// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/steady_series.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

constexpr std::size_t fewest_of_start = 10;
constexpr double fewest_independent = 2;

/// Number of windows in the first `fraction` of a run of this length.
Eigen::Index windows_in(double fraction, std::size_t length)
{
  return static_cast<Eigen::Index>(std::ceil(fraction * static_cast<double>(length) - 1e-9));
}

/// Noise of the windows: the difference of `above` from `below` times a line in each run.
Eigen::VectorXd noise_about_lines(const Series& series, const RunLengths& runs)
{
  Eigen::VectorXd noise = series.above;
  Eigen::Index begin = 0;
  for (const auto length : runs) {
    const auto n = index(length);
    const auto weight = series.below.segment(begin, n);
    Eigen::MatrixX2d line(n, 2);
    line.col(0) = weight;
    line.col(1) = weight.cwiseProduct(Eigen::VectorXd::LinSpaced(n, -1, 1));
    auto own = noise.segment(begin, n);
    own -= line * line.colPivHouseholderQr().solve(Eigen::VectorXd(own));
    begin += n;
  }
  return noise;
}

/// Sums of `values` over the first and the last third of each run.
std::array<double, 2> sums_of_thirds(const Eigen::VectorXd& values, const RunLengths& runs)
{
  std::array<double, 2> sums{};
  Eigen::Index end = 0;
  for (const auto length : runs) {
    const auto third = index(length) / 3;
    sums[0] += values.segment(end, third).sum();
    end += index(length);
    sums[1] += values.segment(end - third, third).sum();
  }
  return sums;
}

/// The first tenth and the last half of one run.
Change start_of_run(const Eigen::VectorXd& run)
{
  const auto early = run.size() / 10, late = run.size() / 2;
  const Eigen::VectorXd last = run.tail(late);
  Change start{run.head(early).mean(), last.mean()};
  const double time = autocorrelation_time(last, {static_cast<std::size_t>(late)});
  const double independent = static_cast<double>(late) / time;
  if (independent < fewest_independent) return start;
  const double squares = (last.array() - last.mean()).square().sum();
  // Correlation reduces the sum of squares about the mean by (n_eff - 1)/n_eff.
  const double variance = squares / static_cast<double>(late) * independent / (independent - 1);
  start.error = {std::sqrt(variance * (1 / std::max(1.0, static_cast<double>(early) / time) +
                                       1 / independent)),
                 independent - 1};
  return start;
}

}  // namespace

Series Series::without_start(double fraction, RunLengths& runs) const
{
  Series rest{Eigen::VectorXd(above.size()), Eigen::VectorXd(below.size())};
  Eigen::Index first = 0, kept = 0;
  for (auto& length : runs) {
    const auto start = windows_in(fraction, length), left = index(length) - start;
    rest.above.segment(kept, left) = above.segment(first + start, left);
    rest.below.segment(kept, left) = below.segment(first + start, left);
    first += index(length);
    kept += left;
    length = static_cast<std::size_t>(left);
  }
  rest.above.conservativeResize(kept);
  rest.below.conservativeResize(kept);
  return rest;
}

double Change::chance() const
{
  const double t = std::abs(size()) / error.error;  // infinite without any noise
  return !is_known() || std::isnan(t) ? 1 : 2 * gsl_cdf_tdist_Q(t, error.degrees);
}

std::optional<Change> change_of(const Series& series, const RunLengths& runs)
{
  if (std::ranges::any_of(runs, [](std::size_t length) { return length < 3; })) return {};
  const auto above = sums_of_thirds(series.above, runs), below = sums_of_thirds(series.below, runs);
  Change change{above[0] / below[0], above[1] / below[1]};
  const auto noise = noise_about_lines(series, runs);
  const double time = autocorrelation_time(noise, runs);
  const double independent = static_cast<double>(noise.size()) / time;
  const double degrees = independent - 2 * static_cast<double>(runs.size());
  if (!(degrees >= fewest_independent)) return change;
  const double variance = noise.squaredNorm() / static_cast<double>(noise.size()) * independent /
                          degrees * time;  // of a sum over windows, per window
  const auto count = sums_of_thirds(Eigen::VectorXd::Ones(noise.size()), runs);
  change.error = {
      std::sqrt(variance * (count[0] / (below[0] * below[0]) + count[1] / (below[1] * below[1]))),
      degrees};
  return change;
}

std::optional<Change> start_of(const Series& series, const RunLengths& runs)
{
  if (std::ranges::any_of(runs, [](std::size_t length) { return length < fewest_of_start; }))
    return {};
  std::vector<StandardError> errors;
  Change start;
  Eigen::Index begin = 0;
  for (const auto length : runs) {
    const auto run = start_of_run(series.above.segment(begin, index(length)));
    begin += index(length);
    start.first += run.first / static_cast<double>(runs.size());
    start.last += run.last / static_cast<double>(runs.size());
    errors.push_back({run.error.error / static_cast<double>(runs.size()), run.error.degrees});
  }
  start.error = added(errors);
  if (std::isnan(start.error.error)) start.error.degrees = 0;
  return start;
}

double start_to_leave_out(const Series& series, const RunLengths& runs,
                          const std::function<bool(const Series&, const RunLengths&)>& is_steady)
{
  for (int twentieths = 0; twentieths <= 10; ++twentieths) {
    auto left = runs;
    const auto rest = series.without_start(twentieths / 20.0, left);
    if (is_steady(rest, left)) return twentieths / 20.0;
  }
  return 1;
}

double seen_start(const Series& series, const RunLengths& runs)
{
  double least = rarely;
  return start_to_leave_out(series, runs, [&](const Series& rest, const RunLengths& left) {
    const auto start = start_of(rest, left);
    return !start || !(start->chance() < std::exchange(least, unseen));
  });
}

}  // namespace grseg
