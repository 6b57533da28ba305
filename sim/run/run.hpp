// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/restart.hpp"
#include "sim/scene/scene.hpp"

#include <string>

namespace grseg {

struct RunOptions {
  std::string scene_file;  ///< that the scene was read from, "" for none
  std::string output;
  std::string command_line;
  bool overwrite = false;
  bool strict = false;
  bool quiet = false;
  bool force = false;            ///< begin even if memory or disk have too little room
  bool estimate = false;         ///< print the cost of the run instead
  bool continues = false;        ///< restart from `checkpoint` if it is there
  std::string instruction_set;   ///< "" for the best
  std::string checkpoint;        ///< file to write, "" for none
  double checkpoint_every = 60;  ///< s of wall time
  std::string restart;           ///< name of the checkpoint that `resume` continues
  Perturbation perturbation;     ///< for `resume`
};

/// Deposits, tilts and runs `scene` into `options.output`. While it runs the file is called
/// output.part; a run that is interrupted (interruption.hpp) or stops out of bounds leaves its
/// frames there, readable. A summary goes to standard error and, as numbers, into /parameters.
///
/// Checkpoints are written at the beginning, then at the first frame after every
/// `checkpoint_every`, on a signal and at the end.
void simulate(const Scene& scene, const RunOptions& options);

/// Continues `checkpoint` under the scene `given`, which must have the same bed. With an unchanged
/// scene, an output.part of the same run is cut back to the frames that the checkpoint counts, and
/// ends bitwise as an uninterrupted run; UsageError where output.part belongs to another run. Where
/// `options.continues` and only the run's length differs, a finished output is prolonged: its
/// replacement holds its frames and the new ones. In all other cases a new trajectory begins with
/// the frames after the checkpoint.
void resume(const Checkpoint& checkpoint, const Scene& given, RunOptions options);

}  // namespace grseg
