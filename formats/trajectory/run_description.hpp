// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "formats/core/species.hpp"

#include <vector>

namespace grseg {

/// What a trajectory file holds once.
struct RunDescription {
  Grains grains;
  Box box;
  Parameters parameters;
  std::vector<Observable> observables;
  bool has_force = true;            // false: no frame has forces on grains, as in some imports
  SpeciesList species = {};         // of mobile grains; none: small and large
  bool grains_come_and_go = false;  // true: a grain may be absent in a frame (core/frame.hpp)
};

/// The mobile species of a run, of which there is at least one: where the description lists none,
/// small and large with the diameters of /parameters (0 where these name none).
inline SpeciesList species_of(const RunDescription& run)
{
  if (!run.species.empty()) return run.species;
  return two_sizes(run.parameters.find_number("small_diameter").value_or(0),
                   run.parameters.find_number("large_diameter").value_or(0));
}

}  // namespace grseg
