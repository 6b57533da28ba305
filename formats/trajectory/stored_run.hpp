// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/run_description.hpp"

#include <string>

namespace grseg {

/// Reads and checks what an open trajectory file holds beside the contents of its frames. Throws as
/// TrajectoryReader does.
StoredRun read_stored_run(hid_t file, const std::string& path);

/// FormatError where the numbers of a frame that has been read are not finite (of an absent grain:
/// not NaN throughout), or its contacts join no grains or absent ones.
template <int D>
void check_frame(const StoredRun& run, std::size_t index, const Frame<D>& frame);

}  // namespace grseg
