// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"

#include "analysis/frames/grains_below.hpp"
#include "analysis/frames/ring.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"
#include "formats/export/map_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <thread>

namespace grseg {
namespace {

/// Throws UsageError if the run has a ring about another axis.
void require_axis_of_ring(const TrajectoryReader& run, const std::string& bins, const Vec2& axis)
{
  const auto ring = find_ring(run);
  if (!ring || (ring->centre - axis).norm() < run.small_diameter() / 4) return;
  throw UsageError(fmt::format(
      "--bins {}: base and walls lie on a ring of radius {:.4g} m about another axis; use {}:"
      "{:.6g}m,{:.6g}m",
      bins, ring->radius, bins.substr(0, bins.find(':')), ring->centre.x(), ring->centre.y()));
}

/// Layers or annuli as --layer and --bins say. The cells of a map follow later, from the grains.
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
        fmt::format("--bins {}: the run has two dimensions; use --bins xy", options.bins));
  if (!axis) return {thickness, box.length_x, width};
  if (box.periodic_x)
    throw UsageError(fmt::format(
        "--bins {}: the cell is periodic along x, so the distance from an axis is not defined; "
        "use {}",
        options.bins, plane ? "xy" : "layers"));
  require_axis_of_ring(run, options.bins, *axis);
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
  throw UsageError(fmt::format(
      "{}: {} compares two species, but the run has {} ({}); combine them into two with --group, "
      "e.g. --group S=1 --group L=2,3, with --classes 2, or with --edges and one diameter",
      run_.path(), info_.name, all.size(), fmt::join(names_of(all), ", ")));
}

void FrameLoop::require_forces(const char* what, const char* remedy) const
{
  if (!run_.has_force())
    throw FormatError(
        fmt::format("{}: /particles/grains/force, {}, is missing; {}", run_.path(), what, remedy));
}

std::string FrameLoop::about_grains_below() const
{
  if (most_below_ == 0) return "";
  return fmt::format(
      "{}: grains below the base, up to {} in a frame, belong to no layer and are not counted; maps "
      "(--bins xy) contain them",
      run_.path(), most_below_);
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
  if (!options_.of_bed()) return;
  const auto below = remove_grains_below(
      grouped_.grains, frame, fields.force ? ContactsAcross::kept : ContactsAcross::removed);
  if (below == 0) return;
  const std::lock_guard lock(reading_);
  most_below_ = std::max(most_below_, below);
}
template void FrameLoop::read(std::size_t, Frame<2>&, TrajectoryReader::Fields);
template void FrameLoop::read(std::size_t, Frame<3>&, TrajectoryReader::Fields);

namespace {

const std::vector<std::string> all_bins{"layers", "radius", "radius:X,Y", "xy",
                                        "xz",     "rz",     "rz:X,Y"};
const std::vector<std::string> bins_without_axis{"layers", "xy", "xz"};

/// Throws UsageError if the options do not fit a map in HDF5.
void check_map_output(const FrameOptions& options)
{
  const auto& output = options.output;
  if (!options.map())
    throw UsageError(
        fmt::format("-o {}: only a map can be written as such a file; use --bins xy, or a name "
                    "that ends in .tsv",
                    output.path));
  if (options.json) throw UsageError("--json writes text; leave out -o, or name a .json file");
  if (output.short_form || output.digits > 0)
    throw UsageError(fmt::format(
        "-o {}: --short and --digits are for text; leave them out, or use a name that ends in .tsv",
        output.path));
}

}  // namespace

void FrameOptions::add_to(po::options_description& options, Makes makes)
{
  auto add = options.add_options();
  add("layer", po::value(&layer)->default_value(layer)->value_name("LENGTH"),
      "thickness of layers, in diameters (4dS: of small, 2dL: of large grains), or 20mm, 0.02m");
  add("window", window_option(windows),
      "length of windows that results are averaged over; windows that the run does not fill are "
      "left out. all: one window over all frames used");
  add("begin", time_option(windows.begin), "begin of the first window (default: t = 0)");
  add("end", time_option(windows.end), "latest end of a window (default: end of the run)");
  add("stride", po::value(&windows.stride)->default_value(1)->value_name("N"),
      "use every N-th frame");
  add("threads", po::value(&threads)->default_value(1)->value_name("N"),
      "number of threads; 0: one per processor. Results do not depend on it, to the last bit");
  trust.add_to(options);
  add("json", po::bool_switch(&json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&quiet), "print no progress and no remarks");
  grouping.add_to(options);
  if (makes == Makes::table)
    output.add_to(options);
  else
    output.OutputOptions::add_to(options);
}

void FrameOptions::add_bins_to(po::options_description& options, bool about_axis)
{
  const std::string text =
      about_axis
          ? "layers: parallel to the base. radius: annuli about a drum's axis; radius:X,Y: about "
            "the axis at X,Y; y is then the distance from the axis, and x runs clockwise round it. "
            "xy, in 3D also xz, rz and rz:X,Y: a map of square cells (r: distance from an axis "
            "along z)"
          : "layers: parallel to the base. xy, in 3D also xz: a map of square cells";
  options.add_options()(
      "bins", word_option(&bins, about_axis ? all_bins : bins_without_axis),
      (text + ", also for .h5 files. --layer sets the thickness, or the side of a cell").c_str());
}

std::optional<MapPlane> FrameOptions::map() const
{
  return find_choice(bins.substr(0, bins.find(':')), map_planes);
}

std::optional<Vec2> FrameOptions::axis(const TrajectoryReader& run) const
{
  if (bins == "layers" || bins == "xy" || bins == "xz") return {};
  const std::string word = bins.substr(0, bins.find(':'));
  if (word != "radius" && word != "rz") throw UsageError(unknown_word("--bins", bins, all_bins));
  if (bins == word) {
    const auto& numbers = run.parameters().numbers;
    const auto centre = numbers.find("drum_centre");
    if (centre == numbers.end() || centre->second.size() != 2)
      throw UsageError(fmt::format(
          "--bins {0}: the run has no drum; give the axis, e.g. --bins {0}:0.1m,0.2m", word));
    return Vec2(centre->second[0], centre->second[1]);
  }
  const std::string place = bins.substr(word.size() + 1);
  const auto comma = place.find(',');
  if (comma == std::string::npos)
    throw UsageError(
        fmt::format("--bins {}: an axis needs two coordinates, e.g. {}:0.1m,0.2m", bins, word));
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  const auto option = "--bins " + word + ":";
  return Vec2(parse_length(place.substr(0, comma), option, units),
              parse_length(place.substr(comma + 1), option, units));
}

FrameOptions FrameOptions::checked(const po::variables_map& values) const
{
  auto own = *this;
  own.output.check(values);
  if (threads < 0 || threads > 1024)
    throw UsageError(fmt::format("--threads {}: it must be 0 to 1024", threads));
  if (threads == 0)
    own.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (is_map_file(output.path)) check_map_output(*this);
  if (output.path.ends_with(".pvd") || output.path.ends_with(".vti"))
    throw UsageError(fmt::format(
        "-o {}: maps are written as .h5, which xarray and h5py read, or as .tsv", output.path));
  return own;
}

void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why)
{
  for (const char* option : options)
    if (values.contains(option) && !values[option].defaulted())
      throw UsageError(fmt::format("--{} {}", option, why));
}

}  // namespace grseg
