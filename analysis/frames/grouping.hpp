// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"
#include "formats/core/species.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The number of the species that a word names, or of which it is the number, from 1.
std::optional<std::size_t> number_of_species(const std::string& word, const SpeciesList& species);
std::vector<std::string> names_of(const SpeciesList& species);

/// Division of a run's mobile grains into species, as given on the command line; by default into
/// the species of its file.
struct GroupingOptions {
  std::vector<std::string> groups{};  // "AM=1,2"
  int classes = 0;
  std::string edges{};

  /// Adds --group --classes --edges.
  void add_to(po::options_description& options);
};

/// The grains of a run with the species that an analysis tells apart.
struct GroupedGrains {
  Grains grains;
  SpeciesList species;
};

/// Mobile species in order of diameter. The diameter of a group of several species, or of a class
/// of sizes, is the mean sum d^D/sum d^(D-1) over its grains (Sauter mean): with it the neutral
/// model, whose contact ends are in proportion to phi/d, holds for the group as it does for each of
/// its grains.
///
/// --group NAME=LIST merges species, which LIST names by number (from 1) or name; --classes N makes
/// N classes of sizes of which each has the same volume of mobile grains, as far as grains of one
/// size allow it; --edges D1,D2 divides them by diameter. UsageError where these exclude each
/// other, name what is not there, leave out a species or make an empty class.
GroupedGrains group_grains(const TrajectoryReader& run, const GroupingOptions& options);

}  // namespace grseg
