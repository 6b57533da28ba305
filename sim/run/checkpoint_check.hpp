// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/checkpoint.hpp"

#include <string>

namespace grseg {

/// The digest of a checkpoint vouches for its values; this, for a file by other hands, that a run
/// can continue from them: everything that is used as an index, a count or a physical number is one.
/// FormatError naming the file `name`, the entry and the remedy.
void check_checkpoint(const Checkpoint& checkpoint, const std::string& name);

}  // namespace grseg
