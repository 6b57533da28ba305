// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/recorder.hpp"
#include "sim/step/simulation.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// How much of its trajectory a run has written.
struct TrajectoryProgress {
  std::uint64_t frames = 0;  ///< written
  std::uint64_t digest = 0;  ///< chained over them
  Recorder::State recorder;
  double begin = 0;  ///< s, time of the run at which this trajectory begins
  double wall = 0;   ///< s, spent on it
};

/// A run between two steps: all that later steps depend on, and what later frames state about the
/// steps before. No random number is drawn after the deposition, so there is no random state.
struct Checkpoint {
  std::string scene;    ///< as resolved, itself a scene file
  std::string program;  ///< that wrote it
  std::string history;  ///< one line per program run that led here
  Grains grains;
  std::vector<Wall> walls;
  Box box;
  double deposited_height = 0;  ///< m
  Simulation::State state;
  TrajectoryProgress trajectory;
};

/// Writes `checkpoint` whole or not at all: as PATH.part, flushed to disk, then renamed. A whole
/// checkpoint that had the name is kept as previous_of(path) (run_files.hpp); at every moment there
/// is a whole one. An HDF5 file, laid out as formats/README.md says. RunError where it cannot be
/// written.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// UsageError where `path` is missing, FormatError where it is not a checkpoint, is damaged (its
/// digest detects any changed bit), is of another version, or holds what no run can continue from
/// (checkpoint_entries.hpp). The sentence names the previous checkpoint where there is one.
Checkpoint read_checkpoint(const std::string& path);

}  // namespace grseg
