// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/render/render_run.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <thread>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-render",
    "pictures and films of a run: grains by species or any field, and force chains.",
    "grseg-render run.h5 -o picture.png|.svg|.pdf|film.mp4|.webm [options]",
    "  grseg-render run.h5 -o last.png                          the last frame, grains by species\n"
    "  grseg-render run.h5 --at start,end -o figure-1.pdf       as figure 1 of Staron & Phillips\n"
    "  grseg-render run.h5 --color speed --at 10 -o speed.png   a field, with its colour bar\n"
    "  grseg-render run.h5 --forces --partition size -o f.svg   force chains, mixed contacts split\n"
    "  grseg-render run.h5 --width 86mm -o column.pdf           as wide as a journal column\n"
    "  grseg-render run.h5 --every 0.1 --fps 25 -o film.mp4     a film, by ffmpeg\n"};

struct Settings : RenderSettings {
  TrustOption trust;
  GroupingOptions grouping;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  s.picture.add_to(options);
  s.range.add_to(options);
  auto add = options.add_options();
  add("every", po::value(&s.every)->value_name("s"),
      "films: simulated time between two pictures (default: all frames)");
  add("fps", po::value(&s.fps)->default_value(s.fps, "25")->value_name("N"),
      "films: pictures per second");
  add("threads", po::value(&s.threads)->default_value(s.threads)->value_name("N"),
      "films: number of threads (0: one per processor), which does not change the film");
  s.grouping.add_to(options);
  s.trust.add_to(options);
  add("quiet", po::bool_switch(&s.quiet), "print no progress on standard error");
  s.output.add_to(options, "file to write: a picture (.png, .svg, .pdf) or a film (.mp4, .webm)");
  return options;
}

/// Text of the header lines that a table about this run would have.
std::string history_of(const TrajectoryReader& run, const std::string& command)
{
  auto lines = provenance(info, "none", run, command);
  std::string text;
  for (const auto& [key, value] : add_all(lines, verification_lines(run)))
    text += fmt::format("{}: {}\n", key, value);
  return text;
}

void check_film(const Settings& s)
{
  if (!(s.fps > 0 && s.fps <= 240)) throw UsageError("--fps must be positive, and at most 240");
  if (s.threads < 0 || s.threads > 1024)
    throw UsageError(fmt::format("--threads {}: it must be 0 to 1024", s.threads));
}

void render(Settings& s, const po::variables_map& values, const std::string& command)
{
  if (s.output.path.empty()) throw UsageError("name what to write: -o NAME.png");
  const auto kind = picture_kind(s.output.path);
  const TrajectoryReader run(single_input(values, "render one at a time"), s.trust.verify());
  s.output.check(values);
  if (is_film(kind))
    refuse_options(values, {"at"}, "is for pictures; for a film use --begin and --end");
  else
    refuse_options(values, {"begin", "end", "stride", "every", "fps", "threads"},
                   "is for films; name a film, as in -o film.mp4, or use --at for a picture");
  check_film(s);
  s.program = info.name;
  if (s.threads == 0)
    s.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto grains = group_grains(run, s.grouping);
  const RenderSource source{run, grains, s, kind, history_of(run, command)};
  with_dimension(run.dimension(),
                 [&](auto d) { is_film(kind) ? make_film<d>(source) : make_picture<d>(source); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main(argc, argv, info, options_into, render);
}
