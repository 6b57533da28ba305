// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/distinct_runs.hpp"

#include "analysis/frames/layer_table.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace grseg {
namespace {

using Span = std::pair<double, double>;

/// A table as this file compares it.
struct Windows {
  const Table* table;
  std::vector<std::string> inputs;
  std::map<Span, std::vector<std::size_t>> rows;  // of each window
};

Windows windows_of(const Table& table)
{
  Windows windows{&table, header_values(table, "input"), {}};
  const auto keys = read_layer_keys(table, "tables by layer and window have it");
  for (std::size_t row = 0; row < keys.size(); ++row)
    windows.rows[{keys[row].begin, keys[row].end}].push_back(row);
  return windows;
}

/// An input that both have; null where there is none.
const std::string* common_input(const Windows& a, const Windows& b)
{
  for (const auto& input : a.inputs)
    if (std::find(b.inputs.begin(), b.inputs.end(), input) != b.inputs.end()) return &input;
  return nullptr;
}

/// When a window of `a` begins that overlaps one of `b`. Those of one table do not overlap.
std::optional<double> overlap(const Windows& a, const Windows& b)
{
  auto one = a.rows.begin(), other = b.rows.begin();
  while (one != a.rows.end() && other != b.rows.end()) {
    const auto &x = one->first, &y = other->first;
    const double common = std::min(x.second, y.second) - std::max(x.first, y.first);
    constexpr double round_off = 1e-6;
    if (common > round_off * (x.second - x.first)) return x.first;
    x.second < y.second ? ++one : ++other;
  }
  return {};
}

bool same_bits(double a, double b)
{
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Whether the rows hold the same numbers, and more than layers without stress.
bool same_content(const Windows& a, const std::vector<std::size_t>& rows_a, const Windows& b,
                  const std::vector<std::size_t>& rows_b)
{
  if (rows_a.size() != rows_b.size()) return false;
  std::size_t numbers = 0;  // beside the key
  for (std::size_t column = 0; column < a.table->columns.size(); ++column) {
    const auto name = without_unit(a.table->columns[column]);
    if (!b.table->has_column(name)) continue;
    const auto other = b.table->column(name);
    const bool of_key = std::any_of(key_columns.begin(), key_columns.end(),
                                    [&](const auto& key) { return name == key.name; });
    for (std::size_t k = 0; k < rows_a.size(); ++k) {
      const double value = a.table->rows[rows_a[k]][column];
      if (!same_bits(value, b.table->rows[rows_b[k]][other])) return false;
      if (!of_key && value != 0 && value == value) ++numbers;
    }
  }
  return numbers > 2;  // the two areas may be the same in layers that bear no stress
}

std::optional<double> same_window(const Windows& a, const Windows& b)
{
  for (const auto& [window, rows] : a.rows) {
    const auto other = b.rows.find(window);
    if (other != b.rows.end() && same_content(a, rows, b, other->second)) return window.first;
  }
  return {};
}

void require_distinct(const Windows& a, const Windows& b)
{
  const auto refuse = [&](double time, const std::string& how) {
    throw UsageError(
        fmt::format("{} and {} both hold the time from {:g} s of the same run ({}); counting it "
                    "twice would make intervals too narrow",
                    a.table->name, b.table->name, time, how));
  };
  if (const auto* input = common_input(a, b))
    if (const auto time = overlap(a, b)) refuse(*time, *input);
  if (const auto time = same_window(a, b)) refuse(*time, "all numbers are the same");
}

}  // namespace

void require_distinct_runs(const std::vector<Table>& tables)
{
  std::vector<Windows> all;
  for (const auto& table : tables) {
    all.push_back(windows_of(table));
    for (std::size_t earlier = 0; earlier + 1 < all.size(); ++earlier)
      require_distinct(all[earlier], all.back());
  }
}

}  // namespace grseg
