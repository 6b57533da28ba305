// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/part.hpp"
#include "formats/cli/words.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/import/facts/species.hpp"
#include "formats/trajectory/writer.hpp"

#include <boost/program_options.hpp>

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Where a job that began from an earlier checkpoint writes moments again: whose of them count.
enum class Repeated {
  ask,    // moments with equal grains count once; others are refused
  first,  // moments of the earlier job
  last    // moments of the later job
};
inline constexpr Choice<Repeated> repeated_words[] = {{"first", Repeated::first},
                                                      {"last", Repeated::last}};
/// Words of --grains-are: true for discs.
inline constexpr Choice<bool> grain_words[] = {{"discs", true}, {"spheres", false}};
/// Words of --origin: true where y = 0 is the top of the base grains.
inline constexpr Choice<bool> origin_words[] = {{"top", true}, {"centre", false}};

/// The command line of grseg-import. Numbers are in the units of the archive, as in the other
/// program's input; the trajectory is SI.
struct ImportSettings {
  std::string format;
  ArchiveFiles files;

  std::optional<std::string> units;    // units.hpp
  std::optional<double> step;          // length of a time step
  std::optional<double> interval;      // between moments that the archive numbers one by one
  std::optional<double> density;       // of discs per area, of spheres per volume
  std::optional<std::string> grains;   // "discs", "spheres"
  std::optional<std::string> gravity;  // axes.hpp
  std::optional<double> slope;         // degrees
  std::optional<std::string> axes;     // "xy" where not given
  std::string origin = "top";          // or "centre", or a height in the archive
  std::optional<int> dimension;        // axes.hpp
  SpeciesSettings species;
  std::vector<std::string> walls;  // cell_and_walls.hpp
  std::vector<std::string> cells;  // cell_and_walls.hpp

  std::optional<std::string> begin, end;     // moments.hpp
  std::optional<std::string> repeated;       // moments.hpp
  std::vector<std::string> accept_residual;  // check_context.hpp
  bool strict = false;                       // refuse what is undecided
  bool drop_incomplete = false;
  std::string output;
  PartOptions parts;
  StorageSettings storage;
  bool overwrite = false, quiet = false;
};

/// The options that fill `settings`, in groups as --help shows them.
boost::program_options::options_description import_options(ImportSettings& settings);

}  // namespace grseg
