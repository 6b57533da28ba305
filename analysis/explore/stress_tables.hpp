// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/table.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The sums of one or several runs, as grseg-stress makes them with its defaults: contacts in the layer
/// of their contact point, grains clipped at the edges of layers.
struct StressTables {
  std::vector<Table> sums;  // by run
  /// With the columns of power:Q for each Q of power_nodes(), or none; by node and run.
  std::vector<std::vector<Table>> of_powers;
};

/// Those of one run, with powers where it has two species. Reads the frames of all windows once.
/// `command` is the last line of the tables' history.
StressTables make_stress_tables(FrameLoop& loop, const std::string& command);

/// What a run is known by: "xxh3 ...", and the line "bed" of its tables (formats/cli/bed.hpp).
struct RunIdentity {
  std::string digest, bed;
};

/// Which of `tables` is of the run: made of it, or of another file of the same flow, alone and by
/// grseg-stress. FormatError naming a table that is of none of the runs, or of several.
std::vector<const Table*> tables_of_runs(const std::vector<Table>& tables,
                                         const std::vector<RunIdentity>& runs);

/// UsageError with the remedy where a table tells other species apart than the run beside it.
void require_same_species(const Table& table, const SpeciesList& species);

}  // namespace grseg
