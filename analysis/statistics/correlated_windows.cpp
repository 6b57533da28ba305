// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/correlated_windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace grseg {
namespace {

// With fewer windows their correlation is hardly known (docs/studies/uncertainty.md).
constexpr std::size_t fewest_windows = 12;
// Least variance of the waves, relative to the sum over all windows, without a doubt.
constexpr double slow_enough = 0.5;

/// Calls of(first, count) for the windows of each run.
template <class Of>
void for_runs(const RunLengths& runs, const Of& of)
{
  Eigen::Index first = 0;
  for (const auto length : runs) {
    of(first, index(length));
    first += index(length);
  }
}

/// The series minus the mean of each run.
Eigen::VectorXd about_run_means(Eigen::VectorXd series, const RunLengths& runs)
{
  for_runs(runs, [&](Eigen::Index first, Eigen::Index count) {
    auto run = series.segment(first, count);
    if (count > 0) run.array() -= run.mean();
  });
  return series;
}

/// Correlation of windows of one run as a function of the windows between them, `lag`.
class Correlation {
 public:
  Correlation(const Eigen::VectorXd& series, const RunLengths& runs)
      : series_(about_run_means(series, runs)),
        runs_(runs),
        square_(series_.squaredNorm()),
        windows_per_run_(static_cast<double>(number_of_windows(runs)) /
                         static_cast<double>(runs.size()))
  {
  }

  bool is_known() const { return square_ > 0; }
  double at(std::size_t lag) const
  {
    double sum = 0;
    for_runs(runs_, [&](Eigen::Index first, Eigen::Index count) {
      const auto left = count - index(lag);
      if (left > 0)
        sum += series_.segment(first, left).dot(series_.segment(first + index(lag), left));
    });
    return sum / square_;
  }
  /// Correlation of neighbours, corrected for its bias -(1 + 3 rho)/n in n windows (Kendall 1954).
  double of_neighbours() const
  {
    const double n = windows_per_run_;
    return n < 4 || !is_known() ? 0 : std::min((n * at(1) + 1) / (n - 3), 1 - 2 / n);
  }
  /// 1 + 2 sum of the correlation to the first lag >= 5 times the result. The last factor corrects
  /// for the subtracted mean of n windows, which lowers each term (Wolff 2004).
  double summed() const
  {
    double time = 1;
    std::size_t lag = 1;
    for (; static_cast<double>(lag) < windows_per_run_; ++lag) {
      time += 2 * at(lag);
      if (static_cast<double>(lag) >= 5 * time) break;
    }
    return time * (1 + (2 * static_cast<double>(lag) + 1) / windows_per_run_);
  }

 private:
  Eigen::VectorXd series_;
  const RunLengths& runs_;
  double square_, windows_per_run_;
};

/// The waves of one run.
class Waves {
 public:
  /// `taken`: rows of the run, or no columns (deviation_of_windows).
  Waves(const Eigen::VectorXd& weight, std::size_t runs, const Eigen::MatrixXd& taken)
      : weight_(weight), phase_(std::numbers::pi * middles(weight))
  {
    const double wanted =
        std::max(runs == 1 ? 2.0 : 1.0, std::pow(effective_number(weight), 2.0 / 3) / 4);
    for (Eigen::Index j = 1; j < weight.size() && left_ < wanted; ++j) {
      left_part_.push_back(left_of(j, taken));
      count_.push_back(std::min(1.0, (wanted - left_) / left_part_.back()));
      left_ += count_.back() * left_part_.back();
    }
  }

  std::size_t number() const { return count_.size(); }
  /// Wave j = 1, 2, ..., number() at each window.
  Eigen::ArrayXd wave(std::size_t j) const { return (static_cast<double>(j) * phase_).cos(); }
  /// Weight of wave j: 1, or less for the last one.
  double count(std::size_t j) const { return count_[j - 1]; }
  double degrees() const
  {
    double squares = 0;
    for (std::size_t j = 1; j <= number(); ++j) squares += std::pow(counted(j), 2);
    return left_ * left_ / squares;
  }
  /// Sum of the parts that the waves keep of a slow wave's variance, if the noise before the fit to
  /// composition is an AR(1) series with the neighbours' correlation rho.
  double kept(double rho) const
  {
    double sum = 0;
    for (std::size_t j = 1; j <= number(); ++j) {
      const double phase =
          std::numbers::pi * static_cast<double>(j) / static_cast<double>(weight_.size());
      sum += counted(j) * (1 - rho) * (1 - rho) / (1 - 2 * rho * std::cos(phase) + rho * rho);
    }
    return sum;
  }
  /// The part of a slow wave's variance that the waves keep on average.
  double mean_kept(double rho) const { return kept(rho) / left_; }

 private:
  double counted(std::size_t j) const { return count_[j - 1] * left_part_[j - 1]; }
  /// Middle of each window as the fraction of the weight before it.
  static Eigen::ArrayXd middles(const Eigen::VectorXd& weight)
  {
    Eigen::ArrayXd middle(weight.size());
    double before = 0;
    for (Eigen::Index k = 0; k < weight.size(); before += weight[k++])
      middle[k] = before + weight[k] / 2;
    return middle / before;
  }
  /// Part of wave j that the fit to composition leaves.
  double left_of(Eigen::Index j, const Eigen::MatrixXd& taken) const
  {
    if (taken.cols() == 0) return 1;
    const Eigen::VectorXd cosine = wave(static_cast<std::size_t>(j));
    const Eigen::VectorXd rest = cosine.array() - weight_.dot(cosine) / weight_.sum();
    const double all = weight_.dot(rest.cwiseAbs2());
    return std::max(least_left, 1 - (taken.transpose() * rest).squaredNorm() / all);
  }

  static constexpr double least_left = 1e-3;  // so that a wave that is gone does not count
  Eigen::VectorXd weight_;
  Eigen::ArrayXd phase_;
  std::vector<double> count_, left_part_;
  double left_ = 0;
};

}  // namespace

std::size_t number_of_windows(const RunLengths& runs)
{
  return std::accumulate(runs.begin(), runs.end(), std::size_t{0});
}

Eigen::VectorXd by_run(const Eigen::VectorXd& of_windows, const RunLengths& runs)
{
  std::vector<double> sums;
  for_runs(runs, [&](Eigen::Index first, Eigen::Index count) {
    sums.push_back(of_windows.segment(first, count).sum());
  });
  return Eigen::VectorXd::Map(sums.data(), index(sums.size()));
}

Deviation deviation_of_windows(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight,
                               const RunLengths& runs, const Eigen::MatrixXd& taken)
{
  std::vector<double> parts;
  double whole = 0, squares = 0;
  const double rho = std::max(0.0, Correlation(influence, runs).of_neighbours());
  for_runs(runs, [&](Eigen::Index first, Eigen::Index count) {
    const Eigen::VectorXd own = weight.segment(first, count);
    if (count < 2 || !(own.sum() > 0)) return;
    const Eigen::ArrayXd noise =
        influence.segment(first, count) - influence.segment(first, count).sum() / own.sum() * own;
    const Waves waves(own, runs.size(), taken.rows() == 0 ? taken : taken.middleRows(first, count));
    const double kept = waves.kept(rho);
    for (std::size_t j = 1; j <= waves.number(); ++j)
      parts.push_back(std::sqrt(2 * waves.count(j) / kept) * (noise * waves.wave(j)).sum());
    whole += own.sum();
    squares += own.sum() * own.sum() / waves.degrees();
  });
  if (parts.empty() || !influence.allFinite()) return {};
  return {Eigen::VectorXd::Map(parts.data(), index(parts.size())), whole * whole / squares};
}

double autocorrelation_time(const Eigen::VectorXd& series, const RunLengths& runs)
{
  const Correlation correlation(series, runs);
  if (!correlation.is_known()) return 1;
  const double rho = correlation.of_neighbours();
  return std::max({1.0, correlation.summed(), (1 + rho) / (1 - rho)});
}

StandardError standard_error(const Eigen::VectorXd& influence, int fitted)
{
  const auto n = static_cast<double>(influence.size());
  if (n < 2 || !influence.allFinite()) return Measured{}.error;
  const double time = autocorrelation_time(influence, {static_cast<std::size_t>(influence.size())});
  const double degrees = n / time - fitted;
  if (!(degrees >= least_degrees)) return Measured{}.error;
  return {std::sqrt(influence.squaredNorm() * time * (degrees + fitted) / degrees), degrees};
}

std::string doubt_of_windows(const Eigen::VectorXd& noise, const Eigen::VectorXd& weight,
                             const RunLengths& runs)
{
  const auto windows = number_of_windows(runs);
  if (windows == 1)
    return "one window is one observation, too few for an interval; make more with a shorter --window";
  if (windows < fewest_windows)
    return fmt::format(
        "{} windows do not show how long they are correlated; make more with a shorter --window",
        windows);
  const double rho = std::max(0.0, Correlation(noise, runs).of_neighbours());
  double kept = 0;
  for_runs(runs, [&](Eigen::Index first, Eigen::Index count) {
    const Eigen::VectorXd own = weight.segment(first, count);
    if (count > 1) kept += own.sum() / weight.sum() * Waves(own, runs.size(), {}).mean_kept(rho);
  });
  if (kept >= slow_enough) return {};
  return fmt::format(
      "windows are correlated over {:.2g} windows, long for {} windows in {} run{}: an interval of "
      "95 % over windows contains the true value less often; a longer run is needed",
      (1 + rho) / (1 - rho), windows, runs.size(), runs.size() == 1 ? "" : "s");
}

}  // namespace grseg
