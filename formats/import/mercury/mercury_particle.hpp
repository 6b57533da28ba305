// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/mercury/mercury_lines.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

namespace grseg {

/// The particle in the line at hand; `row` is its number. FormatError where it is not one sphere or
/// belongs to no species.
MercuryRestart::Particle read_mercury_particle(const MercuryLines& lines,
                                               const MercuryRestart& restart, std::size_t row);

}  // namespace grseg
