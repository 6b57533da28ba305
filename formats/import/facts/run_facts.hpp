// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/facts/axes.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/units.hpp"

#include <optional>
#include <string>

namespace grseg {

/// Facts of the whole of an imported run, in the archive's units; never guessed.
struct RunFacts {
  double step = 0;
  int dimension = 2;
  std::string axes = "xy";  // letters, before they are turned to a slope
  Orientation orientation;
  bool discs = true;               // false: spheres
  std::vector<std::string> walls;  // straight ones that bound the flow, in words
  std::optional<double> density;   // needed where grains have no mass
  std::string doubt_of_masses;     // a sentence where they suggest other grains than were told
  Units units;
  std::string units_as_given;
};

/// Moments from which facts are found.
struct FirstLook {
  const ArchiveMoment& all;          // a moment with all grains, perhaps without contacts
  const ArchiveMoment& moment;       // the first one
  const std::vector<bool>& resting;  // grains of `all` that seem to be the base (proposals.hpp)
};

/// Takes each fact from the archive or the command line. Grains are discs if their masses grow as the
/// square of their radii, and spheres if they lie in no plane, unless something else is told. What is missing is added
/// to `questions`, and the fact is then the one that is proposed, or of no meaning. UsageError where
/// archive and command line contradict each other.
RunFacts collect_facts(const ArchiveFacts& archive, const FirstLook& look,
                       const ImportSettings& settings, Questions& questions);

/// Mass of every grain: the archive's own, or density times area or volume. FormatError where a
/// grain has neither.
std::vector<double> masses_of(const ArchiveGrains& grains, const RunFacts& facts);

}  // namespace grseg
