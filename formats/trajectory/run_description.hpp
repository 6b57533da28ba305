// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace grseg {

/// What a trajectory file holds once.
struct RunDescription {
  Grains grains;
  Box box;
  Parameters parameters;
  std::vector<Observable> observables;
  bool has_force = true;  // false: no frame has forces on grains, as in some imports
};

/// An entry of the list of species in the file; its row is the number in /particles/grains/species.
struct SpeciesEntry {
  std::string_view name;
  double diameter;  // nominal, m; 0 for boundary grains, which have none
  bool mobile;      // part of phi
};

/// The species of a run: small, large, boundary. Diameters are those of /parameters, 0 where these
/// name none.
inline std::array<SpeciesEntry, 3> species_of(const Parameters& parameters)
{
  return {{{"small", parameters.find_number("small_diameter").value_or(0), true},
           {"large", parameters.find_number("large_diameter").value_or(0), true},
           {"boundary", 0, false}}};
}

}  // namespace grseg
