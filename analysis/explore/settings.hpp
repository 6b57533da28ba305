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
  std::string start = "size", component = "yy", base;  // base "": as in the table
  int shown_frames = 100, bootstrap = 1000;
  long seed = 1;

  void add_to(po::options_description& options);
  /// Sets `partition` from the options. UsageError where one has a wrong value. Reads no run.
  void check(const po::variables_map& values);
};

/// Paths of runs and of tables of sums.
struct ExploreInputs {
  std::vector<std::string> runs, tables;
};
/// The files that the command line names; a file that begins as HDF5 does is a run. UsageError where a file
/// is missing or there is no run.
ExploreInputs inputs_of(const po::variables_map& values);

/// The command line with these inputs in place of its own.
po::variables_map with_inputs(const po::variables_map& values,
                              const std::vector<std::string>& paths);

/// Commands for a shell that print the B of a page, without the options that depend on the rule:
///
///   {"sums": "grseg-stress run.h5 --window 2", "file": "sums.tsv", "fit": " --heights 4dS:"}
///
/// If the sums came in a table, `given`, then `sums` is empty and `file` is its name. `number` counts the
/// runs from 1; it is 0 if there is one run.
nlohmann::ordered_json commands_of(const std::string& run, const Table* given,
                                   const ExploreSettings& settings, std::size_t number);

}  // namespace grseg
