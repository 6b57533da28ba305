// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/table_writer.hpp"

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/memory.hpp"
#include "formats/core/species.hpp"
#include "formats/core/text.hpp"
#include "formats/export/map_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

namespace grseg {
namespace {

std::string number_or_unknown(const Parameters& parameters, const char* key)
{
  const auto number = parameters.find_number(key);
  return number && !std::isnan(*number) ? format_number(*number) : "unknown";
}

/// Header lines that describe annuli or a map; none for layers.
Header bins_lines(const Layers& layers)
{
  const auto* axis = layers.axis();
  const auto* map = layers.map();
  std::string bins = map ? word_of(map->plane, map_planes) : axis ? "radius" : "";
  if (axis) bins += fmt::format(" {} {}", format_number(axis->x()), format_number(axis->y()));
  Header lines;
  if (!bins.empty()) lines.emplace_back("bins", bins);
  if (!map) return lines;
  const auto& [first, second] = map->axes;
  lines.emplace_back("cells", fmt::format("{} {}", first.cells, second.cells));
  lines.emplace_back("cell",
                     fmt::format("{} {}", format_number(first.side), format_number(second.side)));
  std::vector<std::string> periodic;
  for (const auto& each : map->axes)
    if (each.periodic) periodic.emplace_back(1, each.name);
  lines.emplace_back("periodic",
                     periodic.empty() ? "none" : fmt::format("{}", fmt::join(periodic, " ")));
  if (map->plane == MapPlane::xz) lines.emplace_back("height", format_number(map->depth));
  return lines;
}

/// Scene of a run of grseg-sim, in SI units: "initial = mixed; base = grains"; otherwise "".
std::string scene_in_one_line(const TrajectoryReader& run)
{
  auto text = run.parameters().text("scene");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
    text.replace(at, 1, "; ");
  return printable(text);
}

/// Adds header lines that describe the run: dimension, grains, gravity and step.
void add_lines_of_run(Header& header, const FrameLoop& loop, const Header& settings)
{
  const auto& run = loop.run();
  const auto& species = loop.species();
  const auto add = [&](const std::string& key, double value) {
    header.emplace_back(key, format_number(value));
  };
  if (loop.dimension() == 3) add("dimension", 3);
  add("small_diameter", run.small_diameter());
  add("large_diameter", run.large_diameter());
  if (names_species(species)) header.emplace_back("species", species_text(species));
  for (const char* key : {"density", "friction", "restitution"}) {
    const bool set_by_tool =
        std::ranges::any_of(settings, [&](const HeaderLine& line) { return line.first == key; });
    if (!set_by_tool) header.emplace_back(key, number_or_unknown(run.parameters(), key));
  }
  with_dimension(loop.dimension(), [&](auto d) {
    if (!have_one_density<d>(loop.grains())) {
      add("mean_density", mean_density<d>(loop.grains()));
      for (std::size_t k = 0; k < species.size(); ++k)
        add("density_" + column_words(species)[k],
            mean_density<d>(loop.grains(), static_cast<Species>(k)));
    }
    const auto gravity = run.gravity<d>();
    constexpr std::array keys{"gravity_x", "gravity_y", "gravity_z"};
    for (int axis = 0; axis < d; ++axis)
      add(keys[static_cast<std::size_t>(axis)], gravity.turns() ? no_number : gravity.start[axis]);
  });
  add("step", run.step());
}

/// Throws UsageError if the sums of one window need more memory than is free.
void require_memory(const FrameLoop& loop, std::size_t columns)
{
  const auto* map = loop.layers().map();
  const auto cells = map ? static_cast<double>(map->cells())
                         : std::ceil(loop.run().box().length_y / loop.layers().thickness());
  const int threads = loop.options().threads;
  // The window and every thread have sums of their own.
  const double need = cells * static_cast<double>(columns) * sizeof(double) * (1 + threads);
  const double free = free_memory();
  if (need < free) return;
  throw UsageError(fmt::format(
      "{:.3g} {} with {} numbers each need about {:.1f} GB, but {:.1f} GB are free; choose a "
      "larger --layer{}",
      cells, map ? "cells" : "layers", columns, need / 1e9, free / 1e9,
      threads > 1 ? " or fewer --threads" : ""));
}

}  // namespace

Table empty_table(const FrameLoop& loop, const std::string& command, const Header& settings,
                  const std::vector<std::string>& columns)
{
  require_memory(loop, columns.size());
  const auto& run = loop.run();
  const auto& layers = loop.layers();
  Table table;
  auto& header = table.header;
  header = provenance(loop.info(), loop.preset(), run, command);
  add_all(header, verification_lines(run));
  add_lines_of_run(header, loop, settings);
  const auto add = [&](const char* key, double value) {
    header.emplace_back(key, format_number(value));
  };
  add("length", layers.length());
  if (layers.width()) add("length_z", *layers.width());
  if (!layers.map()) add("layer", layers.thickness());
  add("window", loop.window_length());
  add("stride", static_cast<double>(loop.options().windows.stride));
  add_all(header, bins_lines(layers));
  const auto origin = run.parameters().text("origin");
  if (const auto scene = scene_in_one_line(run); !scene.empty())
    header.emplace_back("scene", scene);
  header.emplace_back("origin", origin.empty() ? "unknown" : printable(origin));
  add_all(header, settings);
  if (const auto* map = layers.map()) {
    const auto& axes = map->axes;
    table.columns = map_key_columns({std::string(1, axes[0].name), std::string(1, axes[1].name)},
                                    loop.dimension());
    add_all(table.columns, columns);
  } else {
    table.columns = with_key_columns(loop.dimension(), columns);
  }
  return table;
}

std::vector<double> table_row(const FrameLoop& loop, const Window& window, std::size_t layer,
                              const std::vector<double>& values)
{
  const auto& layers = loop.layers();
  const auto frames = static_cast<double>(window.frames.size());
  const auto* map = layers.map();
  if (!map)
    return with_key({window.begin, window.end, layers.bottom(layer), layers.top(layer), frames,
                     layers.volume(layer)},
                    values);
  const auto& [first, second] = map->axes;
  const std::size_t i = map->column(layer), j = map->row(layer);
  std::vector<double> row{window.begin,   window.end,         first.edge(i), first.edge(i + 1),
                          second.edge(j), second.edge(j + 1), frames,        map->volume(layer)};
  return add_all(row, values);
}

TableWriter::TableWriter(FrameLoop& loop, const std::string& command, const Header& settings,
                         const std::vector<std::string>& columns)
    : loop_(loop), table_(empty_table(loop, command, settings, columns))
{
}

void TableWriter::add_bed(const Window& window, double height, const std::vector<double>& values)
{
  const double volume = height < 0 ? no_number : loop_.layers().volume_of_bed(height);
  add(with_key({window.begin, window.end, no_number, no_number,
                static_cast<double>(window.frames.size()), volume},
               values));
}

void TableWriter::add(std::vector<double> row)
{
  table_.rows.push_back(std::move(row));
  const auto& options = loop_.options();
  const auto& output = options.output;
  const bool as_it_is = !options.json && !output.prints_short() && output.digits == 0;
  const bool in_pieces = as_it_is && !is_map_file(output.path) && !is_device(output.path);
  if (!in_pieces || !GrowingTable::is_large(table_)) return;
  if (!growing_) growing_.emplace(output);
  growing_->add(table_);
}

void TableWriter::write(const std::string& next)
{
  loop_.clear_progress();
  const auto& options = loop_.options();
  if (const auto remark = loop_.about_grains_below(); !remark.empty() && !options.quiet)
    fmt::print(stderr, "{}: {}\n", loop_.info().name, remark);
  const auto& output = options.output;
  if (is_map_file(output.path)) return write_map_file(table_, output, {loop_.run().path()});
  if (growing_)
    growing_->finish(std::move(table_));
  else
    write_table(output, options.json ? table_.to_json() : table_.to_text());
  if (next.empty() || output.path.empty() || options.json) return;
  say_next(fmt::format("{} {}", next, shell_word(output.path)), options.quiet);
}

}  // namespace grseg
