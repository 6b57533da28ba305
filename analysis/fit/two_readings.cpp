// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/two_readings.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/flows.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace grseg {
namespace {

/// Table, begin and end (s) of each window.
std::vector<std::tuple<std::size_t, double, double>> windows_of(const FitData& data)
{
  std::vector<std::tuple<std::size_t, double, double>> windows(number_of_windows(data.runs));
  for (const auto& sample : data.samples)
    windows[sample.window] = {sample.table, sample.key.begin, sample.key.end};
  return windows;
}

/// The part of `data` in windows that `other` has, too.
FitData in_common(const FitData& data, const FitData& other)
{
  const auto known = windows_of(other);
  std::vector<bool> keep;
  for (const auto& window : windows_of(data))
    keep.push_back(std::ranges::find(known, window) != known.end());
  if (std::ranges::count(keep, true) == 0)
    throw UsageError(
        "--minus: the two readings have no window in common; make both with the same --window and "
        "--begin");
  return of_windows(data, keep);
}

FitData data_of(const RuleFit& fit, const FitSource& source)
{
  const auto data = select_fit_data(source.tables, source.quantity, source.filters, {fit.pair});
  return fit.flow ? of_flow(data, *fit.flow) : data;
}

}  // namespace

void require_same_runs(const std::vector<Table>& tables, const std::vector<Table>& others)
{
  if (tables.size() != others.size())
    throw UsageError(fmt::format(
        "--minus: {} to compare with {}; name as many, of the same runs in the same order",
        counted(tables.size(), "table"), others.size()));
  const auto is_known = [](const Table& table) { return table.has_header("input"); };
  for (std::size_t k = 0; k < tables.size(); ++k)
    if (is_known(tables[k]) && is_known(others[k]) &&
        kinship(sources_of(tables[k]), sources_of(others[k])) != Kinship::same_motion)
      throw UsageError(fmt::format(
          "--minus: {} and {} are not of the same run; name tables of the same runs in the same order",
          tables[k].name, others[k].name));
}

void add_differences(std::vector<RuleFit>& fits, const FitSource& source, const FitSource& other,
                     const FitSettings& settings)
{
  for (auto& fit : fits) {
    if (!fit.rule.adds_up()) continue;
    const auto all = data_of(fit, source), all_others = data_of(fit, other);
    const auto data = in_common(all, all_others);
    const auto others = fit_points(in_common(all_others, all), fit.rule, settings);
    const auto points = fit_points(data, fit.rule, settings);
    const auto windows = window_sums(points, data.runs);
    auto of_common = fit;
    of_common.value = estimators_of(points);
    fit.minus_other = minus(of_common, data, windows, others);
  }
}

}  // namespace grseg
