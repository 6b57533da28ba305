// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/micro/force_distribution.hpp"
#include "analysis/micro/micro_report.hpp"
#include "analysis/micro/micro_structure.hpp"
#include "formats/cli/words.hpp"

#include <cmath>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-micro",
    "contacts, their forces and directions, by layer and of the bed: sums, and what follows.",
    "grseg-micro run.h5 [options] > micro.tsv;  grseg-micro --derived micro.tsv ... [options]",
    "  grseg-micro run.h5 -o micro.tsv                  sums: layers of 4 dS, windows of 1.25 s\n"
    "  grseg-micro --derived micro.tsv                  z, f, Pi, B, friction, fabric of each row\n"
    "  grseg-micro --derived micro.tsv --force normal --average ends --pool composition\n"
    "  grseg-micro run.h5 | grseg-micro --derived -     without a file in between\n"
    "  grseg-micro run.h5 --distribution --window 30    histograms of f_n/<f_n>\n",
    presets::micro};

struct Settings {
  FrameOptions frames;
  std::string composition = "clipped", unit = "layer";
  double friction = std::numeric_limits<double>::quiet_NaN(), bin = 0.1;
  bool derived = false, distribution = false;
  ReportOptions report;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  const auto word = [](std::string& place) {
    return po::value(&place)->default_value(place)->value_name("WORD");
  };
  auto add = options.add_options();
  add("composition", word(s.composition),
      "a grain's area is clipped at the layers' edges, or whole at its centre");
  add("friction", po::value(&s.friction)->value_name("MU"),
      "of the Coulomb limit at which contacts slide (default: that of the run)");
  add("distribution", po::bool_switch(&s.distribution),
      "histograms of f_n/<f_n> instead of the sums");
  add("unit", word(s.unit),
      "<f_n> of --distribution: the mean over all contacts between grains of a layer, or over "
      "those "
      "of the same pair type");
  add("bin", po::value(&s.bin)->default_value(s.bin, "0.1")->value_name("X"),
      "width of its bins, of which there are a hundred and an open one");
  add("derived", po::bool_switch(&s.derived),
      "read tables of this tool and print what follows from their sums");
  s.report.add_to(options);
  s.frames.add_to(options);
  return options;
}

double friction_of(const Settings& s, const Parameters& parameters)
{
  if (!std::isnan(s.friction)) {
    if (!(s.friction >= 0)) throw UsageError("--friction must not be negative");
    return s.friction;
  }
  const auto found = parameters.numbers.find("friction");
  return found == parameters.numbers.end() || found->second.size() != 1 ? s.friction
                                                                        : found->second[0];
}

std::string number_or_unknown(double number)
{
  return std::isnan(number) ? "unknown" : format_number(number);
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto area =
      choose<GrainArea>(s.composition, "--composition",
                        {{"clipped", GrainArea::clipped}, {"centre", GrainArea::centre}});
  FrameLoop loop(info, values, s.frames);
  const auto& parameters = loop.run().parameters();
  const double friction = friction_of(s, parameters);
  const auto density = parameters.numbers.find("density");
  auto table = loop.make_table(
      command,
      {{"composition", s.composition},
       {"density",
        density == parameters.numbers.end() ? "unknown" : format_number(density->second.at(0))},
       {"friction", number_or_unknown(friction)},
       {"sliding_tolerance", format_number(sliding_tolerance)}},
      MicroStructure::columns());

  for (const auto& window : loop.windows()) {
    const auto [micro] = loop.sum(window, {.velocity = false, .contacts = true},
                                  MicroStructure(loop.layers(), area, friction));
    for (std::size_t layer = 0; layer < micro.layers(); ++layer)
      table.rows.push_back(loop.row(window, layer, micro.row(layer)));
    table.rows.push_back(loop.bed_row(window, micro.heights().bed, micro.bed_row()));
  }
  loop.write(table);
}

void distribute(const Settings& s, const po::variables_map& values, const std::string& command)
{
  const auto unit =
      choose<ForceUnit>(s.unit, "--unit", {{"layer", ForceUnit::layer}, {"type", ForceUnit::type}});
  if (!(s.bin > 0) || !std::isfinite(s.bin)) throw UsageError("--bin must be positive");
  FrameLoop loop(info, values, s.frames);
  auto table = loop.make_table(command, {{"unit", s.unit}, {"bin", format_number(s.bin)}},
                               ForceDistribution::columns());
  const TrajectoryReader::Fields contacts{.velocity = false, .contacts = true};

  for (const auto& window : loop.windows()) {
    const auto [mean] = loop.sum(window, contacts, MeanNormalForce(loop.layers()));
    const auto [forces] =
        loop.sum(window, contacts, ForceDistribution(loop.layers(), mean, unit, s.bin));
    for (std::size_t layer = 0; layer < forces.layers(); ++layer)
      for (const auto& row : forces.rows(layer)) table.rows.push_back(loop.row(window, layer, row));
    for (const auto& row : forces.bed_rows())
      table.rows.push_back(loop.bed_row(window, std::numeric_limits<double>::quiet_NaN(), row));
  }
  loop.write(table);
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    const auto command = command_line(argc, argv);
    if (settings.derived)
      return report_derived(info, values, settings.report, settings.frames, command);
    refuse_options(values, {"force", "average", "partition", "pool", "depth", "heights"},
                   "needs --derived and a table of sums");
    if (settings.distribution) {
      refuse_options(values, {"composition", "friction"}, "does not concern --distribution");
      return distribute(settings, values, command);
    }
    refuse_options(values, {"unit", "bin"}, "needs --distribution");
    tabulate(settings, values, command);
  });
}
