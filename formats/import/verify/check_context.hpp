// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "formats/core/species.hpp"
#include "formats/import/facts/units.hpp"
#include "formats/import/verify/finding.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// The diameters of the grains of a species, m.
struct SpeciesSizes {
  std::string name, types;  // of the archive, as --small and --large named them; or ""
  double nominal = 0, mean = 0, smallest = 0, largest = 0;
};

/// What of an imported run the checks are about; everything is in its file.
struct CheckContext {
  int dimension = 2;
  bool has_force = true;
  Vec3 gravity = Vec3::Zero();        // as given, m/s^2, in the axes of the flow
  std::array<Vec3, 3> axes;           // of the flow, in those of the archive
  Units units;                        // of the archive
  double step = 0;                    // s
  double frame_interval = 0;          // s, as given; 0: it is not
  bool gravity_is_given = true;       // on the command line, and not by the archive
  bool masses_are_given = false;      // likewise, as a density
  std::string doubt_of_masses;        // of the import, a sentence
  bool step_is_given = true;          // likewise
  bool times_are_own = false;         // times are the archive's, not steps times their length
  bool steps_are_own = true;          // numbers of steps are the archive's
  double tolerance = 0;               // of the balance, of the program
  std::string reason;                 // of this tolerance
  std::vector<SpeciesSizes> species;  // that have grains, in the order of the file
  double size_ratio = 1;              // of the larger to the smaller grains: mean radii
  Waivers waivers;
};

/// The context from what the file of an imported run says. FormatError naming `file` where it is not
/// that of an import that can be judged.
CheckContext check_context(const Grains& grains, const SpeciesList& species,
                           const Parameters& parameters, bool has_force,
                           const std::string& file = "");

/// Mobile grains with a radius from here on (m) are the larger ones: half-way, as a factor, between
/// the smallest and the largest. 0 where all have nearly the same size.
double split_of_sizes(const Grains& grains);

}  // namespace grseg
