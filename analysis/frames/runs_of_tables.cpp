// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/runs_of_tables.hpp"

#include "analysis/frames/layer_key.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>

namespace grseg {
namespace {

using Rows = std::vector<std::size_t>;

bool is_of_key(const std::string& name)
{
  return std::ranges::any_of(key_columns, [&](const auto& key) { return name == key.name; });
}

/// Columns that both tables have in addition to the key, as pairs of column numbers (a, b).
std::vector<std::pair<std::size_t, std::size_t>> common_columns(const Table& a, const Table& b)
{
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  for (std::size_t column = 0; column < a.columns.size(); ++column) {
    const auto name = without_unit(a.columns[column]);
    if (!is_of_key(name) && b.has_column(name)) columns.emplace_back(column, b.column(name));
  }
  return columns;
}

std::string unit_of(const std::string& column)
{
  return column.substr(std::min(column.find('['), column.size()));
}

/// True if both rows agree in these columns of one unit, up to `part` of the largest number.
bool agree(const std::vector<double>& a, const std::vector<double>& b,
           const std::vector<std::pair<std::size_t, std::size_t>>& columns)
{
  constexpr double part = 1e-6;
  double scale = 0, largest = 0;
  for (const auto& [x, y] : columns) {
    scale = std::max({scale, std::abs(a[x]), std::abs(b[y])});
    largest = std::max(largest, std::abs(a[x] - b[y]));
  }
  return largest <= part * scale;
}

/// Difference of times (s) up to which they count as equal, because tables may have few digits.
double round_off_of(const Span& window)
{
  return 1e-6 * (window.second - window.first);
}

/// True if two windows overlap by more than round-off.
bool overlap(const Span& a, const Span& b)
{
  const double common = std::min(a.second, b.second) - std::max(a.first, b.first);
  return common > std::min(round_off_of(a), round_off_of(b));
}

/// A table and its row numbers by window.
struct TableWindows {
  const Table* table;
  std::map<Span, Rows> rows;
};
TableWindows windows_of(const Table& table)
{
  TableWindows windows{&table, {}};
  const auto keys = read_keys(table, "tables by layer and window have it");
  for (std::size_t row = 0; row < keys.size(); ++row)
    windows.rows[{keys[row].begin, keys[row].end}].push_back(row);
  return windows;
}

/// True if rows of two tables have identical numbers, bit by bit, in all common columns except the
/// key. Rows without stress do not count, because their two areas may be equal by chance.
bool same_bits(const Table& a, const Rows& rows_a, const Table& b, const Rows& rows_b)
{
  if (rows_a.size() != rows_b.size()) return false;
  std::size_t numbers = 0;
  for (const auto& [x, y] : common_columns(a, b))
    for (std::size_t k = 0; k < rows_a.size(); ++k) {
      const double value = a.rows[rows_a[k]][x], other = b.rows[rows_b[k]][y];
      if (std::bit_cast<std::uint64_t>(value) != std::bit_cast<std::uint64_t>(other)) return false;
      if (value != 0 && value == value) ++numbers;
    }
  return numbers > 2;  // more than the areas of two species
}

/// True if rows have the same areas or volumes of grains and the same stress, up to a millionth
/// (the accuracy of single precision): the grains have not moved between the two windows.
bool nothing_moved(const Table& a, const Rows& rows_a, const Table& b, const Rows& rows_b)
{
  if (rows_a.size() != rows_b.size()) return false;
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> of_unit;
  for (const auto& columns : common_columns(a, b)) {
    const auto unit = unit_of(a.columns[columns.first]);
    if (unit == "[N m]" || unit == "[m^2]" || unit == "[m^3]") of_unit[unit].push_back(columns);
  }
  if (of_unit.empty()) return false;
  for (std::size_t k = 0; k < rows_a.size(); ++k)
    for (const auto& [unit, columns] : of_unit)
      if (!agree(a.rows[rows_a[k]], b.rows[rows_b[k]], columns)) return false;
  return true;
}

}  // namespace

WindowLine put_in_line(const std::vector<TableWindow>& windows)
{
  std::vector<std::size_t> order(windows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return windows[a].span < windows[b].span; });
  std::map<const Table*, TableWindows> rows;
  for (const auto& window : windows)
    if (!rows.contains(window.table)) rows.emplace(window.table, windows_of(*window.table));
  const auto rows_of = [&](const TableWindow& window) -> const Rows& {
    return rows.at(window.table).rows.at(window.span);
  };

  WindowLine line{Rows(windows.size()), 0, 0};
  const TableWindow* last = nullptr;  // the first window of the current observation
  for (const auto k : order) {
    const auto& window = windows[k];
    const bool again = last != nullptr && overlap(last->span, window.span);
    const bool still = last != nullptr && !again &&
                       nothing_moved(*last->table, rows_of(*last), *window.table, rows_of(window));
    line.still += still;
    if (!again && !still) {
      ++line.count;
      last = &window;
    }
    line.number[k] = line.count - 1;
  }
  return line;
}

namespace {

/// The value of --seed in a command; "" without --seed.
std::string seed_in(const std::string& command)
{
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    if (word.starts_with("--seed=")) return word.substr(7);
    if (word == "--seed") return words >> word ? word : "";
  }
  return "";
}

/// True if one history continues the other, or if both continue a common beginning, by --restart.
/// False for equal histories, because the same command may have run in several folders.
bool goes_on(const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (x == a.begin()) return false;
  const auto restarts = [](auto at, auto end) {
    return at != end && at->find(" --restart") != std::string::npos;
  };
  const bool one = restarts(x, a.end()), other = restarts(y, b.end());
  return (one && other) || (one && y == b.end()) || (other && x == a.end());
}

/// The kinship of two beds with the same grains.
Kinship kinship_of_beds(const Bed& a, const Bed& b)
{
  const bool seeds = !a.seed.empty() && !b.seed.empty();
  if (seeds && a.seed != b.seed) return Kinship::none;
  if (!seeds) return a.varied ? Kinship::same_grains : Kinship::untold;
  return a.flow.empty() || a.flow != b.flow ? Kinship::one_bed : Kinship::same_motion;
}

}  // namespace

std::string RunSource::seed() const
{
  if (bed) return bed->seed;
  return history.empty() ? "" : seed_in(history.front());
}

std::vector<RunSource> sources_of(const Table& table)
{
  std::vector<RunSource> sources(1);
  for (const auto& [key, value] : table.header) {
    auto* last = &sources.back();
    const bool next = key == "history" || key == "input";
    if (next && !last->input.empty()) last = &sources.emplace_back();
    if (key == "history") last->history.push_back(value);
    if (key == "input") last->input = value;
    if (key == "bed") last->bed = parse_bed(value);
  }
  // In a merged table the last entry is not a run, but the command that merged the tables.
  if (sources.size() > 1 && sources.back().input.empty()) sources.pop_back();
  for (auto& source : sources)
    if (!source.history.empty()) source.history.pop_back();
  return sources;
}

Kinship kinship(const RunSource& a, const RunSource& b)
{
  if (!a.input.empty() && a.input == b.input) return Kinship::same_motion;
  if (a.bed && b.bed) {
    if (a.bed->grains == b.bed->grains) return kinship_of_beds(*a.bed, *b.bed);
    if (!a.bed->come_and_go && !b.bed->come_and_go) return Kinship::none;
  }
  if (goes_on(a.history, b.history)) return Kinship::one_bed;
  const bool seeds = !a.seed().empty() && !b.seed().empty();
  return seeds && a.seed() != b.seed() ? Kinship::none : Kinship::untold;
}

Kinship kinship(const std::vector<RunSource>& a, const std::vector<RunSource>& b)
{
  auto closest = Kinship::none;
  for (const auto& one : a)
    for (const auto& other : b) closest = std::max(closest, kinship(one, other));
  return closest;
}

namespace {

/// Data of a table that this file compares.
struct Compared {
  TableWindows windows;
  std::vector<RunSource> sources;
};

/// Begin (s) of a window of `a` that overlaps a window of `b`. Windows of one table do not overlap.
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

/// Kinship of two tables. Tables of the same grains without a seed belong to one run, unless their
/// windows overlap.
Kinship kinship_of(const Compared& a, const Compared& b)
{
  const auto kin = kinship(a.sources, b.sources);
  if (kin != Kinship::same_grains) return kin;
  return common_time(a.windows, b.windows) ? Kinship::untold : Kinship::one_bed;
}

/// Evidence that two tables are of the same run: the digest of their input, or the bed.
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
        fmt::format("{} and {} both contain the time from {:g} s of the same run ({}); give only "
                    "one of them, because counting it twice makes intervals too narrow",
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
  std::vector<std::size_t> first(tables.size());  // for each table, the first table of its run
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
    if (std::ranges::any_of(untold, [&](const auto& pair) {
          return (pair.first == k || pair.second == k) &&
                 runs.run[pair.first] != runs.run[pair.second];
        }))
      runs.untold.push_back(k);
  return runs;
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
      "{}{} count as tables of different runs, but grains, seed and history in their headers do "
      "not prove it; if two of them are of one run, the intervals are too narrow",
      fmt::join(names, ", "), others);
}

}  // namespace grseg
