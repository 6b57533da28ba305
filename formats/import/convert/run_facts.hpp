// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/axes.hpp"
#include "formats/import/convert/import_settings.hpp"
#include "formats/import/convert/units.hpp"

#include <optional>
#include <string>

namespace grseg {

/// What holds for the whole of an imported run, in the archive's units, and is never guessed.
struct RunFacts {
  double step = 0;
  Plane plane;
  bool discs = true;              // false: spheres
  std::optional<double> density;  // needed where grains have no mass
  Units units;
  std::string units_as_told;
};

/// Takes each fact from the archive or the command line. Masses beside radii of different sizes
/// tell discs from spheres. UsageError, one sentence for all that is missing, with the options that
/// supply it, or where archive and command line contradict each other.
RunFacts settle_facts(const ArchiveFacts& archive, const ArchiveGrains& grains,
                      const ImportSettings& settings);

/// Mass of every grain: the archive's own, or density times area or volume. FormatError where a
/// grain has neither.
std::vector<double> masses_of(const ArchiveGrains& grains, const RunFacts& facts);

}  // namespace grseg
