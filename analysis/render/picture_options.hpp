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

/// What the command line says about pictures.
struct PictureOptions {
  std::vector<std::string> at;
  std::string color = "species", range, partition, force_width = "0.6dS", plane = "xy",
              theme = "light", width;
  PictureSettings plain;  // what is meant as it is typed

  void add_to(po::options_description& options);

  /// UsageError where something is not what its option takes.
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
/// "1280", or "86mm", "8.6cm", "3.4in", which has 300 pixels an inch and letters of 8 points; "": the
/// default. UsageError where the text is none of these.
PageWidth parse_width(const std::string& text);

}  // namespace grseg
