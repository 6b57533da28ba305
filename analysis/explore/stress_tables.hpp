// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/table.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Sums over contacts of one or several runs, as grseg-stress makes them by default: a contact belongs to
/// the layer of its contact point, and a grain that crosses layers counts in each by the part inside.
struct StressTables {
  std::vector<Table> sums;  // one table per run
  /// Tables with the columns of power:Q, by Q of power_nodes() and by run; empty without sums by power:Q.
  std::vector<std::vector<Table>> of_powers;
};

/// Makes the sums of one run, including sums by power:Q if the run has two species. Reads the frames of all
/// windows once. `command` is the last line of the tables' history.
StressTables make_stress_tables(FrameLoop& loop, const std::string& command);

/// Identity of a run: its digest, "xxh3 ...", and the line "bed" of its tables (formats/cli/bed.hpp).
struct RunIdentity {
  std::string digest, bed;
};

/// The table of each run, null if no table belongs to the run. A table belongs to a run if grseg-stress
/// made it from this run alone, or from another file of the same flow. Throws FormatError, naming the
/// table, if it belongs to no run or is made of several runs; UsageError if two tables belong to one run.
std::vector<const Table*> tables_of_runs(const std::vector<Table>& tables,
                                         const std::vector<RunIdentity>& runs);

/// Throws UsageError, with the remedy, if a table has other species than its run.
void require_same_species(const Table& table, const SpeciesList& species);

}  // namespace grseg
