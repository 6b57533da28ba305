// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/bed.hpp"
#include "formats/cli/table.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Comparison of tables by layer and window: which of them are of one run, and which windows.

/// Begin and end of a window, s.
using Span = std::pair<double, double>;

/// A window of one of several tables.
struct TableWindow {
  const Table* table;
  Span span;
};

/// Windows of one run, combined into observations and numbered in order of time.
struct WindowLine {
  std::vector<std::size_t> number;  // observation of each window, from 0
  std::size_t count = 0;            // number of observations
  std::size_t still = 0;            // number of windows that add none, because no grain moved
};
/// Combines windows into observations. Windows that overlap, as in a run and its repetition, are
/// one observation, and so are windows between which no grain moved.
WindowLine put_in_line(const std::vector<TableWindow>& windows);

/// A run, as described by the header of a table that was made from it.
struct RunSource {
  std::string input;                 // digest of the run; "" if the header has none
  std::optional<Bed> bed;            // grains of the run; older tables have no line for it
  std::vector<std::string> history;  // commands that made the run, but not the table

  /// The scene's seed; "" if neither the bed nor the command names it.
  std::string seed() const;
};

/// The runs of a table: one, or several if it was merged.
std::vector<RunSource> sources_of(const Table& table);

/// How closely two runs are related.
enum class Kinship {
  none,         ///< different runs: other grains, or another seed
  untold,       ///< unknown, because the headers do not say
  same_grains,  ///< same grains without a seed: one run, or several from one list of radii
  one_bed,      ///< one run: both continue one deposited bed
  same_motion,  ///< identical motion: at any time the same grains are in the same places
};
Kinship kinship(const RunSource& a, const RunSource& b);
/// The closest kinship of any run in `a` with any run in `b`.
Kinship kinship(const std::vector<RunSource>& a, const std::vector<RunSource>& b);

/// Tables grouped by run. Tables of one bed belong to one run, such as a run and its continuation.
struct RunsOfTables {
  std::vector<std::size_t> run;     // number of each table's run, from 0 in order of appearance
  std::vector<std::size_t> untold;  // tables that may be of the run of another table

  /// A warning about the tables in `untold`; "" if there are none.
  std::string doubt(const std::vector<Table>& tables) const;
};

/// Groups tables by run. Throws UsageError if two tables contain the same time of the same run,
/// which would count twice: if their kinship is same_motion and their windows overlap, or if all
/// rows of a window are identical in both, bit by bit.
RunsOfTables find_runs(const std::vector<Table>& tables);

}  // namespace grseg
