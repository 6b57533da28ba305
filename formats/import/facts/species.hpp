// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/species.hpp"
#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// How the command line separates the species.
struct SpeciesSettings {
  std::vector<std::string> named;                     // named_species.hpp; else
  std::optional<std::string> small, large, boundary;  // types
  std::optional<std::string> boundary_ids;
  std::optional<double> split_diameter;
  std::optional<double> small_diameter, large_diameter;  // nominal
};

/// Species of every grain, those of mobile grains as a list, and in words how they were found.
struct SpeciesFound {
  std::vector<Species> species;
  SpeciesList list;  // nominal diameters as given, in the archive's units; 0: not given
  std::string base, sizes;
};

/// Boundary grains are those of the types or ids that were named, or that the archive marks as
/// fixed; all others are of a named species, or small or large: by type, by --split-diameter, or,
/// where none is given, by two sizes far apart: the widest step between diameters is a factor of
/// 1.2 or more, and on either side of it they differ by less than the root of that factor.
/// OpenQuestions with a histogram of diameters where there are no such two sizes.
SpeciesFound assign_species(const ArchiveGrains& grains, const SpeciesSettings& settings);

/// "0.0048 to 0.0052: 120, ...": numbers of values in ten equal bins; empty bins are left out.
std::string histogram(std::vector<double> values);

}  // namespace grseg
