// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/facts/import_settings.hpp"

#include <string>

namespace grseg {

/// All grains of an archive in which grains come and go.
struct Roster {
  /// A moment that never was, with every grain that ever occurs in the range of the import: its
  /// type, radius, mass and fixed flag, the mean of its positions and the fastest of its velocities.
  /// Where the cell is open it holds all grains of all moments. No contacts. Facts that would
  /// otherwise be found from the first moment are found from this one.
  ArchiveMoment all;
  std::size_t fewest = 0, most = 0;  // grains at a moment
  std::size_t moments = 0;

  bool grains_change() const { return fewest < all.grains.size(); }
};

/// Reads the grains of all moments between --begin and --end. FormatError naming moment and grain
/// where an id occurs twice at a moment or changes what a grain keeps (require_same_grain).
Roster read_roster(const ImportSettings& settings);

/// Whether the grains of the first few moments differ.
bool grains_change_early(const ImportSettings& settings);

/// What a grain keeps for as long as it has its id: radius, mass, type, and whether it is fixed, as
/// far as the archive has them. FormatError naming `place`, with what to do, where grain g of `now`
/// is not the same as grain `row` of `known`.
void require_same_grain(const ArchiveGrains& known, std::size_t row, const ArchiveGrains& now,
                        std::size_t g, const std::string& place);

/// A moment has other grains than the first one: the import begins anew, with a roster.
struct OtherGrains : FormatError {
  using FormatError::FormatError;
};

}  // namespace grseg
