// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/species.hpp"
#include "formats/import/common/archive.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Any number of species by type, each as --species gives it: NAME=TYPES or NAME=TYPES:DIAMETER,
/// where TYPES are a list (type_list.hpp) or "all", and DIAMETER is nominal, in the archive's units.
struct NamedSpecies {
  SpeciesList list;              // in order of nominal diameters; 0 where it was not given
  std::vector<Species> species;  // of every grain
  std::string sizes;             // in words how they were found
};

/// Species of all grains that are not `boundary`. A diameter that is not given is the mean of the
/// smallest and the largest of the species. UsageError where a text is not of the form above, a name
/// does not fit files and tables, a species has neither grains nor a diameter, or the type of a
/// mobile grain is in no species or in several.
NamedSpecies assign_named_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                                  const std::vector<std::string>& texts);

}  // namespace grseg
