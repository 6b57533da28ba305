// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/mercury/mercury_lines.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

namespace grseg {

/// Takes the period of the boundary in the line at hand into `restart`, if it is one. FormatError
/// where the cell is periodic in a way that is not imported.
void read_mercury_boundary(const MercuryLines& lines, MercuryRestart& restart);

}  // namespace grseg
