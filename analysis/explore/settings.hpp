// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/partition_data.hpp"
#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Options of grseg-explore and grseg-report.
struct ExploreSettings {
  FrameOptions frames;
  PartitionSettings partition;
  std::vector<std::string> rules{"stock"};
  /// Rule shown first; component of the stress; rule for contacts with the base, "": as in the table.
  std::string start = "size", component = "yy", base;
  int shown_frames = 100;

  void add_to(po::options_description& options);
  /// Sets `partition` from the options. Throws UsageError if an option has a wrong value. Reads no run.
  void check(const po::variables_map& values);
};

/// Paths of runs and of tables of sums.
struct ExploreInputs {
  std::vector<std::string> runs, tables;
};
/// Files that the command line names: HDF5 files are runs, all others tables. Throws UsageError if a file
/// is missing or no run is given.
ExploreInputs inputs_of(const po::variables_map& values);

/// Options of the command line, with `paths` in place of its input files.
po::variables_map with_inputs(const po::variables_map& values,
                              const std::vector<std::string>& paths);

/// Shell commands that print the B which a page shows, without the options that depend on the rule:
///
///   {"sums": "grseg-stress run.h5 --window 2", "file": "sums.tsv", "fit": " --heights 4dS:"}
///
/// If the user gave a table of sums, `given`, then "sums" is empty and "file" is the table's name. `number`
/// is the number of the run, from 1; it is 0 if there is only one run.
nlohmann::ordered_json commands_of(const std::string& run, const Table* given,
                                   const ExploreSettings& settings, std::size_t number);

}  // namespace grseg
