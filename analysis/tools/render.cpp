// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_options.hpp"
#include "analysis/frames/grouping.hpp"
#include "analysis/frames/in_order.hpp"
#include "analysis/render/film.hpp"
#include "analysis/render/picture.hpp"
#include "analysis/render/picture_options.hpp"
#include "formats/cli/frame_range.hpp"
#include "formats/cli/interruption.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-render",
    "pictures and films of a run: grains by species or any field, and force chains.",
    "grseg-render run.h5 -o picture.png|.svg|.pdf|film.mp4|.webm [options]",
    "  grseg-render run.h5 -o last.png                          the last frame, grains by species\n"
    "  grseg-render run.h5 --at start,end -o figure-1.pdf       as figure 1 of Staron & Phillips\n"
    "  grseg-render run.h5 --color speed --at 10 -o speed.png   a field, and its colour bar\n"
    "  grseg-render run.h5 --forces --partition size -o f.svg   force chains, mixed contacts split\n"
    "  grseg-render run.h5 --width 86mm -o column.pdf           for a column of a paper\n"
    "  grseg-render run.h5 --every 0.1 --fps 25 -o film.mp4     a film, by ffmpeg\n"};

struct Settings {
  PictureOptions picture;
  FrameRange range;
  double every = 0, fps = 25;
  int threads = 1;
  TrustOption trust;
  GroupingOptions grouping;
  OutputOptions output;
  bool quiet = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  s.picture.add_to(options);
  s.range.add_to(options);
  auto add = options.add_options();
  add("every", po::value(&s.every)->value_name("s"),
      "of a film: time of the run from picture to picture (default: all frames)");
  add("fps", po::value(&s.fps)->default_value(s.fps, "25")->value_name("N"),
      "of a film: pictures per second");
  add("threads", po::value(&s.threads)->default_value(s.threads)->value_name("N"),
      "of a film: number of threads, 0: one per processor; the film is the same");
  s.grouping.add_to(options);
  s.trust.add_to(options);
  add("quiet", po::bool_switch(&s.quiet), "no progress");
  s.output.add_to(options, "a picture that ends in .png, .svg or .pdf, or a film in .mp4 or .webm");
  return options;
}

/// The header of a table about this run, as text.
std::string history_of(const TrajectoryReader& run, const std::string& command)
{
  auto lines = provenance(info, "none", run, command);
  for (auto& line : verification_lines(run)) lines.push_back(std::move(line));
  std::string text;
  for (const auto& [key, value] : lines) text += fmt::format("{}: {}\n", key, value);
  return text;
}

/// What all pictures of a run are made of.
struct Source {
  const TrajectoryReader& run;
  const GroupedGrains& grains;
  const Settings& settings;
  PictureKind kind;
  std::string history;
};

template <int D>
void make_picture(const Source& source)
{
  const auto& options = source.settings.picture;
  const auto frames = options.frames_at(source.run);
  const Picture<D> picture(source.run, source.grains, frames, frames.size(),
                           options.settings(source.run));
  std::vector<Drawing> drawings;
  drawings.reserve(frames.size());
  Frame<D> frame;
  for (const auto index : frames) {
    source.run.read(index, frame, picture.needs());
    drawings.push_back(picture.draw(frame));
  }
  write_whole(
      source.settings.output,
      picture_bytes(source.kind, picture.page().size, parse_width(options.width).points,
                    source.history, [&](cairo_surface_t* page) { picture.paint(page, drawings); }));
}

/// Where frames are further apart than --every the film is faster than was asked for.
void warn_if_sparse(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                    const Settings& s)
{
  if (s.quiet || s.every == 0 || frames.size() < 2) return;
  const double length = run.times()[frames.back()] - run.times()[frames.front()];
  const double apart = length / static_cast<double>(frames.size() - 1);
  if (apart > s.every + run.step() / 2)
    fmt::print(stderr,
               "{}: the frames are {:.3g} s apart, so that --every {:g} takes all of them and the "
               "film is {:.3g} times as fast as asked; --fps {:.3g} keeps the speed\n",
               info.name, apart, s.every, apart / s.every, s.fps * s.every / apart);
}

std::vector<std::size_t> frames_of_film(const TrajectoryReader& run, const Settings& s)
{
  const auto all = s.range.frames_of(run);
  if (!(s.every >= 0) || !std::isfinite(s.every)) throw UsageError("--every must be positive");
  warn_if_sparse(run, all, s);
  return film_frames(run.times(), all, s.every, run.step());
}

template <int D>
void make_film(const Source& source)
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
      info.name, {.things = "pictures", .total = static_cast<double>(frames.size())}, s.quiet);

  std::mutex reading;
  std::size_t done = 0;
  const auto pixels_of = [&](std::size_t k) {
    Frame<D> frame;
    TrajectoryReader::Packed packed;
    {
      const std::lock_guard lock(reading);
      packed = source.run.load(frames[k], frame, picture.needs());
    }
    source.run.unpack(packed, frame);
    const std::vector<Drawing> drawings{picture.draw(frame)};
    return Pixels(picture.page().size,
                  [&](cairo_surface_t* page) { picture.paint(page, drawings); });
  };
  in_order(s.threads, frames.size(), pixels_of, [&](const Pixels& pixels) {
    stop_if_interrupted();
    film.add(pixels.bytes());
    progress.show(static_cast<double>(++done));
  });
  progress.clear();
  film.finish();
  output.publish();
}

void check_film(const Settings& s)
{
  if (!(s.fps > 0 && s.fps <= 240)) throw UsageError("--fps must be positive, and at most 240");
  if (s.threads < 0 || s.threads > 1024)
    throw UsageError(fmt::format("--threads {}: it must be 0 to 1024", s.threads));
}

void render(Settings s, const po::variables_map& values, const std::string& command)
{
  if (s.output.path.empty()) throw UsageError("name what to write: -o NAME.png");
  const auto kind = picture_kind(s.output.path);
  const TrajectoryReader run(single_input(values, "render one at a time"), s.trust.verify());
  s.output.check(values);
  if (is_film(kind))
    refuse_options(values, {"at"}, "makes a picture; of a film say --begin and --end");
  else
    refuse_options(values, {"begin", "end", "stride", "every", "fps", "threads"},
                   "concerns films; name one, as in -o film.mp4, or say --at");
  check_film(s);
  if (s.threads == 0)
    s.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto grains = group_grains(run, s.grouping);
  const Source source{run, grains, s, kind, history_of(run, command)};
  with_dimension(run.dimension(),
                 [&](auto d) { is_film(kind) ? make_film<d>(source) : make_picture<d>(source); });
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    render(settings, values, command_line(argc, argv));
  });
}
