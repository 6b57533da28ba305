// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/partition_data.hpp"
#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/tool.hpp"

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

}  // namespace grseg
