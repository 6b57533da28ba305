// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Frames that are averaged together.
struct Window {
  double begin = 0, end = 0;        // times of its begin and end, s
  std::vector<std::size_t> frames;  // numbers of the frames in the file, never empty
};

/// The length of one window over all frames that are used.
inline constexpr double all_frames = std::numeric_limits<double>::infinity();

/// Options that divide a run into windows.
struct WindowSettings {
  double length = 1.25;              // length of a window, s, or all_frames
  std::optional<double> begin = {};  // begin of the first window, s; default: t = 0 or first frame
  std::optional<double> end = {};    // latest end of a window, s; default: the end of the run
  int stride = 1;                    // every `stride`-th frame is used
};

/// The option --window of a tool: a time in s, or "all".
po::typed_value<std::string>* window_option(WindowSettings& settings);
/// The value of --window, "1.25" or "all".
std::string window_text(const WindowSettings& settings);

/// The times of a run's frames, as its file stores them.
struct RunTimes {
  std::vector<std::int64_t> steps;  // step number of each frame, increasing
  double step = 0;                  // length of a step, s
  double frame_interval = 0;        // interval of the scene between bursts of frames, s; 0: unknown
};
RunTimes times_of(const TrajectoryReader& run);

/// Largest number of steps that a frame represents: the longest interval between two frames that is
/// not a hole in the run. It is at most the scene's frame interval. If this is not known, it is the
/// longest interval such that two other intervals are at least half as long.
std::int64_t longest_interval(const RunTimes& run);

/// Windows of one run.
struct Windows {
  double length = 0;  // length of each window, s
  std::vector<Window> list;
};

/// Divides a run into windows. Window n contains the frames with n W <= t - begin < (n+1) W. Times
/// are compared in whole steps, so that rounding moves no frame into the next window; a length W
/// that is not a whole number of steps is rounded. All frames of a window have equal weight, at any
/// distance in time. A frame represents the time up to the next frame, at most longest_interval().
///
/// A window is left out if the run does not fill it, usually the last one. A filled window begins
/// less than longest_interval() before the first frame, ends within the time of the last frame, and
/// at least nine tenths of it are represented by frames. Throws RunError if no window remains, and
/// UsageError if a window is shorter than the time between used frames; both suggest a remedy.
Windows cut_into_windows(const RunTimes& run, const WindowSettings& settings);

}  // namespace grseg
