// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/output_lock.hpp"
#include "formats/trajectory/writer.hpp"
#include "sim/run/run.hpp"

#include <optional>
#include <string>

/// The files that a run writes: how they are called while it runs, and how they get their names.
namespace grseg {

/// What the file is called while it is written: PATH.part.
std::string part_of(const std::string& path);

/// The checkpoint that `path` was before the last one was written: run_prev.chk for run.chk.
std::string previous_of(const std::string& path);

/// What must hold before time is spent on a run: UsageError where one of its files is an input, or
/// two of them are one file, or one exists that may not be replaced. A checkpoint that the run
/// continues may always be.
void check_outputs(const RunOptions& options);

/// Keeps other runs from writing the trajectory and the checkpoint of this one. UsageError where one
/// does so already, RunError where a checkpoint cannot be written.
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

/// Whether there is a file with something in it.
bool holds_something(const std::string& path);

/// Renames the finished trajectory part_of(output) to `output`, compressed where `storage` asks for
/// it. RunError where a file of this name has appeared, unless `overwrite`; the frames stay where
/// they are.
void publish_trajectory(const std::string& output, bool overwrite, const StorageSettings& storage);

}  // namespace grseg
