// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/output_lock.hpp"
#include "formats/trajectory/writer.hpp"
#include "sim/run/checkpoint.hpp"
#include "sim/run/run.hpp"

#include <optional>
#include <string>

/// The files that a run writes: how they are called while it runs, and how they get their names.
namespace grseg {

/// Name of the file while it is written: PATH.part.
std::string part_of(const std::string& path);

/// The checkpoint that `path` was before the last one was written: run_prev.chk for run.chk.
std::string previous_of(const std::string& path);

/// Checks the files of a run before time is spent on it: UsageError where one of them is an input,
/// two of them are one file, or one exists that may not be replaced. A checkpoint that the run
/// continues may always be replaced.
void check_outputs(const RunOptions& options);

/// Keeps other runs from writing the trajectory and the checkpoint of this one. UsageError where
/// one does so already, RunError where a checkpoint cannot be written.
class RunLocks {
 public:
  explicit RunLocks(const RunOptions& options);

 private:
  OutputLock trajectory_;
  std::optional<OutputLock> checkpoint_;
};

/// RunError where no file can be written at `path`, before time is spent on a run rather than after
/// it. Leaves an empty file where there was none.
void require_writable(const std::string& path);

/// True where the file exists and is not empty.
bool holds_something(const std::string& path);

/// Renames the finished trajectory part_of(output) to `output`, compressed where `storage` asks for
/// it. RunError where a file of this name has appeared, unless `overwrite`; the frames stay where
/// they are.
void publish_trajectory(const std::string& output, bool overwrite, const StorageSettings& storage);

/// A trajectory that goes on: its file, and its /parameters.
struct Continuation {
  std::string from;  ///< file with the frames so far: `part` itself, or a finished run to prolong
  std::string part;  ///< file in which the run goes on
  std::string scene, history;
};

/// The frames that `checkpoint` (read from the file `name`) counts, in to.part, for the run to
/// continue there. They are copied to a new file rather than cut in place: that checks each of them
/// by its digest and leaves behind whatever a kill has damaged, and to.part is untouched until the
/// copy takes its name.
///
/// UsageError where to.from is not of the run of `checkpoint`, FormatError where it cannot be read.
TrajectoryWriter truncate_to_checkpoint(const Continuation& to, const Checkpoint& checkpoint,
                                        const std::string& name, const StorageSettings& storage);

}  // namespace grseg
