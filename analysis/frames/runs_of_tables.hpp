// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Which tables are of one run: those of one bed (run_kinship.hpp), such as a run and what continues it.
struct RunsOfTables {
  std::vector<std::size_t> run;     // of each table, its number in the order of their first tables
  std::vector<std::size_t> untold;  // tables of which nothing tells that their runs are different

  /// Names of the tables of each run that has several.
  std::vector<std::vector<std::string>> shared(const std::vector<Table>& tables) const;
  /// A sentence where a table may be of the run of another one, mostly none.
  std::string doubt(const std::vector<Table>& tables) const;
};

/// UsageError where two tables hold the same time of the same run, which would count twice: they are
/// the same in all that acts on the motion and their windows overlap, or all rows of a window are the
/// same in both to the last bit, whatever their inputs are called.
RunsOfTables find_runs(const std::vector<Table>& tables);

}  // namespace grseg
