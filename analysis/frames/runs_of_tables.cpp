// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/runs_of_tables.hpp"

#include "analysis/frames/run_kinship.hpp"
#include "analysis/frames/table_windows.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

namespace grseg {
namespace {

/// A table as this file compares it.
struct Compared {
  TableWindows windows;
  std::vector<RunSource> sources;
};

/// When a window of `a` begins that overlaps one of `b`. Those of one table do not overlap.
std::optional<double> common_time(const TableWindows& a, const TableWindows& b)
{
  auto one = a.rows.begin(), other = b.rows.begin();
  while (one != a.rows.end() && other != b.rows.end()) {
    const auto &x = one->first, &y = other->first;
    if (overlap(x, y)) return x.first;
    x.second < y.second ? ++one : ++other;
  }
  return {};
}

std::optional<double> same_window(const TableWindows& a, const TableWindows& b)
{
  for (const auto& [window, rows] : a.rows) {
    const auto other = b.rows.lower_bound({window.first - round_off_of(window), 0});
    if (other != b.rows.end() && overlap(window, other->first) &&
        same_bits(*a.table, rows, *b.table, other->second))
      return window.first;
  }
  return {};
}

/// Tables of the same grains without a seed are of one run, unless they hold the same time.
Kinship kinship_of(const Compared& a, const Compared& b)
{
  const auto kin = kinship(a.sources, b.sources);
  if (kin != Kinship::same_grains) return kin;
  return common_time(a.windows, b.windows) ? Kinship::untold : Kinship::one_bed;
}

/// By what two tables are known as the same run: the digest of their input, or the bed.
std::string sameness(const Compared& a, const Compared& b)
{
  for (const auto& one : a.sources)
    for (const auto& other : b.sources)
      if (kinship(one, other) == Kinship::same_motion)
        return one.input == other.input ? one.input : "bed: " + one.bed->text();
  return "";
}

void require_distinct(const Compared& a, const Compared& b, Kinship kin)
{
  const auto refuse = [&](double time, const std::string& how) {
    throw UsageError(
        fmt::format("{} and {} both hold the time from {:g} s of the same run ({}); counting it "
                    "twice would make intervals too narrow",
                    a.windows.table->name, b.windows.table->name, time, how));
  };
  if (kin == Kinship::same_motion)
    if (const auto time = common_time(a.windows, b.windows)) refuse(*time, sameness(a, b));
  if (const auto time = same_window(a.windows, b.windows))
    refuse(*time, "all numbers are the same");
}

}  // namespace

RunsOfTables find_runs(const std::vector<Table>& tables)
{
  std::vector<Compared> all;
  std::vector<std::size_t> first(tables.size());  // of each table, the first one of its run
  std::vector<std::pair<std::size_t, std::size_t>> untold;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    all.push_back({windows_of(tables[k]), sources_of(tables[k])});
    first[k] = k;
    for (std::size_t earlier = 0; earlier < k; ++earlier) {
      const auto kin = kinship_of(all[earlier], all[k]);
      require_distinct(all[earlier], all[k], kin);
      if (kin == Kinship::untold) untold.emplace_back(earlier, k);
      if (kin < Kinship::one_bed) continue;
      const auto [low, high] = std::minmax(first[earlier], first[k]);
      std::replace(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(k) + 1, high, low);
    }
  }
  RunsOfTables runs;
  std::map<std::size_t, std::size_t> numbers;
  for (const auto table : first)
    runs.run.push_back(numbers.emplace(table, numbers.size()).first->second);
  for (std::size_t k = 0; k < tables.size(); ++k)
    if (std::any_of(untold.begin(), untold.end(), [&](const auto& pair) {
          return (pair.first == k || pair.second == k) &&
                 runs.run[pair.first] != runs.run[pair.second];
        }))
      runs.untold.push_back(k);
  return runs;
}

std::vector<std::vector<std::string>> RunsOfTables::shared(const std::vector<Table>& tables) const
{
  std::vector<std::vector<std::string>> names(tables.size());
  for (std::size_t k = 0; k < tables.size(); ++k) names[run[k]].push_back(tables[k].name);
  std::erase_if(names, [](const auto& of_run) { return of_run.size() < 2; });
  return names;
}

std::string RunsOfTables::doubt(const std::vector<Table>& tables) const
{
  constexpr std::size_t most = 4;
  if (untold.empty()) return "";
  std::vector<std::string> names;
  for (const auto table : untold)
    if (names.size() < most) names.push_back(tables[table].name);
  const auto others =
      untold.size() > most ? fmt::format(" and {} others", untold.size() - most) : "";
  return fmt::format(
      "{}{} count as tables of different runs, though neither grains, seed nor history in their "
      "headers tell that they are; where two are of one run, the intervals are too narrow",
      fmt::join(names, ", "), others);
}

}  // namespace grseg
