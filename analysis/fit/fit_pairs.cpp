// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_pairs.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/flows.hpp"
#include "analysis/frames/grouping.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>
#include <utility>

namespace grseg {
namespace {

/// Points scaled so that minus the weighted mean of ln(y/x) is the exponent a: logarithms are
/// divided by ln r, and weights multiplied by (ln r)^2, which gives the least-squares slope.
std::vector<FitPoint> points_per_size(const std::vector<FitPoint>& points)
{
  std::vector<FitPoint> scaled;
  for (auto point : points) {
    const double size = std::log(point.size_ratio);
    if (!point.has_logarithm() || !(size > 0)) continue;
    const double slope = std::pow(point.small / point.large / point.ratio(), 1 / size);
    point.weight *= size * size;
    point.large = 1;
    point.small = slope * point.ratio();
    point.total = point.small + point.large;
    scaled.push_back(point);
  }
  return scaled;
}

}  // namespace

Estimate size_exponent(const FitData& data, const PartitionRule& rule, const FitSettings& settings)
{
  const auto points = points_per_size(fit_points(data, rule, settings));
  constexpr auto exponent = &Estimators::minus_ln_s;
  const double a = estimators_of(points).*exponent;
  if (points.empty()) return {a, no_number, no_number};
  const auto windows = window_sums(points, data.runs);
  const auto over = resolved(settings.over, data.runs.size(), data.number_of_flows());
  return Errors(data, windows, exponent).over(over, influence_on(exponent, windows)).around(a);
}

FlowFits fit_flows(const FitData& data, const PartitionRule& rule, const FitSettings& settings)
{
  const auto fit = [&](const FitData& of, const FitSettings& how) {
    auto found = fit_rule(of, rule, how);
    found.line = line_over_share(of, how, found.over);
    return found;
  };
  FlowFits fits{fit(data, settings), {}};
  if (data.number_of_flows() == 1) return fits;
  auto of_one = settings;
  of_one.over = Population::automatic;
  for (const auto flow : std::set(data.flows.begin(), data.flows.end())) {
    fits.of_each.push_back(fit(of_flow(data, flow), of_one));
    fits.of_each.back().flow = flow;
  }
  return fits;
}

namespace {

std::size_t find_species(const std::string& word, const SpeciesList& species,
                         const std::string& text)
{
  if (const auto found = number_of_species(word, species)) return *found;
  throw UsageError(fmt::format("--pair {}: write two species of the table, as in {},{}; it has {}",
                               text, species.front().name, species.back().name,
                               fmt::join(names_of(species), ", ")));
}

}  // namespace

SpeciesPair parse_pair(const std::string& text, const SpeciesList& species)
{
  const auto comma = text.find(',');
  const auto a = find_species(text.substr(0, comma), species, text);
  const auto b =
      find_species(comma == std::string::npos ? "" : text.substr(comma + 1), species, text);
  if (a == b) throw UsageError(fmt::format("--pair {}: write two different species", text));
  return {std::min(a, b), std::max(a, b)};
}

std::vector<RuleFit> fit_pairs(const std::vector<FitTable>& tables, Quantity quantity,
                               const FitFilters& filters, const std::vector<SpeciesPair>& pairs,
                               const std::vector<PartitionRule>& rules, const FitSettings& settings,
                               bool with_exponent)
{
  const auto data = select_fit_data(tables, quantity, filters, pairs);
  std::vector<RuleFit> fits;
  for (const auto& rule : rules) {
    const auto first = fits.size();
    for (const auto& pair : pairs) {
      auto of_pair =
          fit_flows(pairs.size() == 1 ? data : select_fit_data(tables, quantity, filters, {pair}),
                    rule, settings);
      if (settings.over == Population::automatic)
        fits.insert(fits.end(), of_pair.of_each.begin(), of_pair.of_each.end());
      fits.push_back(std::move(of_pair.all));
    }
    if (!with_exponent || !rule.adds_up()) continue;
    const auto exponent = size_exponent(data, rule, settings);
    for (auto fit = first; fit < fits.size(); ++fit)
      if (!fits[fit].flow) fits[fit].size_exponent = exponent;
  }
  return fits;
}

std::vector<double> ScanRange::shares() const
{
  const auto count = static_cast<std::size_t>(std::floor((last - first) / step + 1e-6)) + 1;
  std::vector<double> all(count);
  // A product, rounded, instead of a running sum: 0.4 + 40 x 0.005 has to print as 0.6.
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
      !(range.step > 0 && std::isfinite(range.step)))
    throw UsageError(
        fmt::format("--scan {}: write first:last:step with 0 <= first <= last <= 1, "
                    "e.g. 0.4:0.9:0.005",
                    text));
  if ((range.last - range.first) / range.step > 1e5)
    throw UsageError(fmt::format("--scan {}: more than 100000 shares; use a larger step", text));
  return range;
}

PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings,
                             const std::function<void(double shares)>& tell)
{
  PartitionScan scan{fit_shares(data, range.shares(), settings, tell), {}};
  scan.line = line_over_share(data, settings, scan.fits.front().over);
  return scan;
}

}  // namespace grseg
