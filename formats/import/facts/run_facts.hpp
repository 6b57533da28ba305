// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/facts/axes.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/units.hpp"

#include <optional>
#include <string>

namespace grseg {

/// Facts of an imported run, in the archive's units.
struct RunFacts {
  double step = 0;  // length of a time step, or --frame-interval if that is all that is known
  bool knows_step = true;
  int dimension = 2;
  std::string axes = "xy";  // letters of the axes, before the rotation to a slope
  Orientation orientation;
  bool discs = true;               // false: spheres
  std::vector<std::string> walls;  // descriptions of the straight walls that bound the flow
  std::optional<double> density;   // density of the grains, needed if they have no mass
  std::string doubt_of_masses;     // a sentence if the masses contradict `discs`
  Units units;
  std::string units_as_given;
};

/// Frames of the archive from which facts are found.
struct FirstLook {
  const ArchiveFrame& all;           // frame with all grains, perhaps without contacts
  const ArchiveFrame& frame;         // early frame with contacts
  const std::vector<bool>& resting;  // true for each grain of `all` at rest (proposals.hpp)
};

/// Finds each fact in the archive or on the command line. Unless stated, grains are spheres if they
/// do not lie in a plane, and discs if their masses grow as the square of their radii. For a
/// missing fact a question is added to `questions`; the fact is then the proposed one, or
/// meaningless. Throws UsageError if archive and command line contradict each other.
RunFacts collect_facts(const ArchiveFacts& archive, const FirstLook& look,
                       const ImportSettings& settings, Questions& questions);

/// Mass of every grain, from the archive, or density times area or volume. Throws FormatError if a
/// grain has no positive mass and the density is unknown.
std::vector<double> masses_of(const ArchiveGrains& grains, const RunFacts& facts);

}  // namespace grseg
