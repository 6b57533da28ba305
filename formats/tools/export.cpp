// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/frame_range.hpp"
#include "formats/cli/interruption.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/export/run_writers.hpp"

#include <fmt/format.h>

#include <cstdio>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-export", "writes a run for ParaView, OVITO, readers of LAMMPS dumps, or MDAnalysis.",
    "grseg-export run.h5 --to vtp|extxyz|lammps|h5md3d -o NAME [options]",
    "  grseg-export run.h5 --to vtp -o view               ParaView: view/grains.pvd, contacts.pvd\n"
    "  grseg-export run.h5 --to extxyz --stride 10 -o run.xyz.gz              OVITO, ASE\n"
    "  grseg-export run.h5 --to lammps -o run.dump.gz     OVITO; run.contacts.dump.gz beside it\n"
    "  grseg-export run.h5 --to h5md3d --begin 20 --end 40 -o view.h5md       MDAnalysis\n"};

constexpr Choice<decltype(&vtp_writer)> formats[] = {{"vtp", vtp_writer},
                                                     {"extxyz", extxyz_writer},
                                                     {"lammps", lammps_writer},
                                                     {"h5md3d", h5md3d_writer}};

struct Settings {
  FrameRange range;
  std::string format, output;
  bool overwrite = false, quiet = false;
  TrustOption trust;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("to", word_option(&s.format, words_of(formats)),
      "format: vtp (VTK PolyData with times, grains as points, contacts as lines), extxyz "
      "(extended XYZ), lammps (dump custom and dump local) or h5md3d (H5MD in three dimensions)");
  s.range.add_to(options);
  s.trust.add_to(options);
  add("output,o", po::value(&s.output)->value_name("NAME"),
      "file to write (extxyz and lammps: compressed if it ends in .gz), or with --to vtp a folder");
  add_overwrite_to(options, s.overwrite);
  add("quiet", po::bool_switch(&s.quiet), "print no progress and no remarks on standard error");
  return options;
}

/// Writes all frames or nothing: if a frame cannot be read, `writer` removes its unfinished output.
template <int D>
void write_frames(const TrajectoryReader& run, const std::vector<std::size_t>& frames,
                  const Settings& s, RunWriter& writer)
{
  ProgressBar progress(info.name, {.things = "frames", .total = static_cast<double>(frames.size())},
                       s.quiet);
  Frame<D> frame;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    stop_if_interrupted();
    run.read(frames[k], frame, {.velocity = true, .contacts = true, .force = true});
    writer.add(frame);
    progress.show(static_cast<double>(k + 1));
  }
  progress.clear();
  writer.publish();
}

void export_run(const Settings& s, const po::variables_map& values)
{
  const TrajectoryReader run(single_input(values, "export one at a time"), s.trust.verify());
  if (s.output.empty()) throw UsageError("name what to write: -o NAME");
  const auto frames = s.range.frames_of(run);
  const auto make = choose(s.format, "--to", formats);
  listen_to_signals();
  const auto writer = make(run, view_cell(run, frames.front()), s.output, s.overwrite);
  with_dimension(run.dimension(), [&](auto d) { write_frames<d>(run, frames, s, *writer); });
  const auto again = writer->import_command();
  if (s.quiet || again.empty()) return;
  if (with_dimension(run.dimension(), [&](auto d) { return run.gravity<d>().turns(); }))
    fmt::print(stderr,
               "{}: grseg-import cannot read this back: an archive cannot store a changing slope\n",
               info.name);
  else
    fmt::print(stderr, "{}: to turn this archive back into a run: {}\n", info.name, again);
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options,
                  [&](const po::variables_map& values) { export_run(settings, values); });
}
