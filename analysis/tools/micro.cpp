// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/micro/derived_table.hpp"
#include "analysis/micro/force_distribution.hpp"
#include "analysis/micro/structure_by_layer.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-micro",
    "contacts, their forces and directions, by layer and of the bed: sums and derived quantities.",
    "grseg-micro run.h5 [options] > micro.tsv;  grseg-micro --derived micro.tsv ... [options]",
    "  grseg-micro run.h5 -o micro.tsv                  sums: layers of 4 dS, windows of 1.25 s;\n"
    "                                                   a row of each window is the bed's, y0 = nan\n"
    "  grseg-micro --derived micro.tsv                  z, f, Pi, B, friction, fabric of each row\n"
    "  grseg-micro --derived micro.tsv --force normal --average ends --pool composition\n"
    "  grseg-micro run.h5 | grseg-micro --derived -     without a file in between\n"
    "  grseg-micro run.h5 --distribution --window 30    histograms of f_n/<f_n>\n",
    presets::micro};

constexpr Choice<GrainArea> areas[] = {{"clipped", GrainArea::clipped},
                                       {"centre", GrainArea::centre}};
constexpr Choice<ForceUnit> units[] = {{"layer", ForceUnit::layer}, {"type", ForceUnit::type}};

struct Settings {
  FrameOptions frames;
  std::string composition = "clipped", unit = "layer";
  double friction = std::numeric_limits<double>::quiet_NaN(), bin = 0.1;
  bool derived = false, distribution = false;
  DerivedOptions derivation;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("composition", word_option(&s.composition, words_of(areas)),
      "give layers the area or volume of a grain clipped at their edges, or whole at its centre "
      "(centre)");
  add("friction", po::value(&s.friction)->value_name("MU"),
      "friction coefficient of the Coulomb limit at which contacts slide (default: the run's)");
  add("distribution", po::bool_switch(&s.distribution),
      "print histograms of f_n/<f_n> instead of the sums");
  add("unit", word_option(&s.unit, words_of(units)),
      "with --distribution: <f_n> is the mean over all contacts between grains of a layer, or over "
      "those of the same pair type (type)");
  add("bin", po::value(&s.bin)->default_value(s.bin, "0.1")->value_name("X"),
      "with --distribution: width of the 100 bins below the open one");
  add("derived", po::bool_switch(&s.derived),
      "read tables of this tool and print the quantities that follow from their sums");
  s.derivation.add_to(options);
  s.frames.add_bins_to(options);
  s.frames.add_to(options);
  s.frames.add_parts_to(options);
  return options;
}

/// NaN where neither the command line nor the run gives it.
double friction_of(const Settings& s, const Parameters& parameters)
{
  if (std::isnan(s.friction)) return parameters.find_number("friction").value_or(s.friction);
  if (!(s.friction >= 0)) throw UsageError("--friction must not be negative");
  return s.friction;
}

/// Components are those along x, y and z, so that annuli are left out.
GrainArea area_of(Settings& s, const po::variables_map& values)
{
  const auto map = s.frames.map();
  if (s.frames.annuli() || map == MapPlane::rz)
    throw UsageError(fmt::format("--bins {}: grseg-micro knows layers, xy and xz", s.frames.bins));
  if (map && values["composition"].defaulted()) s.composition = "centre";
  const auto area = choose(s.composition, "--composition", areas);
  if (map && area != GrainArea::centre)
    throw UsageError(
        "--composition clipped: in a map a grain counts to the cell of its centre; take centre");
  return area;
}

/// The sums of a cell of a map, and what is looked at: contacts per grain, mean normal force, and
/// the parts of contacts that slide and that are mixed.
template <int D>
std::vector<Cell> map_cells(const StructureSums<D>& sums)
{
  auto cells = sums.cells();
  const auto between = sums.between_grains();
  const auto &small = sums.of(Species::small), &large = sums.of(Species::large);
  for (const auto& cell :
       std::vector<Cell>{{"z", ratio(small.ends + large.ends, small.grains + large.grains)},
                         {"z_S", sums.coordination(Species::small)},
                         {"z_L", sums.coordination(Species::large)},
                         {"f_n[N]", ratio(between.normal, between.contacts)},
                         {"sliding", ratio(between.sliding, between.contacts)},
                         {"mixed_share", sums.mixed_share()}})
    cells.push_back(cell);
  return cells;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, GrainArea area, const std::string& command)
{
  const double friction = friction_of(s, loop.run().parameters());
  const bool map = loop.layers().map().has_value();
  Header settings{{"composition", s.composition},
                  {"sliding_tolerance", format_number(sliding_tolerance)}};
  if (!std::isnan(s.friction)) settings.emplace_back("friction", format_number(s.friction));
  auto table = loop.make_table(
      command, settings,
      map ? columns_of(map_cells(StructureSums<D>{})) : StructureByLayer<D>::columns());

  for (const auto& window : loop.windows()) {
    const auto [micro] = loop.sum<D>(window, {.velocity = false, .contacts = true},
                                     StructureByLayer<D>(loop.layers(), area, friction));
    for (std::size_t layer = 0; layer < micro.layers(); ++layer)
      loop.add(table, loop.row(window, layer,
                               map ? values_of(map_cells(micro.mean(layer))) : micro.row(layer)));
    if (!map) loop.add(table, loop.bed_row(window, micro.heights().bed, micro.bed_row()));
  }
  loop.write(std::move(table), map ? "" : "grseg-micro --derived");
}

void tabulate(Settings s, const po::variables_map& values, const std::string& command)
{
  const auto area = area_of(s, values);
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, area, command); });
}

template <int D>
void distribute(FrameLoop& loop, const Settings& s, ForceUnit unit, const std::string& command)
{
  auto table = loop.make_table(command, {{"unit", s.unit}, {"bin", format_number(s.bin)}},
                               ForceDistribution<D>::columns());
  const TrajectoryReader::Fields contacts{.velocity = false, .contacts = true};

  loop.expect_passes(2);
  for (const auto& window : loop.windows()) {
    const auto [mean] = loop.sum<D>(window, contacts, MeanNormalForce<D>(loop.layers()));
    const auto [forces] =
        loop.sum<D>(window, contacts, ForceDistribution<D>(loop.layers(), mean, unit, s.bin));
    for (std::size_t layer = 0; layer < forces.layers(); ++layer)
      for (const auto& row : forces.rows(layer)) loop.add(table, loop.row(window, layer, row));
    for (const auto& row : forces.bed_rows())
      loop.add(table, loop.bed_row(window, std::numeric_limits<double>::quiet_NaN(), row));
  }
  loop.write(std::move(table));
}

void distribute(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto unit = choose(s.unit, "--unit", units);
  if (!(s.bin > 0) || !std::isfinite(s.bin)) throw UsageError("--bin must be positive");
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  with_dimension(loop.dimension(), [&](auto d) { distribute<d>(loop, s, unit, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    const auto command = command_line(argc, argv);
    if (settings.derived) {
      refuse_options(values, {"part", "join"}, "makes parts of sums, which --derived reads whole");
      return write_derived_table(info, values, settings.derivation, settings.frames, command);
    }
    refuse_options(values, {"force", "average", "partition", "pool", "depth", "heights"},
                   "needs --derived and a table of sums");
    if (settings.distribution) {
      refuse_options(values, {"composition", "friction", "bins"},
                     "has no effect on --distribution; leave it out");
      return distribute(settings, values, command);
    }
    refuse_options(values, {"unit", "bin"}, "needs --distribution");
    tabulate(settings, values, command);
  });
}
