// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

/// The windows of tables by layer and window, as they are compared with each other.
namespace grseg {

/// From when to when, s.
using Span = std::pair<double, double>;

/// Within so many seconds times count as equal: tables may be kept with fewer digits.
double round_off_of(const Span& window);
/// True where they have more than round-off in common.
bool overlap(const Span& a, const Span& b);

/// The numbers of the rows of each window of a table.
struct TableWindows {
  const Table* table;
  std::map<Span, std::vector<std::size_t>> rows;
};
TableWindows windows_of(const Table& table);

/// True where rows of two tables hold the same numbers to the last bit beside their key, and more than
/// layers without stress.
bool same_bits(const Table& a, const std::vector<std::size_t>& rows_a, const Table& b,
               const std::vector<std::size_t>& rows_b);
/// True where rows hold the same areas or volumes of grains and the same stress, up to a millionth, which
/// is what single precision keeps: nothing has moved between them.
bool nothing_moved(const Table& a, const std::vector<std::size_t>& rows_a, const Table& b,
                   const std::vector<std::size_t>& rows_b);

/// A window of one of several tables.
struct TableWindow {
  const Table* table;
  Span span;
};

/// Windows of one run as observations of it, one after the other.
struct WindowLine {
  std::vector<std::size_t> number;  // of each window that was given
  std::size_t count = 0;            // of observations
  std::size_t still = 0;            // windows that add none, since nothing moved
};
/// In order of time. Windows that overlap, as those of a run and its repetition, are one observation, and
/// so are windows between which nothing moved.
WindowLine put_in_line(const std::vector<TableWindow>& windows);

}  // namespace grseg
