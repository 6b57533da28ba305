// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/bed.hpp"
#include "formats/cli/table.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// A run, as a table that is made of it describes it.
struct RunSource {
  std::string input;                 // its digest; "" where the table names none
  std::optional<Bed> bed;            // not of tables made before there was such a line
  std::vector<std::string> history;  // of the run, without what made the table

  /// The scene's seed; "" where neither the bed nor the command names it.
  std::string seed() const;
};

/// The runs of a table, several where it was merged; at least one.
std::vector<RunSource> sources_of(const Table& table);

/// The things that two runs share.
enum class Kinship {
  none,         ///< other grains, or another seed
  untold,       ///< nothing that is recorded tells
  same_grains,  ///< without a seed: one run, or several that began from one list of radii
  one_bed,      ///< one deposition, and so one run: the same grains, or a history that goes on
  same_motion,  ///< the same in all that acts on the motion: at one time they hold the same
};
Kinship kinship(const RunSource& a, const RunSource& b);
/// The closest of any of their runs.
Kinship kinship(const std::vector<RunSource>& a, const std::vector<RunSource>& b);

}  // namespace grseg
