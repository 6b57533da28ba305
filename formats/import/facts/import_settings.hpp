// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/import/facts/species.hpp"
#include "formats/trajectory/writer.hpp"

#include <boost/program_options.hpp>

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Frames to import if a later job began from an earlier checkpoint and wrote frames again.
enum class Repeated {
  ask,    // frames with equal grains are imported once; others are an error
  first,  // frames of the earlier job
  last    // frames of the later job
};
inline constexpr Choice<Repeated> repeated_words[] = {{"first", Repeated::first},
                                                      {"last", Repeated::last}};
/// Words of --grains-are: true for discs.
inline constexpr Choice<bool> grain_words[] = {{"discs", true}, {"spheres", false}};
/// Words of --origin: true if y = 0 is the top of the base grains.
inline constexpr Choice<bool> origin_words[] = {{"top", true}, {"centre", false}};

/// The command line of grseg-import. Numbers are in the units of the archive, as in the input of
/// the program that wrote it; the trajectory is in SI.
struct ImportSettings {
  std::string format;
  ArchiveFiles files;

  std::optional<std::string> units;    // the archive's units: units.hpp
  std::optional<double> step;          // length of a time step
  std::optional<double> interval;      // time between frames, if the archive numbers its frames
  std::optional<double> density;       // density of the grains, per area (discs) or volume
  std::optional<std::string> grains;   // shape of the grains: "discs", "spheres"
  std::optional<std::string> gravity;  // vector or magnitude of gravity: axes.hpp
  std::optional<double> slope;         // inclination of the base, degrees
  std::optional<std::string> axes;     // axes of the flow, two letters; empty: "xy"
  std::string origin = "top";          // height of y = 0: "top", "centre", or a height
  std::optional<int> dimension;        // dimension of the flow, 2 or 3: axes.hpp
  SpeciesSettings species;
  std::vector<std::string> walls;  // plane walls, NAME=AXIS:POSITION: cell_and_walls.hpp
  std::vector<std::string> cells;  // bounds of the cell, AXIS:LOW:HIGH: cell_and_walls.hpp

  std::optional<std::string> begin, end;     // first and last time or step: archive_frames.hpp
  std::optional<std::string> repeated;       // "first", "last": archive_frames.hpp
  std::vector<std::string> accept_residual;  // accepted checks, NAME=R: check_context.hpp
  bool strict = false;                       // true: an undecided check is an error
  bool drop_incomplete = false;
  std::string output;
  StorageSettings storage;
  bool overwrite = false, quiet = false;
};

/// The options of the command line, in groups for --help; their values are stored in `settings`.
boost::program_options::options_description import_options(ImportSettings& settings);

}  // namespace grseg
