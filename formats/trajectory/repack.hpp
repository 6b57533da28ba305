// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"
#include "formats/trajectory/writer.hpp"

#include <string>

namespace grseg {

/// A writer of the file `to` that begins with the first `frames` frames of `run`, takes
/// `observables`, which `run` must have, in this order, and has the given `parameters`.
TrajectoryWriter copy_frames(const TrajectoryReader& run, std::size_t frames, const std::string& to,
                             const Parameters& parameters,
                             const std::vector<Observable>& observables,
                             const StorageSettings& storage);

/// Copies the run in the file `from` to `to` with another `storage`; this is how a finished run is
/// compressed. Numbers and content digest stay the same, if a file in single precision stays in
/// single precision.
void repack(const std::string& from, const std::string& to, const StorageSettings& storage);

}  // namespace grseg
