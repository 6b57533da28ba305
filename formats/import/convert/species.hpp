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

/// "1,4-9" as ranges, "none" as none at all.
class NumberList {
 public:
  /// UsageError naming `option` where the text is no such list.
  NumberList(const std::string& text, const std::string& option);
  bool contains(std::int64_t number) const;

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges_;  // first and last
};

/// How the command line tells species apart; each by its own option or by none.
struct SpeciesSettings {
  std::optional<std::string> small, large, boundary;  // types
  std::optional<std::string> boundary_ids;
  std::optional<double> split_diameter;
};

/// Species of every grain, and in words how they were told apart.
struct SpeciesFound {
  std::vector<Species> species;
  std::string base, sizes;
};

/// Boundary grains are those of the types or ids that were named, or that the archive marks as
/// fixed; all others are small or large by type, by --split-diameter, or, where none is given, by
/// two sizes far apart: the widest step between diameters is a factor of 1.2 or more, and on either
/// side of it they differ by less than the root of that factor. UsageError where that does not
/// tell, with the histogram of diameters.
SpeciesFound tell_species(const ArchiveGrains& grains, const SpeciesSettings& settings);

/// "0.0048 to 0.0052: 120, ...": how many of the values lie where, ten equal bins without empty
/// ones.
std::string histogram(std::vector<double> values);

}  // namespace grseg
