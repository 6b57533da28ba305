// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"

#include "analysis/frames/layer_key.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// What --layer and --bins ask for, but for the cells of a map: these follow from the grains.
Layers layers_of(const TrajectoryReader& run, const FrameOptions& options)
{
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  const double thickness = parse_length(options.layer, "--layer", units);
  const auto& box = run.box();
  std::optional<double> width;
  if (box.dimension == 3) width = box.length_z;
  const auto axis = options.axis(run);
  const auto plane = options.map();
  if (plane && plane != MapPlane::xy && box.dimension == 2)
    throw UsageError(
        fmt::format("--bins {}: the run has two dimensions; take --bins xy", options.bins));
  if (!axis) return {thickness, box.length_x, width};
  if (box.periodic_x)
    throw UsageError(fmt::format(
        "--bins {}: the cell is periodic along x, so that nothing lies at one distance from an "
        "axis; take {}",
        options.bins, plane ? "xy" : "layers"));
  return Layers::annuli(thickness, box.length_x, *axis, width);
}

}  // namespace

FrameLoop::FrameLoop(const ToolInfo& info, const po::variables_map& values,
                     const FrameOptions& options)
    : info_(info),
      preset_(preset_of(values)),
      run_(single_input(values, "a table is made of one run"), options.trust.verify()),
      grouped_(group_grains(run_, options.grouping)),
      layers_(layers_of(run_, options)),
      windows_(cut_into_windows(times_of(run_), options.windows)),
      progress_(info.name, {.things = "frames"}, options.quiet)
{
  options_ = options.checked(values);
  expect_passes(1);
  if (const auto plane = options.map())
    with_dimension(dimension(), [&](auto d) { layers_ = map_of<d>(*plane, options.axis(run_)); });
  expect_passes(1);
}

std::span<const Window> FrameLoop::windows() const
{
  const std::span all(windows_.list);
  if (options_.parts.join > 0) return {};
  if (!options_.parts.part) return all;
  const auto [begin, end] = options_.parts.part->range(all.size());
  return all.subspan(begin, end - begin);
}

template <int D>
Layers FrameLoop::map_of(MapPlane plane, const std::optional<Vec2>& axis)
{
  const GrainExtent<D> none(axis);
  auto extent = none;
  for (const auto& window : windows_.list)
    extent.merge(std::get<0>(sum<D>(window, {.velocity = false, .contacts = false}, none)));
  return Layers::map(map_grid<D>(plane, layers_.thickness(), run_.box(), extent, axis),
                     layers_.length(), layers_.width());
}

void FrameLoop::expect_passes(int passes)
{
  std::size_t frames = 0;
  for (const auto& window : windows()) frames += window.frames.size();
  frames_done_ = 0;
  progress_.begin({.things = passes == 1 ? "frames" : fmt::format("frames in {} passes", passes),
                   .total = static_cast<double>(frames) * passes});
}

void FrameLoop::require_two_species() const
{
  const auto& all = species();
  if (all.size() == 2) return;
  std::string names;
  for (const auto& one : all) names += (names.empty() ? "" : ", ") + one.name;
  throw UsageError(fmt::format(
      "{}: {} compares two species, and the run has {} ({}): make them two with --group, as in "
      "--group S=1 --group L=2,3, with --classes 2, or with one --edges",
      run_.path(), info_.name, all.size(), names));
}

void FrameLoop::require_forces(const char* what, const char* remedy) const
{
  if (!run_.has_force())
    throw FormatError(
        fmt::format("{}: /particles/grains/force, {}, is missing; {}", run_.path(), what, remedy));
}

template <int D>
void FrameLoop::read(std::size_t index, Frame<D>& frame, TrajectoryReader::Fields fields)
{
  TrajectoryReader::Packed packed;
  {
    const std::lock_guard lock(reading_);
    packed = run_.load(index, frame, fields);
  }
  run_.unpack(packed, frame);
}
template void FrameLoop::read(std::size_t, Frame<2>&, TrajectoryReader::Fields);
template void FrameLoop::read(std::size_t, Frame<3>&, TrajectoryReader::Fields);

}  // namespace grseg
