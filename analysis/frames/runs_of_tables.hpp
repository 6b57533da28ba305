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

/// The windows of tables by layer and window, as they are compared with each other.

/// From when to when, s.
using Span = std::pair<double, double>;

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
/// Windows in order of time. Windows that overlap, as in a run and its repetition, are one
/// observation, and so are windows between which nothing moved.
WindowLine put_in_line(const std::vector<TableWindow>& windows);

/// A run, as a table that is made of it describes it.
struct RunSource {
  std::string input;                 // its digest; "" where the table names none
  std::optional<Bed> bed;            // not of tables made before there was such a line
  std::vector<std::string> history;  // of the run, without what made the table

  /// The scene's seed; "" where neither the bed nor the command names it.
  std::string seed() const;
};

/// The runs of a table, several where it was merged; at least one.
std::vector<RunSource> sources_of(const Table& table);

/// The things that two runs share.
enum class Kinship {
  none,         ///< other grains, or another seed
  untold,       ///< nothing that is recorded tells
  same_grains,  ///< without a seed: one run, or several that began from one list of radii
  one_bed,      ///< one deposition, and so one run: the same grains, or a history that goes on
  same_motion,  ///< equal in all that acts on the motion: at one time they hold the same grains in the same places
};
Kinship kinship(const RunSource& a, const RunSource& b);
/// The closest of any of their runs.
Kinship kinship(const std::vector<RunSource>& a, const std::vector<RunSource>& b);

/// Tables grouped by run. Tables of one bed are of one run, such as a run and what continues it.
struct RunsOfTables {
  std::vector<std::size_t> run;     // of each table, its number in the order of their first tables
  std::vector<std::size_t> untold;  // tables of which nothing tells that their runs are different

  /// Names of the tables of each run that has several.
  std::vector<std::vector<std::string>> shared(const std::vector<Table>& tables) const;
  /// A sentence where a table may be of the run of another one, mostly none.
  std::string doubt(const std::vector<Table>& tables) const;
};

/// UsageError where two tables hold the same time of the same run, which would count twice: they
/// are the same in all that acts on the motion and their windows overlap, or all rows of a window
/// are the same in both to the last bit, whatever their inputs are called.
RunsOfTables find_runs(const std::vector<Table>& tables);

}  // namespace grseg
