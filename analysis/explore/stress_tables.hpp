// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/table.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Sums of one or several runs, as grseg-stress makes them by default: a contact counts in the layer of its
/// contact point, a grain is clipped at the edges of layers.
struct StressTables {
  std::vector<Table> sums;  // by run
  /// Tables with the columns of power:Q, by Q of power_nodes() and run; empty without powers.
  std::vector<std::vector<Table>> of_powers;
};

/// Makes the sums of one run, with powers if it has two species. Reads the frames of all windows once.
/// `command` is the last line of the tables' history.
StressTables make_stress_tables(FrameLoop& loop, const std::string& command);

/// Identity of a run: its digest, "xxh3 ...", and the line "bed" of its tables (formats/cli/bed.hpp).
struct RunIdentity {
  std::string digest, bed;
};

/// The table of each run, null where there is none. A table belongs to a run if grseg-stress made it from
/// that run alone, or from another file of the same flow. FormatError naming a table that belongs to none
/// of the runs or is made of several; UsageError naming two tables of one run.
std::vector<const Table*> tables_of_runs(const std::vector<Table>& tables,
                                         const std::vector<RunIdentity>& runs);

/// UsageError, with the remedy, where a table has other species than the run beside it.
void require_same_species(const Table& table, const SpeciesList& species);

}  // namespace grseg
