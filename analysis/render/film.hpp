// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/picture_file.hpp"
#include "analysis/render/piped_program.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// Path of ffmpeg. RunError, with the remedy, where it is not in PATH.
std::string find_ffmpeg();

/// Frames that a film shows, out of `frames` (numbers, in order): the first one in each span of `every`
/// seconds, or all if `every` is 0. Spans without frames are skipped. `times`: of all frames of the run,
/// s. `step`: time step of the run, s; a frame may be half a step early.
std::vector<std::size_t> film_frames(const std::vector<double>& times,
                                     const std::vector<std::size_t>& frames, double every,
                                     double step);

/// The text in at most `most` bytes: the middle of a longer one is replaced by a remark.
std::string shortened(const std::string& text, std::size_t most);

/// Size, speed and coding of a film.
struct FilmFormat {
  PictureKind kind = PictureKind::mp4;
  Vec2 size = Vec2::Zero();  // px, even whole numbers
  double fps = 25;           // pictures per second
  std::string history{};     // kept inside as comment, shortened if it is too long for an argument
};

/// A film that ffmpeg makes of the pictures that are added: H.264 in MP4, VP9 in WebM. The number of
/// its threads is fixed, since its bytes depend on it: the same pictures give the same film.
class Film {
 public:
  /// Writes, or replaces, the file `path`.
  Film(const std::string& ffmpeg, const std::string& path, const FilmFormat& format);

  /// Pixels::bytes() of a picture. RunError with ffmpeg's own words where it has given up.
  void add(std::span<const std::uint8_t> pixels);
  /// After the last picture: `path` is then whole.
  void finish();

 private:
  PipedProgram program_;
};

}  // namespace grseg
