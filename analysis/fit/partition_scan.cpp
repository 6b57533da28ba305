// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/partition_scan.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace grseg {
namespace {

PartitionRule uniform(double share)
{
  return {PartitionRule::Kind::uniform, share};
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
  PartitionScan scan;
  const double zero =
      line_over_share(data, settings, Bootstrap(data.runs, 0, 1), settings.over).p_zero.value;
  const double nearest = std::isfinite(zero) ? std::clamp(zero, 0.0, 1.0) : shares.front();
  const auto at_nearest = dependence(data, uniform(nearest), settings);
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
  scan.line = line_over_share(data, settings, bootstrap, scan.fits.front().over);
  return scan;
}

}  // namespace grseg
