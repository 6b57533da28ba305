// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/writer.hpp"
#include "sim/run/checkpoint.hpp"

#include <string>

namespace grseg {

/// The trajectory `part` of an unfinished run, cut back to the frames that `checkpoint` (read from
/// the file `name`) counts, for the run to continue in. They are copied to a new file rather than
/// cut in place: that checks each of them by its digest and leaves behind whatever a kill has
/// damaged, and `part` is untouched until the copy takes its name. `history` replaces that in
/// /parameters.
///
/// UsageError where `part` is not of the run of `checkpoint`, FormatError where it cannot be read.
TrajectoryWriter truncate_to_checkpoint(const std::string& part, const Checkpoint& checkpoint,
                                        const std::string& name, const std::string& history,
                                        const StorageSettings& storage);

}  // namespace grseg
