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

/// What the command line of grseg-explore and grseg-report says.
struct ExploreSettings {
  FrameOptions frames;
  PartitionSettings partition;
  std::vector<std::string> rules{"stock"};
  std::string start = "size", component = "yy", base;  // base "": as in the table
  int shown_frames = 100, bootstrap = 1000;
  long seed = 1;

  void add_to(po::options_description& options);
  /// Refuses what cannot be meant, before any run is read, and sets `partition` from the words.
  void check(const po::variables_map& values);
};

/// Runs, and tables of sums.
struct ExploreInputs {
  std::vector<std::string> runs, tables;
};
/// What the command line names, told apart by how files begin. UsageError where a file is missing or
/// there is no run.
ExploreInputs inputs_of(const po::variables_map& values);

/// The same command line as if these inputs had been given alone.
po::variables_map with_inputs(const po::variables_map& values,
                              const std::vector<std::string>& paths);

/// The commands that print the B of a page, for a shell, as far as they do not depend on the rule:
///
///   {"sums": "grseg-stress run.h5 --window 2", "file": "sums.tsv", "fit": " --heights 4dS:"}
///
/// `sums` is empty where the sums came in a table, `given`, whose name is `file` then. `number`: of the run
/// among several; 0 of a single one.
nlohmann::ordered_json commands_of(const std::string& run, const Table* given,
                                   const ExploreSettings& settings, std::size_t number);

}  // namespace grseg
