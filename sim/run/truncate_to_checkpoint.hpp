// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"
#include "sim/run/checkpoint.hpp"

#include <string>

namespace grseg {

/// What a trajectory that goes on states: where it stands, and in its /parameters.
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
