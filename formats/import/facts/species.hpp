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

/// How the command line separates the species.
struct SpeciesSettings {
  std::vector<std::string> named;                     // assign_named_species(); else
  std::optional<std::string> small, large, boundary;  // types
  std::optional<std::string> boundary_ids;
  std::optional<double> split_diameter;
  std::optional<double> small_diameter, large_diameter;  // nominal
};

/// Species of every grain, a list of the species of mobile grains, and in words how they were
/// found.
struct SpeciesFound {
  std::vector<Species> species;
  SpeciesList list;  // nominal diameters as given, in the archive's units; 0: not given
  std::string base, sizes;
};

/// Assigns species. Boundary grains have a type or id that was named, or the archive marks them as
/// fixed; all others are of a named species, or small or large: by type, by --split-diameter, or,
/// where none is given, by two sizes far apart: the widest step between diameters is a factor of
/// 1.2 or more, and on either side of it they differ by less than the root of that factor.
/// OpenQuestions with a histogram of diameters where there are no such two sizes.
SpeciesFound assign_species(const ArchiveGrains& grains, const SpeciesSettings& settings);

/// Numbers and ranges such as "1,4-9", or "none".
class NumberList {
 public:
  /// UsageError naming `option` where the text is not such a list.
  NumberList(const std::string& text, const std::string& option);
  bool contains(std::int64_t number) const;

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges_;  // first and last
};

/// Types of grains as an option lists them: numbers and ranges or, where the archive
/// has words for them, these words, separated by commas; or "none".
class TypeList {
 public:
  /// UsageError naming `option` where the text is not such a list, or where no grain has the word.
  TypeList(const std::string& text, const std::string& option, const ArchiveGrains& grains);
  bool contains(std::int32_t type) const;

 private:
  NumberList numbers_;
  std::vector<bool> named_;  // by type
};

/// Species of all grains that are not `boundary`, any number by type, each as --species gives it:
/// NAME=TYPES or NAME=TYPES:DIAMETER, where TYPES are a list as above or "all", and DIAMETER is
/// nominal, in the archive's units. They are in order of nominal diameters. A diameter that is not given
/// is the mean of the smallest and the largest of the species. UsageError where a text is not of the
/// form above, a name does not fit files and tables, a species has neither grains nor a diameter, or
/// the type of a mobile grain is in no species or in several.
SpeciesFound assign_named_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                                  const std::vector<std::string>& texts);

}  // namespace grseg
