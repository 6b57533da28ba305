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
#include "formats/core/species.hpp"
#include "formats/core/text.hpp"
#include "formats/export/map_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>
#include <utility>

namespace grseg {
namespace {

const std::vector<std::string> all_bins{"layers", "radius", "radius:X,Y", "xy",
                                        "xz",     "rz",     "rz:X,Y"};

/// The axis that --bins names, where it names one.
std::optional<Vec2> axis_of(const TrajectoryReader& run, const std::string& bins, LengthUnits units)
{
  if (bins == "layers" || bins == "xy" || bins == "xz") return {};
  const std::string word = bins.substr(0, bins.find(':'));
  if (word != "radius" && word != "rz") throw UsageError(unknown_word("--bins", bins, all_bins));
  if (bins == word) {
    const auto& numbers = run.parameters().numbers;
    const auto centre = numbers.find("drum_centre");
    if (centre == numbers.end() || centre->second.size() != 2)
      throw UsageError(fmt::format(
          "--bins {0}: the run has no drum; give the axis, as in --bins {0}:0.1m,0.2m", word));
    return Vec2(centre->second[0], centre->second[1]);
  }
  const std::string place = bins.substr(word.size() + 1);
  const auto comma = place.find(',');
  if (comma == std::string::npos)
    throw UsageError(
        fmt::format("--bins {}: an axis has two coordinates, as in {}:0.1m,0.2m", bins, word));
  const auto option = "--bins " + word + ":";
  return Vec2(parse_length(place.substr(0, comma), option, units),
              parse_length(place.substr(comma + 1), option, units));
}

Layers layers_of(const TrajectoryReader& run, const FrameOptions& options)
{
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  const double thickness = parse_length(options.layer, "--layer", units);
  const auto& box = run.box();
  std::optional<double> width;
  if (box.dimension == 3) width = box.length_z;
  const auto axis = axis_of(run, options.bins, units);
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

void FrameOptions::add_to(po::options_description& options, Makes makes)
{
  options.add_options()("layer", po::value(&layer)->default_value(layer)->value_name("LENGTH"),
                        "thickness of the layers: 4dS, 2dL, 20mm, or metres");
  options.add_options()("window", window_option(windows),
                        "time to average over; windows that the run does not fill are left out. "
                        "all: one window over all frames used");
  options.add_options()("begin", time_option(windows.begin),
                        "first window begins here (default: t = 0)");
  options.add_options()("end", time_option(windows.end),
                        "no window ends after this (default: the run)");
  options.add_options()("stride", po::value(&windows.stride)->default_value(1)->value_name("N"),
                        "use one frame in N");
  options.add_options()("threads", po::value(&threads)->default_value(1)->value_name("N"),
                        "number of threads, 0: one per processor; results are bitwise identical");
  trust.add_to(options);
  options.add_options()("json", po::bool_switch(&json), "print JSON instead of a table");
  options.add_options()("quiet", po::bool_switch(&quiet), "no progress and no remarks");
  grouping.add_to(options);
  if (makes == Makes::table)
    output.add_to(options);
  else
    output.OutputOptions::add_to(options);
}

void FrameOptions::add_bins_to(po::options_description& options)
{
  options.add_options()(
      "bins", word_option(&bins, all_bins),
      "layers (parallel to the base), radius (annuli about a drum's axis) or radius:X,Y (about "
      "this axis), of thickness --layer; in annuli y is the distance from the axis, and x runs "
      "round it clockwise. Or a map of cells of side --layer: xy, in three dimensions also xz and "
      "rz or rz:X,Y (distance from an axis along z); maps may go to .h5, .vti and .pvd files");
}

std::optional<MapPlane> FrameOptions::map() const
{
  return find_choice(bins.substr(0, bins.find(':')), map_planes);
}

FrameLoop::FrameLoop(const ToolInfo& info, const po::variables_map& values,
                     const FrameOptions& options)
    : info_(info),
      options_(options),
      preset_(preset_of(values)),
      run_(single_input(values, "a table is made of one run"), options.trust.verify()),
      grouped_(group_grains(run_, options.grouping)),
      layers_(layers_of(run_, options)),
      windows_(cut_into_windows(times_of(run_), options.windows)),
      progress_(info.name, {.things = "frames"}, options.quiet)
{
  options.parts.check(options.output.path);
  if (const auto& part = options.parts.part) {
    if (options.json)
      throw UsageError(fmt::format("--part {} makes a table; give --json to --join", part->text()));
    options_.output.path = part->path(options.output.path, ".tsv");
  }
  options_.output.check(values);
  if (options.threads < 0 || options.threads > 1024)
    throw UsageError(fmt::format("--threads {}: it must be 0 to 1024", options.threads));
  if (options.threads == 0)
    options_.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto plane = options.map();
  if (is_map_file(options.output.path)) {
    if (!plane)
      throw UsageError(
          fmt::format("-o {}: only maps become such files; take --bins xy, or a name "
                      "that ends in .tsv",
                      options.output.path));
    if (options.json)
      throw UsageError("--json prints text; give it without -o, or a name in .json");
    if (options.output.short_form || options.output.digits > 0)
      throw UsageError(fmt::format(
          "-o {}: --short and --digits are for text; leave them out, or take a name in .tsv",
          options.output.path));
    check_map_file(options.output, {run_.path()});
  }
  expect_passes(1);
  if (plane) with_dimension(dimension(), [&](auto d) { layers_ = map_of<d>(*plane); });
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
Layers FrameLoop::map_of(MapPlane plane)
{
  const GrainExtent<D> none(layers_.axis());
  auto extent = none;
  for (const auto& window : windows_.list)
    extent.merge(std::get<0>(sum<D>(window, {.velocity = false, .contacts = false}, none)));
  return Layers::map(map_grid<D>(plane, layers_.thickness(), run_.box(), extent, layers_.axis()),
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

namespace {

std::string number_or_unknown(const Parameters& parameters, const char* key)
{
  const auto number = parameters.find_number(key);
  return number && !std::isnan(*number) ? format_number(*number) : "unknown";
}

/// What the header says of annuli and maps.
Header bins_lines(const Layers& layers)
{
  const auto& axis = layers.axis();
  const auto& map = layers.map();
  std::string bins = map ? word_of(map->plane(), map_planes) : axis ? "radius" : "";
  if (axis) bins += fmt::format(" {} {}", format_number(axis->x()), format_number(axis->y()));
  Header lines;
  if (!bins.empty()) lines.emplace_back("bins", bins);
  if (!map) return lines;
  const auto& [first, second] = map->axes();
  lines.emplace_back("cells", fmt::format("{} {}", first.cells, second.cells));
  lines.emplace_back("cell",
                     fmt::format("{} {}", format_number(first.side), format_number(second.side)));
  if (map->plane() == MapPlane::xz) lines.emplace_back("height", format_number(map->depth()));
  return lines;
}

/// "initial = mixed; base = grains": the scene of a run of grseg-sim, in SI; "" of other runs.
std::string scene_in_one_line(const TrajectoryReader& run)
{
  auto text = run.parameters().text("scene");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
    text.replace(at, 1, "; ");
  return printable(text);
}

}  // namespace

Table FrameLoop::make_table(const std::string& command,
                            const std::vector<std::pair<std::string, std::string>>& settings,
                            const std::vector<std::string>& columns) const
{
  require_memory(columns.size());
  Table table;
  auto& header = table.header;
  header = provenance(info_, preset_, run_, command);
  for (auto& line : verification_lines(run_)) header.push_back(std::move(line));

  constexpr double no_one = std::numeric_limits<double>::quiet_NaN();
  const auto add = [&](const char* key, double value) {
    header.emplace_back(key, format_number(value));
  };
  if (dimension() == 3) add("dimension", 3);
  add("small_diameter", run_.small_diameter());
  add("large_diameter", run_.large_diameter());
  if (names_species(species())) header.emplace_back("species", species_text(species()));
  for (const char* key : {"density", "friction", "restitution"}) {
    const bool set_by_tool = std::any_of(settings.begin(), settings.end(),
                                         [&](const HeaderLine& line) { return line.first == key; });
    if (!set_by_tool) header.emplace_back(key, number_or_unknown(run_.parameters(), key));
  }
  with_dimension(dimension(), [&](auto d) {
    if (!have_one_density<d>(grains())) {
      add("mean_density", mean_density<d>(grains()));
      for (std::size_t k = 0; k < species().size(); ++k)
        add(fmt::format("density_{}", column_words(species())[k]).c_str(),
            mean_density<d>(grains(), static_cast<Species>(k)));
    }
    const auto gravity = run_.gravity<d>();
    constexpr std::array keys{"gravity_x", "gravity_y", "gravity_z"};
    for (int axis = 0; axis < d; ++axis)
      add(keys[static_cast<std::size_t>(axis)], gravity.turns() ? no_one : gravity.start[axis]);
  });
  add("step", run_.step());
  add("length", layers_.length());
  if (layers_.width()) add("length_z", *layers_.width());
  if (!layers_.map()) add("layer", layers_.thickness());
  add("window", windows_.length);
  add("stride", static_cast<double>(options_.windows.stride));
  for (auto& line : bins_lines(layers_)) header.push_back(std::move(line));
  const auto origin = run_.parameters().text("origin");
  if (const auto scene = scene_in_one_line(run_); !scene.empty())
    header.emplace_back("scene", scene);
  header.emplace_back("origin", origin.empty() ? "unknown" : printable(origin));
  header.insert(header.end(), settings.begin(), settings.end());

  if (const auto& map = layers_.map()) {
    const auto& axes = map->axes();
    table.columns =
        map_key_columns({std::string(1, axes[0].name), std::string(1, axes[1].name)}, dimension());
    table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  } else {
    table.columns = with_key_columns(dimension(), columns);
  }
  return table;
}

std::vector<double> FrameLoop::row(const Window& window, std::size_t layer,
                                   const std::vector<double>& values) const
{
  if (const auto& map = layers_.map()) {
    const auto& [first, second] = map->axes();
    const std::size_t i = map->column(layer), j = map->row(layer);
    std::vector<double> row{window.begin,
                            window.end,
                            first.edge(i),
                            first.edge(i + 1),
                            second.edge(j),
                            second.edge(j + 1),
                            static_cast<double>(window.frames.size()),
                            map->volume(layer)};
    row.insert(row.end(), values.begin(), values.end());
    return row;
  }
  return with_key({window.begin, window.end, layers_.bottom(layer), layers_.top(layer),
                   static_cast<double>(window.frames.size()), layers_.volume(layer)},
                  values);
}

std::vector<double> FrameLoop::bed_row(const Window& window, double height,
                                       const std::vector<double>& values) const
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const double volume = height < 0 ? nan : layers_.volume_of_bed(height);
  return with_key(
      {window.begin, window.end, nan, nan, static_cast<double>(window.frames.size()), volume},
      values);
}

namespace {

/// What the header of a part of a table has more than that of the whole.
HeaderLine part_line(const OutputPart& part)
{
  return {"part", part.text()};
}

/// The part of `table`, which has no rows, in the file `path`.
Table read_part(const Table& table, const OutputPart& part, const std::string& path)
{
  const auto remedy =
      fmt::format("make it with this command and --part {} in place of --join", part.text());
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UsageError(fmt::format("{} is missing; {}", path, remedy));
  auto expected = table;
  expected.header.push_back(part_line(part));
  expected = Table::parse(expected.to_text(), path);
  auto found = Table::read(path);
  const auto [ours, theirs] = std::mismatch(expected.header.begin(), expected.header.end(),
                                            found.header.begin(), found.header.end());
  const auto line = [](auto at, auto end) {
    return at == end ? "no line there" : fmt::format("'# {}: {}'", at->first, at->second);
  };
  if (ours != expected.header.end() || theirs != found.header.end())
    throw FormatError(fmt::format("{}: is a part of another table, with {} where this has {}; {}",
                                  path, line(theirs, found.header.end()),
                                  line(ours, expected.header.end()), remedy));
  if (expected.columns != found.columns)
    throw FormatError(fmt::format("{}: has other columns than this table; {}", path, remedy));
  return found;
}

}  // namespace

void FrameLoop::require_memory(std::size_t columns) const
{
  const auto& map = layers_.map();
  const auto cells = map ? static_cast<double>(map->cells())
                         : std::ceil(run_.box().length_y / layers_.thickness());
  // The window has sums of its own, and every thread adds its sums to them.
  const double need =
      cells * static_cast<double>(columns) * sizeof(double) * (1 + options_.threads);
  const double free = free_memory();
  if (need < free) return;
  throw UsageError(fmt::format(
      "{:.3g} {} with {} numbers each need about {:.1f} GB, and {:.1f} GB are free; choose thicker "
      "--layer{}",
      cells, map ? "cells" : "layers", columns, need / 1e9, free / 1e9,
      options_.threads > 1 ? " or fewer --threads" : ""));
}

Table FrameLoop::joined(const Table& table) const
{
  auto all = table;
  for (std::size_t k = 1; k <= options_.parts.join; ++k) {
    const OutputPart part{k, options_.parts.join};
    auto rows = read_part(table, part, part.path(options_.output.path, ".tsv")).rows;
    std::move(rows.begin(), rows.end(), std::back_inserter(all.rows));
  }
  return all;
}

void FrameLoop::add(Table& table, std::vector<double> row)
{
  table.rows.push_back(std::move(row));
  const auto& path = options_.output.path;
  const auto& output = options_.output;
  const bool as_it_is = !options_.json && !output.prints_short() && output.digits == 0;
  const bool in_pieces = as_it_is && !is_map_file(path) && !is_device(path) &&
                         options_.parts.join == 0 && !options_.parts.part;
  if (!in_pieces || !GrowingTable::is_large(table)) return;
  if (!growing_) growing_.emplace(options_.output);
  growing_->add(table);
}

void FrameLoop::write(Table table, const std::string& next)
{
  progress_.clear();
  if (options_.parts.join > 0) table = joined(table);
  if (options_.parts.part) table.header.push_back(part_line(*options_.parts.part));
  if (is_map_file(options_.output.path))
    return write_map_file(table, options_.output, {run_.path()});
  if (growing_)
    growing_->finish(std::move(table));
  else
    write_table(options_.output, options_.json ? table.to_json() : table.to_text());
  if (next.empty() || options_.output.path.empty() || options_.json || options_.parts.part) return;
  say_next(fmt::format("{} {}", next, shell_word(options_.output.path)), options_.quiet);
}

}  // namespace grseg
