// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/geometry.hpp"

#include <vector>

namespace grseg {

// Each in the file of its name.
const Geometry& bed_geometry();
const Geometry& drum_geometry();
const Geometry& shear_geometry();
const Geometry& column_geometry();
const Geometry& hopper_geometry();

/// All of them, in the order of --help.
const std::vector<const Geometry*>& geometries();

}  // namespace grseg
