// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/hdf5.hpp"

#include <string>
#include <vector>

/// The parts common to all H5MD 1.1 files (h5md.nongnu.org). RunError where the file cannot be
/// written.
namespace grseg::h5md {

/// /h5md: version, author, creator, and module units of system SI.
void write_root(hid_t file);

/// /particles/NAME/box with its `boundary`, one word per dimension.
void write_box(hid_t file, const std::string& particles, const std::vector<std::string>& boundary);

/// Links the step and time of the element `of` into `element` (hard links), as H5MD demands.
void link_times(hid_t file, const std::string& of, const std::string& element);

}  // namespace grseg::h5md
