// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/recorder.hpp"
#include "sim/step/simulation.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace grseg {

/// Part of its trajectory that a run has written.
struct TrajectoryProgress {
  std::uint64_t frames = 0;  ///< number of frames written
  std::uint64_t digest = 0;  ///< digest of these frames (digest.hpp)
  Recorder::State recorder;
  double begin = 0;  ///< s, time of the flow at which this trajectory begins
  double wall = 0;   ///< s, wall-clock time spent on the trajectory
};

/// Entries of a checkpoint that do not depend on the number of dimensions.
struct CheckpointHead {
  std::string scene;    ///< as resolved, itself a scene file
  std::string program;  ///< name and version of the program that wrote it
  std::string history;  ///< one line per program run that led here
  Grains grains;
  Box box;
  double deposited_height = 0;  ///< m
  TrajectoryProgress trajectory;
};

/// State of a run between two steps: everything that later steps depend on, and the totals of
/// earlier steps that later frames include. No random number is drawn after the deposition, so
/// there is no state of random numbers.
template <int D>
struct Checkpoint : CheckpointHead {
  std::vector<Wall<D>> walls;
  typename Simulation<D>::State state;
};

/// Writes `checkpoint` completely or not at all: to PATH.part, which is flushed to disk, then
/// renamed. A valid checkpoint of the same name is retained as previous_of(path) (run_files.hpp),
/// so that a valid one exists at every moment. The file is HDF5, described in formats/README.md.
/// Throws RunError if it cannot be written.
template <int D>
void write_checkpoint(const std::string& path, const Checkpoint<D>& checkpoint);

/// A checkpoint of a run in two or in three dimensions.
using AnyCheckpoint = std::variant<Checkpoint<2>, Checkpoint<3>>;

/// Throws UsageError if `path` is missing. Throws FormatError if it is not a checkpoint, is damaged
/// (the digest detects any changed bit), has another version, or contains values from which no run
/// can continue (checkpoint_entries.hpp). The message names any previous checkpoint.
AnyCheckpoint read_checkpoint(const std::string& path);

}  // namespace grseg
