// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/presets.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-micro", "sums of contacts, their forces and directions, by layer and for the bed.",
    "grseg-micro run.h5 [options] > micro.tsv",
    "  grseg-micro run.h5 -o micro.tsv                  layers of 4 dS, windows of 1.25 s;\n"
    "                                                   rows with y0 = nan: the whole bed\n"
    "  grseg-micro run.h5 | grseg-derive -              contacts per grain, mean forces, B, ...\n",
    presets::micro};

constexpr Choice<GrainArea> areas[] = {{"clipped", GrainArea::clipped},
                                       {"centre", GrainArea::centre}};

struct Settings {
  FrameOptions frames;
  std::string composition = "clipped";
  double friction = no_number;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("composition", word_option(&s.composition, words_of(areas)),
      "area or volume of a grain in layers: clipped (cut at their edges) or centre (whole, in the "
      "layer of its centre)");
  add("friction", po::value(&s.friction)->value_name("MU"),
      "friction coefficient that decides which contacts slide (default: the run's)");
  s.frames.add_bins_to(options, false);
  s.frames.add_to(options);
  return options;
}

/// Friction coefficient from the command line or else from the run; NaN if neither has one.
double friction_of(const Settings& s, const Parameters& parameters)
{
  if (std::isnan(s.friction)) return parameters.find_number("friction").value_or(s.friction);
  if (!(s.friction >= 0)) throw UsageError("--friction must not be negative");
  return s.friction;
}

/// The choice of --composition. Throws UsageError for bins about an axis, because tensors have
/// components along x, y and z.
GrainArea area_of(Settings& s, const po::variables_map& values)
{
  const auto map = s.frames.map();
  if (s.frames.bins != "layers" && map != MapPlane::xy && map != MapPlane::xz)
    throw UsageError(fmt::format("--bins {}: grseg-micro has layers, xy and xz", s.frames.bins));
  if (map && values["composition"].defaulted()) s.composition = "centre";
  const auto area = choose(s.composition, "--composition", areas);
  if (map && area != GrainArea::centre)
    throw UsageError(
        "--composition clipped: in a map a grain counts in the cell of its centre; use centre");
  return area;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, GrainArea area, const std::string& command)
{
  const double friction = friction_of(s, loop.run().parameters());
  const bool map = loop.layers().map() != nullptr;
  Header settings{{"composition", s.composition},
                  {"sliding_tolerance", format_number(sliding_tolerance)}};
  if (!std::isnan(s.friction)) settings.emplace_back("friction", format_number(s.friction));
  TableWriter table(
      loop, command, settings,
      map ? columns_of(map_cells(StructureSums<D>{})) : StructureByLayer<D>::columns());
  for (const auto& window : loop.windows()) {
    const auto [micro] = loop.sum<D>(window, {.velocity = false, .contacts = true},
                                     StructureByLayer<D>(loop.layers(), area, friction));
    for (std::size_t layer = 0; layer < micro.layers(); ++layer)
      table.add(window, layer, map ? values_of(map_cells(micro.mean(layer))) : micro.row(layer));
    if (!map) table.add_bed(window, micro.heights().bed, micro.bed_row());
  }
  table.write(map ? "" : "grseg-derive");
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto area = area_of(s, values);
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, area, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info, options_into, tabulate);
}
