// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/times.hpp"

#include "analysis/statistics/exponential_approach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

using Moment = SegregationMoment;

Eigen::VectorXd series(const std::vector<Moment>& moments, double Moment::*place)
{
  Eigen::VectorXd values(static_cast<Eigen::Index>(moments.size()));
  for (Eigen::Index k = 0; k < values.size(); ++k)
    values[k] = moments[static_cast<std::size_t>(k)].*place;
  return values;
}

/// The exponential approach of y_L, fitted against time or against strain.
void add_approach(const std::vector<Moment>& moments, bool against_time,
                  SegregationSummary& summary)
{
  const auto x = series(moments, against_time ? &Moment::time : &Moment::strain);
  const auto y = series(moments, &Moment::large);
  const auto fit = fit_approach(x, y);
  const char* unit = against_time ? "[s]" : "_strain";
  const char* kind = against_time ? "" : "_strain";
  summary.numbers.emplace_back(fmt::format("y_L_start{}[m]", kind), fit.start);
  summary.numbers.emplace_back(fmt::format("y_L_end{}[m]", kind), fit.end);
  summary.numbers.emplace_back(fmt::format("tau{}", unit), fit.scale);
  for (const auto& [name, part] : {std::pair{"t50", 0.5}, {"t90", 0.9}}) {
    const auto when = time_to(part, fit, x, y);
    summary.numbers.emplace_back(fmt::format("{}{}", name, unit), when);
    if (fit.trouble.empty() && std::isnan(when.value))
      summary.remarks.push_back(
          fmt::format("{}{}: the run ends before y_L has covered {:g} % of the way to {:.4g} m",
                      name, unit, 100 * part, fit.end.value));
  }
  if (!fit.trouble.empty())
    summary.remarks.push_back(
        fmt::format("no exponential approach fits y_L over {}: it {}; try a longer run or another "
                    "--begin",
                    against_time ? "time" : "strain", fit.trouble));
}

/// Means over one window.
struct WindowMean {
  double time, strain, mixing, error;
};

std::vector<WindowMean> window_means(const std::vector<Moment>& moments,
                                     const std::vector<std::size_t>& windows)
{
  std::vector<WindowMean> means;
  auto first = moments.begin();
  for (const auto count : windows) {
    const std::vector<Moment> own(first, first + static_cast<std::ptrdiff_t>(count));
    first += static_cast<std::ptrdiff_t>(count);
    const auto mixing = series(own, &Moment::mixing);
    const Eigen::VectorXd excess = mixing.array() - mixing.mean();
    const auto frames = static_cast<double>(mixing.size());
    const double error = standard_error(excess / frames, 1).error;
    // NaN where all frames depend on each other; then they count as one value.
    means.push_back({series(own, &Moment::time).mean(), series(own, &Moment::strain).mean(),
                     mixing.mean(),
                     std::isnan(error) ? std::sqrt(excess.squaredNorm() / frames) : error});
  }
  return means;
}

Estimate about(const WindowMean& mean)
{
  return {mean.mixing, mean.mixing - 1.96 * mean.error, mean.mixing + 1.96 * mean.error};
}

void add_mixing(const std::vector<Moment>& moments, const std::vector<std::size_t>& windows,
                SegregationSummary& summary)
{
  const auto means = window_means(moments, windows);
  const auto most = std::max_element(
      means.begin(), means.end(), [](const auto& a, const auto& b) { return a.mixing < b.mixing; });
  summary.numbers.emplace_back("mixing_start", about(means.front()));
  summary.numbers.emplace_back("mixing_most", about(*most));
  summary.numbers.emplace_back("mixing_end", about(means.back()));
  Estimate time, strain;
  const bool known = most + 1 != means.end() && most != means.begin();
  if (known) {
    const auto alike = [&](const WindowMean& mean) {
      return most->mixing - mean.mixing <= 1.96 * std::hypot(most->error, mean.error);
    };
    const auto first = std::find_if(means.begin(), means.end(), alike);
    const auto last = std::find_if(means.rbegin(), means.rend(), alike);
    const auto from = [&](double x, double WindowMean::*place, double origin) {
      return Estimate{x - origin, (*first).*place - origin, (*last).*place - origin};
    };
    time = from(most->time, &WindowMean::time, moments.front().time);
    strain = from(most->strain, &WindowMean::strain, moments.front().strain);
  } else {
    summary.remarks.push_back(
        fmt::format("t_mixing: mixing is largest in the {} window, so its time is not known",
                    means.size() == 1       ? "only"
                    : most == means.begin() ? "first"
                                            : "last"));
  }
  summary.numbers.emplace_back("t_mixing[s]", time);
  summary.numbers.emplace_back("t_mixing_strain", strain);
}

}  // namespace

SegregationSummary segregation_times(const std::vector<Moment>& moments,
                                     const std::vector<std::size_t>& windows)
{
  SegregationSummary summary;
  add_approach(moments, true, summary);
  add_approach(moments, false, summary);
  add_mixing(moments, windows, summary);
  return summary;
}

}  // namespace grseg
