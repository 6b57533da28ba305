// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/render_run.hpp"

#include "analysis/frames/in_order.hpp"
#include "analysis/render/picture.hpp"
#include "formats/cli/interruption.hpp"
#include "formats/cli/progress.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <vector>

namespace grseg {
namespace {

/// Warns if frames are further apart than --every, because the film is then faster than asked.
void warn_if_sparse(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                    const RenderSettings& s)
{
  if (s.quiet || s.every == 0 || frames.size() < 2) return;
  const double length = run.times()[frames.back()] - run.times()[frames.front()];
  const double apart = length / static_cast<double>(frames.size() - 1);
  if (apart > s.every + run.step() / 2)
    fmt::print(
        stderr,
        "{}: the frames are {:.3g} s apart, so --every {:g} shows all of them and the film is "
        "{:.3g} times as fast as asked; to keep the speed use --fps {:.3g}\n",
        s.program, apart, s.every, apart / s.every, s.fps * s.every / apart);
}

std::vector<std::size_t> frames_of_film(const TrajectoryReader& run, const RenderSettings& s)
{
  const auto all = s.range.frames_of(run);
  if (!(s.every >= 0) || !std::isfinite(s.every)) throw UsageError("--every must be positive");
  warn_if_sparse(run, all, s);
  return film_frames(run.times(), all, s.every, run.step());
}

}  // namespace

template <int D>
void make_picture(const RenderSource& source)
{
  const auto& options = source.settings.picture;
  const auto frames = options.frames_at(source.run);
  const auto others = options.other_times(source.run);
  if (!others.empty() && !source.settings.quiet)
    tell(fmt::format("{}: shows the nearest frames: {}\n", source.settings.program,
                     printable(others)));
  const Picture<D> picture(source.run, source.grains, frames, frames.size(),
                           options.settings(source.run));
  std::vector<Drawing> drawings;
  drawings.reserve(frames.size());
  Frame<D> frame;
  for (const auto index : frames) {
    source.run.read(index, frame, picture.needs());
    drawings.push_back(picture.draw(frame));
  }
  if (std::ranges::all_of(drawings, [](const auto& drawing) { return drawing.discs.empty(); }))
    picture.refuse_as_empty();
  write_whole(
      source.settings.output,
      picture_bytes(source.kind, picture.page().size, parse_width(options.width).points,
                    source.history, [&](cairo_surface_t* page) { picture.paint(page, drawings); }));
}

template void make_picture<2>(const RenderSource&);
template void make_picture<3>(const RenderSource&);

template <int D>
void make_film(const RenderSource& source)
{
  const auto& s = source.settings;
  const auto ffmpeg = find_ffmpeg();
  const auto frames = frames_of_film(source.run, s);
  auto settings = s.picture.settings(source.run);
  settings.is_film = true;
  const Picture<D> picture(source.run, source.grains, frames, 1, settings);
  listen_to_signals();
  Output output(s.output.path, s.output.overwrite, {source.run.path()});
  Film film(ffmpeg, output.temporary(), {source.kind, picture.page().size, s.fps, source.history});
  ProgressBar progress(
      s.program, {.things = "pictures", .total = static_cast<double>(frames.size())}, s.quiet);

  std::mutex reading;
  std::size_t done = 0;
  std::atomic<bool> has_grains = false;
  const auto pixels_of = [&](std::size_t k) {
    Frame<D> frame;
    TrajectoryReader::Packed packed;
    {
      const std::lock_guard lock(reading);
      packed = source.run.load(frames[k], frame, picture.needs());
    }
    source.run.unpack(packed, frame);
    const std::vector<Drawing> drawings{picture.draw(frame)};
    if (!drawings.front().discs.empty()) has_grains = true;
    return Pixels(picture.page().size,
                  [&](cairo_surface_t* page) { picture.paint(page, drawings); });
  };
  in_order(s.threads, frames.size(), pixels_of, [&](const Pixels& pixels) {
    stop_if_interrupted();
    film.add(pixels.bytes());
    progress.show(static_cast<double>(++done));
  });
  progress.clear();
  if (!has_grains) picture.refuse_as_empty();
  film.finish();
  output.publish();
}
template void make_film<2>(const RenderSource&);
template void make_film<3>(const RenderSource&);

}  // namespace grseg
