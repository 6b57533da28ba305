// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/facts/axes.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/units.hpp"

#include <optional>
#include <string>

namespace grseg {

/// What holds for the whole of an imported run, in the archive's units, and is never guessed.
struct RunFacts {
  double step = 0;
  int dimension = 2;
  Orientation orientation;
  bool discs = true;              // false: spheres
  std::vector<std::string> walls;  // straight ones that bound the flow, in words
  std::optional<double> density;  // needed where grains have no mass
  Units units;
  std::string units_as_given;
};

/// Takes each fact from the archive or the command line; discs and spheres are distinguished by the
/// masses of grains of different radii. UsageError, one sentence with the options for all that is
/// missing, or where archive and command line contradict each other.
RunFacts collect_facts(const ArchiveFacts& archive, const ArchiveMoment& first,
                       const ImportSettings& settings);

/// Mass of every grain: the archive's own, or density times area or volume. FormatError where a
/// grain has neither.
std::vector<double> masses_of(const ArchiveGrains& grains, const RunFacts& facts);

}  // namespace grseg
