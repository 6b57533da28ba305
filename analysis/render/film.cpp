// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/film.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string_view>

namespace grseg {
namespace {

/// Largest size of a film's comment, bytes. Linux limits each argument of a program to 128 KiB
/// (MAX_ARG_STRLEN).
constexpr std::size_t longest_comment = 100000;

std::vector<std::string> words_of(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> arguments(const std::string& path, const FilmFormat& format)
{
  auto all = words_of(fmt::format(
      "-hide_banner -nostdin -loglevel error -y -f rawvideo -pix_fmt bgr0 -s {}x{} -r {} "
      "-i pipe:0 -an -map_metadata -1 -fflags +bitexact -flags:v +bitexact -threads 4 "
      "-vf scale=out_color_matrix=bt709 -pix_fmt yuv420p -colorspace bt709 -color_primaries "
      "bt709 -color_trc bt709",
      format.size.x(), format.size.y(), format.fps));
  const auto coding =
      words_of(format.kind == PictureKind::mp4
                   ? "-c:v libx264 -preset superfast -crf 23 -movflags +faststart -f mp4"
                   : "-c:v libvpx-vp9 -deadline good -cpu-used 4 -crf 30 -b:v 0 -f webm");
  all.insert(all.end(), coding.begin(), coding.end());
  // These arguments are not split at spaces, since they may contain spaces. "file:" prevents ffmpeg from
  // reading a name as an address.
  all.insert(all.end(), {"-metadata", "comment=" + shortened(format.history, longest_comment),
                         "file:" + path});
  return all;
}

std::string last_line(const std::string& text)
{
  std::istringstream lines(text);
  std::string last = "it printed no message";
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return printable(last);
}

}  // namespace

std::string find_ffmpeg()
{
  if (const auto path = find_program("ffmpeg")) return *path;
  throw RunError(
      "ffmpeg, which makes films, is not in PATH: install it (Debian: apt-get install ffmpeg), or "
      "make pictures (-o NAME.png)");
}

std::vector<std::size_t> film_frames(const std::vector<double>& times,
                                     const std::vector<std::size_t>& frames, double every,
                                     double step)
{
  if (every == 0 || frames.empty()) return frames;
  std::vector<std::size_t> shown;
  const double begin = times[frames.front()];
  double next = begin;
  for (const auto index : frames) {
    const double time = times[index] + step / 2;
    if (time < next) continue;
    shown.push_back(index);
    next = begin + every * (std::floor((time - begin) / every) + 1);
  }
  return shown;
}

std::string shortened(const std::string& text, std::size_t most)
{
  constexpr std::string_view left_out = "\n[the middle is left out]\n";
  if (text.size() <= most) return text;
  const auto inside = [&](std::size_t at) {  // true inside a character of several bytes (UTF-8)
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  const std::size_t half = (most - left_out.size()) / 2;
  std::size_t end = half, begin = text.size() - half;
  while (end > 0 && inside(end)) --end;
  while (inside(begin)) ++begin;
  return text.substr(0, end).append(left_out).append(text, begin);
}

Film::Film(const std::string& ffmpeg, const std::string& path, const FilmFormat& format)
    : program_(ffmpeg, arguments(path, format))
{
}

void Film::add(std::span<const std::uint8_t> pixels)
{
  if (!program_.write(pixels)) finish();
}

void Film::finish()
{
  const auto [code, said] = program_.finish();
  if (code != 0)
    throw RunError(fmt::format("ffmpeg failed with exit code {}: {}", code, last_line(said)));
}

}  // namespace grseg
