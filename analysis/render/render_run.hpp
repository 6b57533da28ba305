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
  const char* program = "";  // name in messages
  PictureOptions picture;
  FrameRange range;            // of a film
  double every = 0, fps = 25;  // of a film: s of the run from picture to picture, pictures per s
  int threads = 1;             // of a film, at least 1
  OutputOptions output;
  bool quiet = false;
};

struct RenderSource {
  const TrajectoryReader& run;
  const GroupedGrains& grains;
  const RenderSettings& settings;
  PictureKind kind;
  std::string history;  // kept in the file
};

/// Makes a picture of the frames of --at, side by side. Errors as Picture, PictureOptions and write_whole.
template <int D>
void make_picture(const RenderSource& source);

/// Makes a film of the frames of the range, with a picture for each span of `every`. UsageError where
/// `every` is negative; errors as Picture, Film and Output; Interruption.
template <int D>
void make_film(const RenderSource& source);

}  // namespace grseg
