// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"
#include "formats/import/common/archive.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Options of the command line that define the species.
struct SpeciesSettings {
  std::vector<std::string> named;                     // values of --species; empty: two sizes
  std::optional<std::string> small, large, boundary;  // lists of types
  std::optional<std::string> boundary_ids;
  std::optional<double> split_diameter;
  std::optional<double> small_diameter, large_diameter;  // nominal diameters
};

/// Species of every grain, the list of the species of mobile grains, and texts that describe how
/// base and sizes were found.
struct SpeciesFound {
  std::vector<Species> species;
  SpeciesList list;  // nominal diameters as given, in the archive's units; 0: not given
  std::string base, sizes;
};

/// Assigns species. Boundary grains have a named type or id, or are marked as fixed by the archive.
/// Other grains belong to a named species, or are small or large: by type, by --split-diameter, or
/// by two sizes far apart. Sizes are far apart if the widest gap between successive diameters is a
/// factor of 1.2 or more, and the diameters on either side differ by less than the square root of
/// that factor. Throws OpenQuestions with a histogram of diameters if there are no two such sizes.
SpeciesFound assign_species(const ArchiveGrains& grains, const SpeciesSettings& settings);

/// A list of numbers and ranges such as "1,4-9", or "none".
class NumberList {
 public:
  /// Throws UsageError naming `option` if the text is not such a list.
  NumberList(const std::string& text, const std::string& option);
  bool contains(std::int64_t number) const;

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges_;  // first and last
};

/// The types of grains in the value of an option: numbers and ranges, or words if the archive names
/// its types by words; separated by commas. Or "none".
class TypeList {
 public:
  /// Throws UsageError naming `option` if the text is not such a list, or if no grain has a type of
  /// this name.
  TypeList(const std::string& text, const std::string& option, const ArchiveGrains& grains);
  bool contains(std::int32_t type) const;

 private:
  NumberList numbers_;
  std::vector<bool> named_;  // by type: true: the list contains its name
};

/// Assigns any number of named species to all grains that are not `boundary`. Each text is a value
/// of --species: NAME=TYPES or NAME=TYPES:DIAMETER, where TYPES is a TypeList or "all", and
/// DIAMETER is the nominal diameter in the archive's units (default: mean of the smallest and
/// largest diameter). Species are sorted by nominal diameter. Throws UsageError if a text does not
/// have this form, a name is not allowed in files and tables, a species has neither grains nor a
/// diameter, or the type of a mobile grain is in no species or in several.
SpeciesFound assign_named_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                                  const std::vector<std::string>& texts);

}  // namespace grseg
