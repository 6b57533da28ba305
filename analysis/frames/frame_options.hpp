// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/grouping.hpp"
#include "analysis/frames/map_grid.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/part.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/tool.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The options of every tool that sums over the frames of a run by layer and window.
struct FrameOptions {
  TableOptions output;
  std::string layer = "4dS", bins = "layers";
  WindowSettings windows;
  int threads = 1;
  bool json = false, quiet = false;
  TrustOption trust;
  GroupingOptions grouping;
  PartOptions parts;

  enum class Makes { table, page };
  /// Adds --output --overwrite --begin --end --stride --layer --window --threads --trust --json
  /// --quiet --group --classes --edges, and of a table --short --digits.
  void add_to(po::options_description& options, Makes makes = Makes::table);
  /// Adds --bins, for tools that also know annuli and maps.
  void add_bins_to(po::options_description& options);
  /// Adds --part and --join, for tools whose table has rows of one window each.
  void add_parts_to(po::options_description& options) { parts.add_to(options); }

  bool annuli() const { return bins.starts_with("radius"); }
  /// The plane of a map, where --bins names one.
  std::optional<MapPlane> map() const;
  /// x and y of the axis about which bins lie, where --bins names one, or else that of the run's drum.
  /// UsageError where it names neither a kind of bins nor an axis.
  std::optional<Vec2> axis(const TrajectoryReader& run) const;
  /// The same with the number of threads for 0, and the file of a part for that of the whole table.
  /// UsageError where the output cannot be made, or not of what the options ask for.
  FrameOptions checked(const po::variables_map& values) const;
};

/// UsageError, "--option why", where one of `options` was given although it has no meaning here.
void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why);

}  // namespace grseg
