// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/grouping.hpp"
#include "analysis/render/film.hpp"
#include "analysis/render/picture_options.hpp"
#include "formats/cli/frame_range.hpp"
#include "formats/cli/output.hpp"

#include <string>

/// A picture or a film of a run, from reading its frames to the finished file.
namespace grseg {

struct RenderSettings {
  const char* program = "";  // name of the program in messages
  PictureOptions picture;
  FrameRange range;            // frames of a film
  double every = 0, fps = 25;  // of a film: simulated time between pictures, s; pictures per s
  int threads = 1;             // number of threads for a film, at least 1
  OutputOptions output;
  bool quiet = false;
};

struct RenderSource {
  const TrajectoryReader& run;
  const GroupedGrains& grains;
  const RenderSettings& settings;
  PictureKind kind;
  std::string history;  // text that the file stores, see picture_bytes() and FilmFormat
};

/// Makes a picture of the frames of --at, side by side. Throws the errors of Picture, PictureOptions and
/// write_whole().
template <int D>
void make_picture(const RenderSource& source);

/// Makes a film of the frames in `range`, with one picture for each span of `every` seconds. Throws
/// UsageError if `every` is negative, Interruption, and the errors of Picture, Film and Output.
template <int D>
void make_film(const RenderSource& source);

}  // namespace grseg
