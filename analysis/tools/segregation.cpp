// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/segregation/run.hpp"
#include "formats/cli/output.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-segregation",
    "how fast the species separate: fluxes, diffusivities, segregation times and Peclet number.",
    "grseg-segregation run.h5 [options] > segregation.tsv",
    "  grseg-segregation run.h5 -o segregation.tsv             by layer and window, and the bed\n"
    "  grseg-segregation run.h5 --summary                      times, S, D, Pe of the whole run\n"
    "  grseg-segregation run.h5 --summary --heights 4dS:56dS   without base and surface\n"
    "  grseg-segregation run.h5 --window 5                     D over a longer time\n",
    presets::segregation};

struct Settings {
  FrameOptions frames;
  bool summary = false;
  std::string heights;
  double min_solid = 0.5;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()("summary", po::bool_switch(&s.summary),
                        "print numbers of the whole run with 95 % intervals instead of layers and "
                        "windows");
  options.add_options()("heights", po::value(&s.heights)->value_name("y0:y1"),
                        "with --summary: take S, D and Pe from layers between these heights, e.g. "
                        "4dS:56dS or 4dS: (default: all)");
  options.add_options()(
      "min-solid", po::value(&s.min_solid)->default_value(0.5, "0.5")->value_name("X"),
      "with --summary: leave out layers whose solid fraction is less than X times "
      "the median");
  s.frames.add_to(options);
  return options;
}

RateFilter filter_of(const Settings& s, LengthUnits units)
{
  if (!(s.min_solid >= 0)) throw UsageError("--min-solid must not be negative");
  return {parse_heights(s.heights, units), s.min_solid};
}

void write_summary(const Settings& s, const SegregationSummary& summary, Header header)
{
  header.emplace_back("heights", s.heights.empty() ? "all" : s.heights);
  header.emplace_back("min_solid", format_number(s.min_solid));
  header.emplace_back("interval", "95 %");
  if (!s.frames.quiet)
    for (const auto& remark : summary.remarks) fmt::print(stderr, "{}: {}\n", info.name, remark);
  write_whole(s.frames.output, s.frames.json ? to_json(summary, header) : to_tsv(summary, header));
}

template <int D>
void tabulate(FrameLoop& loop, const Settings& s, const RateFilter& filter,
              const std::string& command)
{
  const double small_diameter = loop.species()[0].diameter;
  const double large_diameter = loop.species()[1].diameter;
  auto table = loop.make_table(command, {{"composition", "centre"}}, SegregationRun<D>::columns());
  SegregationRun<D> run(loop.layers(), small_diameter, large_diameter);
  for (const auto& window : loop.windows()) {
    const auto [series, flux] = loop.sum<D>(
        window, {.velocity = true, .contacts = false}, SegregationSeries<D>(loop.layers()),
        SegregationFlux<D>(loop.layers(), window, small_diameter, large_diameter));
    run.add(loop.grains(), series, flux);
    for (std::size_t layer = 0; layer < run.layers(); ++layer)
      table.rows.push_back(loop.row(window, layer, run.row(layer)));
    table.rows.push_back(loop.bed_row(window, run.bed(), run.bed_row()));
  }
  if (s.summary) return write_summary(s, run.summary(filter), table.header);
  loop.write(table);
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  const auto filter = filter_of(s, {loop.run().small_diameter(), loop.run().large_diameter()});
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, filter, command); });
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    tabulate(settings, values, command_line(argc, argv));
  });
}
