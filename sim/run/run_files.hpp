// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/output_lock.hpp"
#include "formats/trajectory/writer.hpp"
#include "sim/run/checkpoint.hpp"
#include "sim/run/run.hpp"

#include <optional>
#include <string>

/// The files that a run writes: their temporary and their final names.
namespace grseg {

/// Name of a file while it is written: PATH.part.
std::string part_of(const std::string& path);

/// Name of the previous checkpoint: run_prev.chk for run.chk.
std::string previous_of(const std::string& path);

/// Checks the files of a run before it starts. Throws UsageError if one of them is an input, if two
/// of them are the same file, or if one exists and may not be replaced. A checkpoint that the run
/// continues may always be replaced.
void check_outputs(const RunOptions& options);

/// Locks that prevent other runs from writing the trajectory and the checkpoint of this run. Removes
/// the temporary files of earlier runs that were killed. Throws UsageError if another run has locked
/// the files, RunError if a checkpoint cannot be written.
class RunLocks {
 public:
  explicit RunLocks(const RunOptions& options);

 private:
  OutputLock trajectory_;
  std::optional<OutputLock> checkpoint_;
};

/// Throws RunError if no file can be written at `path`. Creates an empty file if there was none.
void require_writable(const std::string& path);

/// True if the file exists and is not empty.
bool holds_something(const std::string& path);

/// Renames the finished trajectory part_of(output) to `output`, compressed as `storage` requires.
/// Unless `overwrite`, throws RunError if a file of this name exists; the frames then stay in
/// part_of(output).
void publish_trajectory(const std::string& output, bool overwrite, const StorageSettings& storage);

/// Files and new /parameters of a trajectory that is continued.
struct Continuation {
  std::string from;  ///< file with the first frames: `part`, or a finished run to prolong
  std::string part;  ///< file to which new frames are written
  std::string scene, history;
};

/// Writer that continues to.part after the frames that `checkpoint` (read from the file `name`)
/// counts. These frames are copied to a new file, not cut in place: copying checks their digests
/// and omits anything damaged by a kill, and to.part is unchanged until the copy is renamed to it.
/// Throws UsageError if to.from does not belong to the run of `checkpoint`, FormatError if it
/// cannot be read. It may state the scene to.scene, which a prolongation has written that was killed
/// before its first checkpoint.
TrajectoryWriter truncate_to_checkpoint(const Continuation& to, const CheckpointHead& checkpoint,
                                        const std::string& name, const StorageSettings& storage);

}  // namespace grseg
