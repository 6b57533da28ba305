// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"
#include "formats/trajectory/writer.hpp"

#include <string>

namespace grseg {

/// A writer of the file `to` that begins with the first `frames` frames of `run`, takes
/// `observables`, which `run` must have, in this order, and says `parameters` of itself.
TrajectoryWriter copy_frames(const TrajectoryReader& run, std::size_t frames, const std::string& to,
                             const Parameters& parameters,
                             const std::vector<Observable>& observables,
                             const StorageSettings& storage);

/// Writes the run in the file `from` anew as `to`, stored as `storage` says: how a finished run is
/// compressed. Numbers, and with them the content digest, stay the same; a `from` in single
/// precision needs a `to` in single precision for that.
void repack(const std::string& from, const std::string& to, const StorageSettings& storage);

}  // namespace grseg
