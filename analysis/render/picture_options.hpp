// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/picture.hpp"
#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Options of the command line that set how pictures look.
struct PictureOptions {
  std::vector<std::string> at;
  std::string color = "species", range, partition, force_width = "0.6dS", plane = "xy",
              theme = "light", width;
  PictureSettings plain;  // settings that need no parsing; all other settings have their defaults

  void add_to(po::options_description& options);

  /// Settings for a run. Throws UsageError if an option has a wrong value.
  PictureSettings settings(const TrajectoryReader& run) const;
  /// Numbers of the frames nearest to the times of --at; by default the last frame. Throws UsageError if a
  /// time lies outside of the run.
  std::vector<std::size_t> frames_at(const TrajectoryReader& run) const;
  /// Times of the frames shown that differ from those asked for: "11.95 s for --at 11.97"; "" if none.
  std::string other_times(const TrajectoryReader& run) const;
};

/// Page width and sizes that follow from the option --width.
struct PageWidth {
  std::optional<double> pixels;
  double em;      // size of letters, px
  double points;  // size of a pixel on paper, points (1/72 inch)
};
/// Reads a width: pixels, "1280"; or a length on paper, "86mm", "8.6cm" or "3.4in", with 300 pixels per inch
/// and letters of 8 points; or "", the default. Throws UsageError for any other text.
PageWidth parse_width(const std::string& text);

}  // namespace grseg
