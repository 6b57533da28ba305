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

/// Options of the command line about pictures.
struct PictureOptions {
  std::vector<std::string> at;
  std::string color = "species", range, partition, force_width = "0.6dS", plane = "xy",
              theme = "light", width;
  PictureSettings plain;  // settings that need no parsing; the others keep their defaults

  void add_to(po::options_description& options);

  /// The settings for a run. UsageError where an option has a value that it does not take.
  PictureSettings settings(const TrajectoryReader& run) const;
  /// Numbers of the frames nearest to --at, by default the last one. UsageError where the run has no
  /// such time.
  std::vector<std::size_t> frames_at(const TrajectoryReader& run) const;
};

/// --width: pixels, or the width of a printed page.
struct PageWidth {
  std::optional<double> pixels;
  double em;      // px
  double points;  // for each pixel
};
/// Reads a width: pixels, "1280", or a length on paper, "86mm", "8.6cm" or "3.4in", with 300 pixels an inch
/// and letters of 8 points; "" is the default. UsageError where the text is none of these.
PageWidth parse_width(const std::string& text);

}  // namespace grseg
