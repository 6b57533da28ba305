// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/presets.hpp"
#include "analysis/frames/table_writer.hpp"
#include "analysis/segregation/rates.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/frame.hpp"

#include <fmt/format.h>

#include <string>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-segregation",
    "rates of segregation: fluxes, diffusivities, segregation times and Peclet number.",
    "grseg-segregation run.h5 [options] > segregation.tsv",
    "  grseg-segregation run.h5 -o segregation.tsv             by window, for layers and bed\n"
    "  grseg-segregation run.h5 --summary                      times, S, D, Pe of the whole run\n"
    "  grseg-segregation run.h5 --summary --heights 4dS:56dS   without base and surface\n"
    "  grseg-segregation run.h5 --window 5                     diffusivity D over a longer time\n",
    presets::segregation};

struct Settings {
  FrameOptions frames;
  bool summary = false;
  RowFilter filter;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("summary", po::bool_switch(&s.summary),
      "print results of the whole run, with 95 % intervals, instead of rows by layer and window");
  s.filter.add_layers_to(options, "with --summary: ");
  s.frames.add_to(options);
  return options;
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, const std::string& command)
{
  const double small_diameter = loop.species()[0].diameter;
  const double large_diameter = loop.species()[1].diameter;
  TableWriter table(loop, command, {{"composition", "centre"}}, SegregationTable<D>::columns());
  SegregationTable<D> run(loop.layers(), small_diameter, large_diameter);
  for (const auto& window : loop.windows()) {
    const auto [series, flux] = loop.sum<D>(
        window, {.velocity = true, .contacts = false}, SegregationSeries<D>(loop.layers()),
        SegregationFlux<D>(loop.layers(), window, small_diameter, large_diameter));
    run.add(loop.grains(), series, flux);
    if (s.summary) continue;
    for (std::size_t layer = 0; layer < run.layers(); ++layer)
      table.add(window, layer, run.row(layer));
    table.add_bed(window, run.bed(), run.bed_row());
  }
  if (!s.summary) return table.write();
  auto header = table.table().header;
  add_all(header, s.filter.lines());
  header.emplace_back("interval", "95 %");
  write_numbers(run.summary(s.filter), header, info, s.frames.output, s.frames.json,
                s.frames.quiet);
}

void tabulate(Settings& s, const po::variables_map& values, const std::string& command)
{
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  s.filter.check();
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info, options_into, tabulate);
}
