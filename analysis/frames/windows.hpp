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
  double begin = 0, end = 0;        // s
  std::vector<std::size_t> frames;  // numbers of the frames in the file, never empty
};

/// The length of one window over all frames that are used.
inline constexpr double all_frames = std::numeric_limits<double>::infinity();

/// The part of a run that is cut into windows, and their length.
struct WindowSettings {
  double length = 1.25;              // s, or all_frames
  std::optional<double> begin = {};  // s; by default t = 0, or the first frame if that is later
  std::optional<double> end = {};    // s; by default the end of the run
  int stride = 1;                    // use one frame in `stride`
};

/// The option --window of a tool: a time in s, or "all".
po::typed_value<std::string>* window_option(WindowSettings& settings);
/// The value of --window, "1.25" or "all".
std::string window_text(const WindowSettings& settings);

/// The times of a run as its file has them.
struct RunTimes {
  std::vector<std::int64_t> steps;  // of the frames, increasing
  double step = 0;                  // s
  double frame_interval = 0;  // s, of the scene, from one burst of frames to the next; 0: unknown
};
RunTimes times_of(const TrajectoryReader& run);

/// Most steps that a frame stands for: the longest time between two frames that is not a hole. It
/// is at most the scene's interval; where this is not known, two other intervals are at least half
/// as long.
std::int64_t longest_interval(const RunTimes& run);

/// Windows of one run, each `length` long (s).
struct Windows {
  double length = 0;
  std::vector<Window> list;
};

/// Window n holds the frames with n W <= t - begin < (n+1) W. Times are compared in whole steps, so
/// that no rounding moves a frame into the next window; a length W that is not a whole number of
/// steps is rounded to one. All frames of a window count alike, however close they are. A frame of
/// the file stands for the time up to the next one, and at most for longest_interval(). A window is
/// dropped if the run does not fill it. Mostly this is the last one. A window that is filled begins
/// less than longest_interval() before the first frame and ends within the time of the last one,
/// and frames stand for at least nine tenths of it. RunError where nothing is left, UsageError
/// where a window would be shorter than the time that a used frame stands for; both say what would
/// fit.
Windows cut_into_windows(const RunTimes& run, const WindowSettings& settings);

}  // namespace grseg
