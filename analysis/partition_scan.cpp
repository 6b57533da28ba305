// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/partition_scan.hpp"

#include "formats/errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace grseg {
namespace {

PartitionRule uniform(double share)
{
  return {PartitionRule::Kind::uniform, share};
}

/// Where the polygon through (share, value) first passes 0; NaN where it does not.
double crossing(const std::vector<RuleFit>& fits, const Estimates RuleFit::*which)
{
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const double p = fits[k].rule.value, b = (fits[k].*which).B_half;
    if (b == 0) return p;
    if (k + 1 == fits.size()) break;
    const double next_p = fits[k + 1].rule.value, next_b = (fits[k + 1].*which).B_half;
    if (b * next_b < 0) return p - b * (next_p - p) / (next_b - b);
  }
  return Estimates::nan;
}

/// Weighted mean of ln(y/x) and its derivative by p: sigma^L and sigma^S are linear in p.
struct LogSlope {
  double value, derivative;
};

LogSlope log_slope(const FitData& data, double share, const FitSettings& settings)
{
  const auto points = fit_points(data, uniform(share), settings);
  const auto none = fit_points(data, uniform(0), settings);
  const auto all = fit_points(data, uniform(1), settings);
  double weight = 0, value = 0, derivative = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto& [window, phi_large, w, size_ratio, small, large, total] = points[k];
    if (!points[k].has_logarithm()) continue;
    const double mixed = all[k].large - none[k].large;
    weight += w;
    value += w * std::log(small / large / points[k].ratio());
    derivative -= w * mixed * (1 / small + 1 / large);
  }
  return {value / weight, derivative / weight};
}

/// Newton's method from a start that is already near.
double refine_zero(double share, const FitData& data, const FitSettings& settings)
{
  for (int step = 0; step < 8; ++step) {
    const auto at = log_slope(data, share, settings);
    const double change = at.value / at.derivative;
    if (!std::isfinite(change)) break;
    share -= change;
    if (std::abs(change) < 1e-14) break;
  }
  return share;
}

/// One for all shares, so that the band of B(p) does not jump where the block length would.
Dependence worst_dependence(const FitData& data, const ScanRange& range,
                            const FitSettings& settings)
{
  auto worst = dependence_of(data, uniform(range.first), settings);
  for (const double share : range.shares())
    worst = worse(worst, dependence_of(data, uniform(share), settings));
  return worst;
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
                             const FitSettings& settings, const Bootstrap& bootstrap)
{
  PartitionScan scan;
  scan.dependence = worst_dependence(data, range, settings);
  for (const double share : range.shares())
    scan.fits.push_back(fit_rule(data, uniform(share), settings, bootstrap, scan.dependence));
  const double near = crossing(scan.fits, &RuleFit::value);
  if (std::isnan(near)) return scan;
  scan.p_zero = refine_zero(near, data, settings);
  // B grows with p, so that its upper end crosses 0 first.
  scan.p_low = crossing(scan.fits, &RuleFit::high);
  scan.p_high = crossing(scan.fits, &RuleFit::low);
  // B_half = 2 (1 - s)/(1 + s) and s = 1, hence dB/dp = -d ln s/dp.
  scan.dB_dp = -log_slope(data, scan.p_zero, settings).derivative;
  return scan;
}

}  // namespace grseg
