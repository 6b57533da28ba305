// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/bootstrap.hpp"

#include "analysis/frames/sums.hpp"

#include <fmt/format.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace grseg {
namespace {

// With fewer windows, the estimated correlation time is sometimes too short, and hides that too few
// windows are independent (docs/studies/uncertainty.md).
constexpr std::size_t enough_windows = 120;

using Rng = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;

Rng seeded(unsigned long seed)
{
  Rng rng(gsl_rng_alloc(gsl_rng_mt19937), &gsl_rng_free);
  gsl_rng_set(rng.get(), seed);
  return rng;
}

std::size_t draw_below(std::size_t n, Rng& rng)
{
  return static_cast<std::size_t>(gsl_rng_uniform_int(rng.get(), n));
}

/// Sample variance of the finite replicates; NaN if more than 5 % of them are not finite.
double variance(const Eigen::VectorXd& replicates)
{
  double n = 0, mean = 0, squares = 0;
  for (const double value : replicates) {
    if (!std::isfinite(value)) continue;
    n += 1;
    const double step = value - mean;
    mean += step / n;
    squares += step * (value - mean);
  }
  return n > 1 && n >= 0.95 * static_cast<double>(replicates.size()) ? squares / (n - 1)
                                                                     : no_number;
}

/// Variance of the mean over independent blocks of `length` windows of an AR(1) series, relative to
/// the uncut series, in which windows on both sides of a cut are correlated, too.
double kept_in_blocks(double time, std::size_t length)
{
  const double rho = neighbour_correlation(time), b = static_cast<double>(length);
  return 1 - 2 * rho * (1 - std::pow(rho, b)) / (b * (1 - rho * rho));
}

/// "1 window", "1.6 windows".
std::string counted(const std::string& number, const char* thing)
{
  return fmt::format("{} {}{}", number, thing, number == "1" ? "" : "s");
}

}  // namespace

Bootstrap::Bootstrap(RunLengths runs, std::size_t samples, unsigned long seed)
    : runs_(std::move(runs)), samples_(samples), seed_(seed)
{
}

std::size_t Bootstrap::windows() const
{
  return number_of_windows(runs_);
}

const Eigen::MatrixXd& Bootstrap::blocks(std::size_t length) const
{
  const auto [entry, fresh] = blocks_.try_emplace(length);
  Eigen::MatrixXd& times = entry->second;
  if (!fresh) return times;
  auto rng = seeded(seed_);
  times.setZero(index(samples_), index(number_of_windows(runs_)));
  for (std::size_t sample = 0; sample < samples_; ++sample) {
    std::size_t first = 0;
    for (const auto windows : runs_) {
      const std::size_t block = std::min(length, windows);
      for (std::size_t drawn = 0; drawn < windows; drawn += block) {
        const std::size_t start = first + draw_below(windows - block + 1, rng);
        const std::size_t part = std::min(block, windows - drawn);
        times.row(index(sample)).segment(index(start), index(part)).array() += 1;
      }
      first += windows;
    }
  }
  return times;
}

const Eigen::MatrixXd& Bootstrap::whole_runs() const
{
  if (runs_.size() < 2) whole_runs_.resize(0, index(number_of_windows(runs_)));
  if (runs_.size() < 2 || whole_runs_.size() > 0) return whole_runs_;
  std::vector<std::size_t> first(runs_.size(), 0);
  std::exclusive_scan(runs_.begin(), runs_.end(), first.begin(), std::size_t{0});
  auto rng = seeded(seed_);
  whole_runs_.setZero(index(samples_), index(number_of_windows(runs_)));
  for (std::size_t sample = 0; sample < samples_; ++sample)
    for (std::size_t drawn = 0; drawn < runs_.size(); ++drawn) {
      const std::size_t run = draw_below(runs_.size(), rng);
      whole_runs_.row(index(sample)).segment(index(first[run]), index(runs_[run])).array() += 1;
    }
  return whole_runs_;
}

const Eigen::MatrixXd& Bootstrap::samples(const Dependence& dependence) const
{
  return runs_.size() > 1 ? whole_runs() : blocks(dependence.block);
}

Estimate Bootstrap::estimate(double value, const Eigen::VectorXd& samples,
                             const Dependence& dependence) const
{
  return (runs_.size() > 1 ? run_error(samples, dependence) : window_error(samples, dependence))
      .around(value);
}

double Bootstrap::window_degrees(const Dependence& dependence) const
{
  return dependence.effective_windows / static_cast<double>(dependence.block) -
         static_cast<double>(runs_.size());
}

StandardError Bootstrap::window_error(const Eigen::VectorXd& samples,
                                      const Dependence& dependence) const
{
  const double degrees = window_degrees(dependence);
  const double fitted = (degrees + static_cast<double>(runs_.size())) / degrees;
  return {std::sqrt(variance(samples) * fitted / kept_in_blocks(dependence.time, dependence.block)),
          degrees};
}

StandardError Bootstrap::run_error(const Eigen::VectorXd& samples,
                                   const Dependence& dependence) const
{
  const double degrees = dependence.effective_runs - 1;
  return {std::sqrt(variance(samples) * dependence.effective_runs / degrees), degrees};
}

std::string Bootstrap::doubt(const Dependence& dependence) const
{
  return runs_.size() > 1 ? doubt_of_runs(dependence) : doubt_of_windows(dependence);
}

std::string Bootstrap::doubt_of_runs(const Dependence& dependence) const
{
  if (samples_ == 0 || dependence.effective_runs > 3.5) return {};
  return fmt::format(
      "{} runs, worth {:.3g} of equal weight, show {} how runs differ; more runs give a narrower "
      "interval",
      runs_.size(), dependence.effective_runs,
      dependence.effective_runs < 1 + least_degrees ? "nothing of" : "little of");
}

std::string Bootstrap::doubt_of_windows(const Dependence& dependence) const
{
  if (samples_ == 0) return {};
  if (windows() == 1) return "one window is one observation, too few for an interval";
  const double per_run = dependence.independent_windows() / static_cast<double>(runs_.size());
  // 7.95 and more are printed as 8.
  if (dependence.independent_windows() >= 7.95) {
    if (windows() < enough_windows)
      return fmt::format(
          "{} windows are too few to measure how long they are correlated; with fewer than {} an "
          "interval of 95 % over windows contains the true value less often if that time is longer",
          windows(), enough_windows);
    if (runs_.size() == 1 || per_run >= 4.95) return {};
    return fmt::format(
        "the windows of each run are worth {:.2g} independent ones; with fewer than 5 an interval "
        "of 95 % over windows contains the true value less often",
        per_run);
  }
  return fmt::format(
      "{} with an autocorrelation time of {} are worth {}; {}",
      counted(fmt::format("{:.3g}", dependence.effective_windows), "window"),
      counted(fmt::format("{:.3g}", dependence.time), "window"),
      counted(fmt::format("{:.2g}", dependence.independent_windows()), "independent one"),
      window_degrees(dependence) < least_degrees
          ? "too few for an interval"
          : "with fewer than 8 an interval of 95 % contains the true value less often");
}

}  // namespace grseg
