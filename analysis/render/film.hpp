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

/// Where ffmpeg is. RunError, with the remedy, where it is not in PATH.
std::string find_ffmpeg();

/// Of the numbers of frames, in order, those that a film shows: the first in each span of `every`
/// seconds, all where `every` is 0. `times` (s) are those of all frames of the run; a frame may be
/// half a step early. Spans without frames are passed over.
std::vector<std::size_t> film_frames(const std::vector<double>& times,
                                     const std::vector<std::size_t>& frames, double every,
                                     double step);

/// A text that fits into `most` bytes: of a longer one the middle is left out, and it says so.
std::string shortened(const std::string& text, std::size_t most);

/// What a film is like.
struct FilmFormat {
  PictureKind kind = PictureKind::mp4;
  Vec2 size = Vec2::Zero();  // px, even whole numbers
  double fps = 25;           // pictures per second
  std::string history{};     // kept inside as comment, shortened where a program's argument must be
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
