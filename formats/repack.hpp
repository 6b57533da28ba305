// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory_writer.hpp"

#include <string>

namespace grseg {

/// Writes the run in the file `from` anew as `to`, stored as `storage` says: how a finished run is
/// compressed. Numbers, and with them the content digest, stay the same; a `from` in single
/// precision needs a `to` in single precision for that.
void repack(const std::string& from, const std::string& to, const StorageSettings& storage);

}  // namespace grseg
