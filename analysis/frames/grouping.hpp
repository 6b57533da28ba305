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

/// Place in the list, from 0, of the species whose name or number (from 1) is `word`; nothing if
/// there is no such species.
std::optional<std::size_t> number_of_species(const std::string& word, const SpeciesList& species);
std::vector<std::string> names_of(const SpeciesList& species);

/// Options that divide a run's mobile grains into species; by default the species of its file.
struct GroupingOptions {
  std::vector<std::string> groups{};  // values of --group, such as "AM=1,2"
  int classes = 0;                    // value of --classes; 0: not given
  std::string edges{};                // value of --edges; "": not given

  /// Adds --group --classes --edges.
  void add_to(po::options_description& options);
};

/// The grains of a run, with the species that an analysis distinguishes.
struct GroupedGrains {
  Grains grains;
  SpeciesList species;
};

/// Grains with species as --group, --classes or --edges define them, sorted by diameter. A group of
/// several species, or a class of sizes, has the Sauter mean diameter, sum d^D/sum d^(D-1) over its
/// grains. With it the neutral model (docs/glossary.md), in which a species has contact ends in
/// proportion to phi/d, is valid for the group as for each of its grains.
///
/// --group NAME=LIST merges the species that LIST gives by number (from 1) or name. --classes N
/// divides the grains by size into N classes of equal volume, as far as grains of one size allow.
/// --edges D1,D2 divides them at diameters. Throws UsageError if two of these options are given, if
/// a species does not exist or is left out, or if a class is empty.
GroupedGrains group_grains(const TrajectoryReader& run, const GroupingOptions& options);

}  // namespace grseg
