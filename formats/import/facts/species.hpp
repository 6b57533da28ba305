// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/archive.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Numbers and ranges such as "1,4-9", or "none".
class NumberList {
 public:
  /// UsageError naming `option` where the text is not such a list.
  NumberList(const std::string& text, const std::string& option);
  bool contains(std::int64_t number) const;

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges_;  // first and last
};

/// How the command line separates the species.
struct SpeciesSettings {
  std::optional<std::string> small, large, boundary;  // types
  std::optional<std::string> boundary_ids;
  std::optional<double> split_diameter;
};

/// Species of every grain, and in words how they were found.
struct SpeciesFound {
  std::vector<Species> species;
  std::string base, sizes;
};

/// Boundary grains are those of the types or ids that were named, or that the archive marks as
/// fixed; all others are small or large by type, by --split-diameter, or, where none is given, by
/// two sizes far apart: the widest step between diameters is a factor of 1.2 or more, and on either
/// side of it they differ by less than the root of that factor. UsageError with a histogram of
/// diameters where there are no such two sizes.
SpeciesFound assign_species(const ArchiveGrains& grains, const SpeciesSettings& settings);

/// "0.0048 to 0.0052: 120, ...": numbers of values in ten equal bins; empty bins are left out.
std::string histogram(std::vector<double> values);

}  // namespace grseg
