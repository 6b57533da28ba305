// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/checkpoint.hpp"
#include "sim/run/run.hpp"

#include <string>

/// The files that an earlier run left under the names of this run: whether this run continues it,
/// begins it again, or must leave its files alone.
namespace grseg {

/// Name of the checkpoint from which --continue continues: the last one, or the previous one if a
/// kill removed the last one; "" if there is none, and the run begins at its deposition.
std::string checkpoint_of_earlier_run(const RunOptions& options);

/// Throws UsageError if --continue begins a run whose output exists already.
void require_no_output(const RunOptions& options);

/// Checks output.part before a run of `scene` begins at its deposition. Returns true if an earlier
/// run left frames there that this run makes again: frames of its deposition, or none. Throws if
/// output.part holds anything else and `options` does not allow to replace it.
bool begins_again(const Scene& scene, const RunOptions& options);

/// Throws UsageError, which names the key, if --continue would continue a run with other steps. The
/// duration may differ, and how finished files are compressed.
void require_same_run(const Scene& before, const Scene& now, const RunOptions& options);

/// True if `output` contains the frames that `checkpoint` counts, or if its frames are the first
/// ones in output.part, as after an interrupted prolongation.
bool begins_the_run(const std::string& output, const CheckpointHead& checkpoint);

/// True if the file `part` is continued by a run of its scene from `checkpoint`. False if it is
/// empty, or has no frame although the checkpoint counts some: a run that was killed before its
/// first frame left it.
bool is_continued(const std::string& part, const CheckpointHead& checkpoint);

}  // namespace grseg
