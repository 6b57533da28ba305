// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/partition_scan.hpp"

#include "analysis/fit/run_errors.hpp"
#include "analysis/statistics/composition_noise.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace grseg {
namespace {

PartitionRule uniform(double share)
{
  return {PartitionRule::Kind::uniform, share};
}

/// ln(y/x) of the points and its derivatives by p: sigma^L and sigma^S are linear in p.
struct LogSlopes {
  Eigen::VectorXd phi_large, weight, value, first, second;
  std::vector<std::size_t> window;

  double mean(const Eigen::VectorXd& quantity) const { return weight.dot(quantity) / weight.sum(); }
  /// What each window adds to the deviation of that mean, and what of it is noise.
  Eigen::VectorXd deviation(const Eigen::VectorXd& quantity, std::size_t windows) const
  {
    return by_window((quantity.array() - mean(quantity)) * weight.array() / weight.sum(), windows);
  }
  Eigen::VectorXd noise(const Eigen::VectorXd& quantity, std::size_t windows) const
  {
    return by_window(
        composition_noise(phi_large, quantity, weight).cwiseProduct(weight) / weight.sum(),
        windows);
  }
  Eigen::VectorXd by_window(const Eigen::VectorXd& part, std::size_t windows) const
  {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(windows));
    for (std::size_t k = 0; k < window.size(); ++k)
      sums[static_cast<Eigen::Index>(window[k])] += part[static_cast<Eigen::Index>(k)];
    return sums;
  }
};

LogSlopes log_slopes(const FitData& data, double share, const FitSettings& settings)
{
  const auto points = fit_points(data, uniform(share), settings);
  const auto none = fit_points(data, uniform(0), settings);
  const auto all = fit_points(data, uniform(1), settings);
  const auto size = static_cast<Eigen::Index>(points.size());
  LogSlopes at;
  for (auto* list : {&at.phi_large, &at.weight, &at.value, &at.first, &at.second})
    list->resize(size);
  Eigen::Index used = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto& point = points[k];
    if (!point.has_logarithm()) continue;
    // Counted at the grains' centres, what the small grain loses is in another layer.
    const double to_small = (none[k].small - all[k].small) / point.small;
    const double to_large = (all[k].large - none[k].large) / point.large;
    at.window.push_back(point.window);
    at.phi_large[used] = point.phi_large;
    at.weight[used] = point.weight;
    at.value[used] = std::log(point.small / point.large / point.ratio());
    at.first[used] = -to_small - to_large;
    at.second[used] = to_large * to_large - to_small * to_small;
    ++used;
  }
  for (auto* list : {&at.phi_large, &at.weight, &at.value, &at.first, &at.second})
    list->conservativeResize(used);
  return at;
}

/// Newton's method from a start that is already near.
double refine_zero(double share, const FitData& data, const FitSettings& settings)
{
  for (int step = 0; step < 8; ++step) {
    const auto at = log_slopes(data, share, settings);
    const double change = at.mean(at.value) / at.mean(at.first);
    if (!std::isfinite(change)) break;
    share -= change;
    if (std::abs(change) < 1e-14) break;
  }
  return share;
}

/// The share at which B is, of those listed, nearest to 0; exactly 0 where B changes its sign
/// between two of them, and then `crosses`.
struct Nearest {
  double share;
  bool crosses;
};

Nearest nearest_to_zero(const FitData& data, const std::vector<double>& shares,
                        const FitSettings& settings)
{
  std::vector<double> mean;
  for (const double share : shares) {
    const auto at = log_slopes(data, share, settings);
    mean.push_back(at.mean(at.value));
  }
  std::size_t least = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    if (std::abs(mean[k]) < std::abs(mean[least])) least = k;
    if (k > 0 && mean[k - 1] * mean[k] <= 0) return {refine_zero(shares[k], data, settings), true};
  }
  return {shares[least], mean[least] == 0};
}

/// Whole runs within their mixtures: what windows add to the zero, a Newton step away, and to the
/// slope there.
void add_intervals_of_runs(ZeroOfB& zero, const LogSlopes& at, const FitData& data)
{
  const double first = at.mean(at.first), second = at.mean(at.second);
  const auto windows = number_of_windows(data.runs);
  const RunErrors errors(data, at.by_window(at.weight, windows));
  const auto step = [&](const Eigen::VectorXd& value) -> Eigen::VectorXd { return -value / first; };
  const Eigen::VectorXd sums = step(at.deviation(at.value, windows)),
                        noise = step(at.noise(at.value, windows));
  zero.p_zero_interval = errors.within_mixtures(sums, noise).interval_around(zero.p_zero);
  zero.dB_dp_interval = errors
                            .within_mixtures(-at.deviation(at.first, windows) - second * sums,
                                             -at.noise(at.first, windows) - second * noise)
                            .interval_around(zero.dB_dp);
}

/// The slope at the zero and both intervals. B_half = 2 (1 - s)/(1 + s) and s = 1, hence
/// dB/dp = -d ln s/dp; a sample has its zero a Newton step away and its slope there.
ZeroOfB zero_at(double share, const FitData& data, const FitSettings& settings,
                const Bootstrap& bootstrap, const Dependence& dependence)
{
  const auto at = log_slopes(data, share, settings);
  const double first = at.mean(at.first), second = at.mean(at.second);
  ZeroOfB zero;
  zero.p_zero = share;
  zero.dB_dp = -first;
  if (bootstrap.count() == 0) return zero;
  const auto over = resolved(settings.over, data.runs.size(), data.number_of_mixtures());
  if (over == Over::runs || over == Over::mixtures) {
    add_intervals_of_runs(zero, at, data);
    return zero;
  }
  const bool windows = over == Over::windows;
  const auto& times = windows ? bootstrap.blocks(dependence.block) : bootstrap.whole_runs();
  const auto interval = [&](double estimate, const Eigen::VectorXd& samples) {
    return windows ? bootstrap.over_windows(estimate, samples, dependence)
                   : bootstrap.over_runs(estimate, samples, dependence);
  };
  const Eigen::ArrayXd value = times * at.noise(at.value, bootstrap.windows());
  const Eigen::ArrayXd slope = first + (times * at.noise(at.first, bootstrap.windows())).array();
  const Eigen::ArrayXd step = -value / slope;
  zero.p_zero_interval = interval(share, share + step);
  zero.dB_dp_interval = interval(zero.dB_dp, -slope - second * step);
  return zero;
}

}  // namespace

std::vector<double> ScanRange::shares() const
{
  const auto count = static_cast<std::size_t>(std::floor((last - first) / step + 1e-6)) + 1;
  std::vector<double> all(count);
  // Multiplying, not adding up: steps stay exact; 0.4 + 40 x 0.005 is to print as 0.6.
  for (std::size_t k = 0; k < count; ++k)
    all[k] = std::round((first + static_cast<double>(k) * step) * 1e12) / 1e12;
  return all;
}

ScanRange parse_scan(const std::string& text)
{
  ScanRange range;
  int used = 0;
  const int read =
      std::sscanf(text.c_str(), "%lf:%lf:%lf%n", &range.first, &range.last, &range.step, &used);
  const bool whole = read == 3 && static_cast<std::size_t>(used) == text.size();
  if (!whole || !(range.first >= 0 && range.first <= range.last && range.last <= 1) ||
      !(range.step > 0))
    throw UsageError(
        fmt::format("--scan {}: write first:last:step with 0 <= first <= last <= 1, "
                    "e.g. 0.4:0.9:0.005",
                    text));
  if ((range.last - range.first) / range.step > 1e5)
    throw UsageError(fmt::format("--scan {}: more than 100000 shares; take a larger step", text));
  return range;
}

PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings, const Bootstrap& bootstrap,
                             const std::function<void(double shares)>& tell)
{
  const auto shares = range.shares();
  double done = 0;
  const auto tell_half = [&] {  // each share is met twice
    done += 0.5;
    if (tell) tell(done);
  };
  const auto nearest = nearest_to_zero(data, shares, settings);
  PartitionScan scan;
  const auto at_nearest = dependence(data, uniform(nearest.share), settings);
  scan.dependence = at_nearest;
  if (bootstrap.count() > 0)
    for (const double share : shares) {
      scan.dependence = worse(scan.dependence, dependence(data, uniform(share), settings));
      tell_half();
    }
  scan.dependence.block = at_nearest.block;
  for (const double share : shares) {
    scan.fits.push_back(fit_rule(data, uniform(share), settings, bootstrap, scan.dependence));
    tell_half();
  }
  scan.p_zero_sums = zero_of_sums(data, settings, bootstrap, scan.fits.front().over, at_nearest);
  if (nearest.crosses)
    static_cast<ZeroOfB&>(scan) = zero_at(nearest.share, data, settings, bootstrap, at_nearest);
  return scan;
}

ZeroOfB find_zero_of_b(const FitData& data, const ScanRange& range, const FitSettings& settings,
                       const Bootstrap& bootstrap)
{
  const auto nearest = nearest_to_zero(data, range.shares(), settings);
  if (!nearest.crosses) return {};
  const auto at_zero = dependence(data, uniform(nearest.share), settings);
  return zero_at(nearest.share, data, settings, bootstrap, at_zero);
}

}  // namespace grseg
