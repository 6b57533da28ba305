// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/hdf5.hpp"

#include <string>
#include <vector>

/// Writers of the parts that all H5MD 1.1 files have (h5md.nongnu.org). All throw RunError if the
/// file cannot be written.
namespace grseg::h5md {

/// Writes /h5md: version, author, creator, and the module "units" with system SI.
void write_root(hid_t file);

/// Writes /particles/NAME/box; `boundary` has one word per dimension, "periodic" or "none".
void write_box(hid_t file, const std::string& particles, const std::vector<std::string>& boundary);

/// Adds hard links to step and time of the element `of` to the element `element`, as H5MD demands.
void link_times(hid_t file, const std::string& of, const std::string& element);

}  // namespace grseg::h5md
