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

/// Path of ffmpeg. Throws RunError, with the remedy, if ffmpeg is not in PATH.
std::string find_ffmpeg();

/// Numbers of the frames that a film shows, chosen from `frames` (ascending numbers): the first frame in
/// each span of `every` seconds, or all frames if `every` is 0. Spans without frames are skipped. `times`:
/// times of all frames of the run, s. `step`: time step of the run, s; a frame may be half a step early.
std::vector<std::size_t> film_frames(const std::vector<double>& times,
                                     const std::vector<std::size_t>& frames, double every,
                                     double step);

/// The text, shortened to at most `most` bytes: a remark replaces the middle of a longer text.
std::string shortened(const std::string& text, std::size_t most);

/// Size, speed and coding of a film.
struct FilmFormat {
  PictureKind kind = PictureKind::mp4;
  Vec2 size = Vec2::Zero();  // width and height, px; even whole numbers
  double fps = 25;           // pictures per second
  std::string history{};     // comment stored in the film; shortened if too long for an argument
};

/// A film that ffmpeg encodes from the pictures that are added: H.264 in MP4, VP9 in WebM. The number of
/// threads of ffmpeg is fixed, because the bytes of the film depend on it: equal pictures give equal films.
class Film {
 public:
  /// Starts to write the file `path`; an existing file is replaced.
  Film(const std::string& ffmpeg, const std::string& path, const FilmFormat& format);

  /// Adds a picture, given as Pixels::bytes(). Throws RunError with ffmpeg's message if ffmpeg has failed.
  void add(std::span<const std::uint8_t> pixels);
  /// Completes the file after the last picture.
  void finish();

 private:
  PipedProgram program_;
};

}  // namespace grseg
