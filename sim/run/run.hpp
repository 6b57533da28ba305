// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/restart.hpp"
#include "sim/scene/scene.hpp"

#include <string>

namespace grseg {

struct RunOptions {
  std::string scene_file;  ///< name of the scene file, "" for none
  std::string output;      ///< name of the trajectory
  std::string command_line;
  bool overwrite = false;
  bool strict = false;
  bool quiet = false;
  bool force = false;            ///< start even if free memory or disk space is too small
  bool estimate = false;         ///< print the expected cost instead of running
  bool continues = false;        ///< restart from `checkpoint` if this file exists
  std::string instruction_set;   ///< name of the instruction set, "" for the best
  std::string checkpoint;        ///< name of the checkpoint to write, "" for none
  double checkpoint_every = 60;  ///< s of wall-clock time between checkpoints
  std::string restart;           ///< name of the checkpoint that resume() continues
  Perturbation perturbation;     ///< displacements for resume()
};

/// Deposits a bed, starts the flow of `scene` and writes it to `options.output`. During the run the
/// file is named output.part; if the run is interrupted (interruption.hpp) or stops with an error,
/// its frames can be read there. A summary is printed to standard error, and its numbers are
/// written to /parameters.
///
/// Checkpoints are written at the beginning, at the first frame after every `checkpoint_every`
/// seconds, on a signal and at the end. None is written during the deposition: it is repeated bit
/// for bit by the same command, which therefore replaces an output.part that has no frame of the
/// flow (begins_again(), earlier_run.hpp).
void simulate(const Scene& scene, const RunOptions& options);

/// Continues `checkpoint` with the scene `given`, which must have the same bed. If the scene is
/// unchanged and output.part belongs to the same run, frames after the checkpoint are removed from
/// output.part, and the result is bitwise equal to an uninterrupted run; if it belongs to another
/// run, throws UsageError. If `options.continues` and only the duration differs, the same holds, and
/// a finished output is replaced by a file with its frames and the new ones; if another key differs,
/// throws UsageError. In all other cases a new trajectory begins with the frames after the
/// checkpoint.
void resume(const AnyCheckpoint& checkpoint, const Scene& given, const RunOptions& options);

}  // namespace grseg
