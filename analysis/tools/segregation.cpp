// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/frame_loop.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/micro/derived_table.hpp"
#include "analysis/segregation/closure.hpp"
#include "analysis/segregation/segregation_table.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-segregation",
    "how fast the species separate: fluxes, diffusivities, segregation times and Peclet number.",
    "grseg-segregation run.h5 [options] > segregation.tsv\n"
    "       grseg-segregation --closure a.segregation.tsv a.stress.tsv ... [options] > closure.tsv",
    "  grseg-segregation run.h5 -o segregation.tsv             by layer and window, and the bed\n"
    "  grseg-segregation run.h5 --summary                      times, S, D, Pe of the whole run\n"
    "  grseg-segregation run.h5 --summary --heights 4dS:56dS   without base and surface\n"
    "  grseg-segregation run.h5 --window 5                     D over a longer time\n"
    "  grseg-segregation --closure *.segregation.tsv *.stress.tsv --heights 4dS:56dS --begin 10\n"
    "                                                          B/c, d/c, and c by partition rule\n",
    presets::segregation};

struct Settings {
  FrameOptions frames;
  bool summary = false, closure = false;
  std::string heights;
  double min_solid = 0.5;
  std::vector<std::string> partition;
  std::string instruments = "previous";
  int bootstrap = 1000;
  long seed = 1;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  options.add_options()("summary", po::bool_switch(&s.summary),
                        "print numbers of the whole run with 95 % intervals instead of layers and "
                        "windows");
  options.add_options()("closure", po::bool_switch(&s.closure),
                        "read tables of this tool and of grseg-stress, of one or several runs, "
                        "and regress the flux of large grains on driving and gradient: B/c, d/c, "
                        "and c under each rule");
  options.add_options()(
      "heights", po::value(&s.heights)->value_name("y0:y1")->default_value(inside_the_bed),
      fmt::format("with --summary and --closure: layers that take part: {}", heights_help).c_str());
  options.add_options()(
      "min-solid", po::value(&s.min_solid)->default_value(0.5, "0.5")->value_name("X"),
      "with --summary and --closure: leave out layers whose solid fraction is less than X times "
      "the median");
  const auto rules = "with --closure: rules for c, " + list_of_rules() + ", or stock (default)";
  options.add_options()("partition", words_option(s.partition, words_of_rules()), rules.c_str());
  const auto instruments =
      "with --closure: instrumental variables of the regression: " + list_of(instrument_choices);
  options.add_options()("instruments", word_option(&s.instruments, words_of(instrument_choices)),
                        instruments.c_str());
  options.add_options()("bootstrap",
                        po::value(&s.bootstrap)->default_value(s.bootstrap)->value_name("N"),
                        "with --closure: samples for the 95 % intervals; 0: no intervals");
  options.add_options()("seed", po::value(&s.seed)->default_value(s.seed)->value_name("N"),
                        "with --closure: seed of the samples");
  s.frames.add_to(options);
  return options;
}

RateFilter filter_of(const Settings& s)
{
  if (!(s.min_solid >= 0)) throw UsageError("--min-solid must not be negative");
  check_heights(s.heights);
  return {s.heights, s.min_solid};
}

void write_summary(const Settings& s, const SegregationSummary& summary, Header header)
{
  header.emplace_back("heights", heights_in_words(s.heights));
  header.emplace_back("min_solid", format_number(s.min_solid));
  header.emplace_back("interval", "95 %");
  if (!s.frames.quiet)
    for (const auto& remark : summary.remarks) fmt::print(stderr, "{}: {}\n", info.name, remark);
  write_table(s.frames.output, s.frames.json ? to_json(summary, header) : to_tsv(summary, header));
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
      loop.add(table, loop.row(window, layer, run.row(layer)));
    loop.add(table, loop.bed_row(window, run.bed(), run.bed_row()));
  }
  if (s.summary) return write_summary(s, run.summary(filter), table.header);
  loop.write(std::move(table));
}

void tabulate(const Settings& s, const po::variables_map& values, const std::string& command)
{
  FrameLoop loop(info, values, s.frames);
  loop.require_two_species();
  const auto filter = filter_of(s);
  with_dimension(loop.dimension(), [&](auto d) { tabulate<d>(loop, s, filter, command); });
}

/// What of --closure cannot be meant, before any table is read.
void check_closure(const Settings& s, const po::variables_map& values)
{
  refuse_options(values,
                 {"layer", "window", "stride", "threads", "trust", "group", "classes", "edges"},
                 "concerns runs, and --closure reads tables; leave it out");
  refuse_options(values, {"summary"}, "and --closure exclude each other");
  if (s.bootstrap != 0 && (s.bootstrap < 100 || s.bootstrap > 100000))
    throw UsageError(fmt::format("--bootstrap {}: 0, or 100 to 100000 samples", s.bootstrap));
  if (s.seed < 0) throw UsageError("--seed must not be negative");
  s.frames.output.check(values);
}

std::string text_of_times(const WindowSettings& windows)
{
  if (!windows.begin && !windows.end) return "all";
  const auto text = [](const std::optional<double>& time) {
    return time ? fmt::format("{:g}", *time) : "";
  };
  return fmt::format("{}:{}", text(windows.begin), text(windows.end));
}

void close(const Settings& s, const po::variables_map& values, const std::string& command)
{
  check_closure(s, values);
  std::vector<std::string> words = s.partition;
  if (words.empty()) words = {"stock"};
  const auto rules = parse_rules(words);
  ClosureFilter filter;
  filter.heights = s.heights;
  filter.instruments = choose(s.instruments, "--instruments", instrument_choices);
  filter.min_solid = filter_of(s).min_solid;
  filter.range.begin = s.frames.windows.begin.value_or(filter.range.begin);
  filter.range.end = s.frames.windows.end.value_or(filter.range.end);
  const auto tables = read_tables(values);
  if (tables.empty())
    throw UsageError(
        "no table given; name a table of grseg-segregation and one of grseg-stress of each run");
  const auto data = read_closure(tables, rules, filter);
  const ClosureResampling resampling{static_cast<std::size_t>(s.bootstrap),
                                     static_cast<unsigned long>(s.seed)};

  Header header{program_line(info), {"preset", preset_of(values)}};
  for (const auto& line : header_values(tables, "history")) header.emplace_back("history", line);
  header.emplace_back("history", command);
  for (const auto& input : header_values(tables, "input")) header.emplace_back("input", input);
  for (auto& line : trust_of(tables)) header.push_back(std::move(line));
  if (!data.doubt.empty()) header.emplace_back("doubt", data.doubt);
  std::vector<std::string> names;
  names.reserve(rules.size());
  for (const auto& rule : rules) names.push_back(rule.name());
  header.insert(header.end(), {{"closure", "q_L = (B/c) driving - (d/c) gradient"},
                               {"partition", fmt::format("{}", fmt::join(names, ","))},
                               {"instruments", s.instruments},
                               {"times", text_of_times(s.frames.windows)},
                               {"rows", fmt::format("{} of {}", data.points.size(), data.rows)},
                               {"runs", fmt::format("{}", data.runs.size())},
                               {"windows", fmt::format("{}", number_of_windows(data.runs))},
                               {"over", closure_population(data.runs.size())},
                               {"bootstrap", fmt::format("{}", s.bootstrap)},
                               {"seed", fmt::format("{}", s.seed)}});
  write_summary(s, closure_summary(data, rules, resampling), header);
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    const auto command = command_line(argc, argv);
    if (settings.closure) return close(settings, values, command);
    refuse_options(values, {"partition", "instruments", "bootstrap", "seed"},
                   "needs --closure and tables");
    tabulate(settings, values, command);
  });
}
