// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/film.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <sstream>

namespace grseg {
namespace {

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
  // As words of their own, since they may hold anything; "file:" so that no name is an address.
  all.insert(all.end(), {"-metadata", "comment=" + format.history, "file:" + path});
  return all;
}

std::string last_line(const std::string& text)
{
  std::istringstream lines(text);
  std::string last = "it says nothing";
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
