// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/command.hpp"

#include "analysis/explore/layer_tables.hpp"
#include "analysis/explore/page.hpp"
#include "analysis/explore/partition_data.hpp"
#include "analysis/explore/player_data.hpp"
#include "analysis/explore/run_summary.hpp"
#include "analysis/explore/segregation_data.hpp"
#include "analysis/explore/shown_run.hpp"
#include "analysis/explore/stress_tables.hpp"
#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/input_tables.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  FrameOptions frames;
  PartitionSettings partition;
  std::vector<std::string> rules{"stock"};
  std::string start = "size", component = "yy", base;
  int shown_frames = 100, bootstrap = 1000;
  long seed = 1;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  add("frames", po::value(&s.shown_frames)->default_value(s.shown_frames)->value_name("N"),
      "show about N frames, in equal steps; sums are of all");
  const auto start = "the rule that the page begins with: " + list_of_rules("or");
  add("partition", po::value(&s.start)->default_value(s.start)->value_name("RULE"), start.c_str());
  add("rules", po::value(&s.rules)->composing()->value_name("RULE,..."),
      "rules that the report compares (default: stock, those of published codes)");
  add("component", po::value(&s.component)->default_value(s.component)->value_name("NAME"),
      list_of(components).c_str());
  add("base", po::value(&s.base)->value_name("NAME"),
      ("part of contacts with base and walls: " + list_of(base_parts) +
       " (default: as in the table)")
          .c_str());
  add("pair", po::value(&s.partition.pair)->value_name("A,B"),
      "of more than two species the two that are compared, by name or number (default: 1,2)");
  add("heights", po::value(&s.partition.filters.heights)->value_name("y0:y1"),
      "B is of the layers between, e.g. 4dS:56dS or 4dS: (default: all)");
  add("bootstrap", po::value(&s.bootstrap)->default_value(s.bootstrap)->value_name("N"),
      "samples for the 95 % intervals; 0: no intervals");
  add("seed", po::value(&s.seed)->default_value(s.seed)->value_name("N"), "seed of the samples");
  s.frames.add_to(options);
  return options;
}

/// What the command line says beside options: runs, and tables of sums.
struct Inputs {
  std::vector<std::string> runs, tables;
};

bool is_hdf5(const std::string& path)
{
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::string start(signature.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) && start == signature;
}

Inputs inputs_of(const po::variables_map& values)
{
  Inputs inputs;
  if (values.count("input") > 0)
    for (const auto& path : values["input"].as<std::vector<std::string>>()) {
      if (path != "-") require_file(path);
      (is_hdf5(path) ? inputs.runs : inputs.tables).push_back(path);
    }
  if (inputs.runs.empty())
    throw UsageError(
        inputs.tables.empty()
            ? "no run given; name a trajectory file, e.g. run.h5"
            : fmt::format("{}: is not a run (HDF5); a page shows runs, and uses tables beside them",
                          printable(inputs.tables.front())));
  return inputs;
}

/// As if these inputs had been given alone.
po::variables_map with_inputs(const po::variables_map& values,
                              const std::vector<std::string>& paths)
{
  po::variables_map others = values;
  std::map<std::string, po::variable_value>& all = others;
  if (paths.empty())
    all.erase("input");
  else
    all["input"] = po::variable_value(paths, false);
  return others;
}

/// Refuses what cannot be meant, before any run is read, and sets what follows from words.
void check(Settings& s, const po::variables_map& values)
{
  if (s.shown_frames < 1 || s.shown_frames > 10000)
    throw UsageError(fmt::format("--frames {}: it must be 1 to 10000", s.shown_frames));
  if (s.bootstrap != 0 && (s.bootstrap < 100 || s.bootstrap > 100000))
    throw UsageError(fmt::format("--bootstrap {}: 0, or 100 to 100000 samples", s.bootstrap));
  if (s.seed < 0) throw UsageError("--seed must not be negative");
  s.partition.fit.component = choose(s.component, "--component", components);
  if (!s.base.empty()) choose(s.base, "--base", base_parts);
  parse_heights(s.partition.filters.heights, {1, 1});
  parse_rule(s.start);
  s.partition.rules = parse_rules(s.rules);
  for (const auto& rule : s.partition.rules)
    if (rule.definition().sum == PairSum::by_power)
      throw UsageError(fmt::format(
          "--rules {}: the report compares rules whose sums every table has; move the slider to Q "
          "instead, or take grseg-stress and grseg-fit with --partition {}",
          rule.name(), rule.name()));
  auto& filters = s.partition.filters;
  filters.begin = s.frames.windows.begin.value_or(filters.begin);
  filters.end = s.frames.windows.end.value_or(filters.end);
  s.partition.resampling = {static_cast<std::size_t>(s.bootstrap),
                            static_cast<unsigned long>(s.seed)};
  s.frames.output.check(values);
  const bool to_terminal = s.frames.output.path.empty() && isatty(STDOUT_FILENO) == 1;
  if (to_terminal && !s.frames.json)
    throw UsageError("a page is nothing for a terminal; name it, e.g. -o explore.html");
}

/// What is being done, on a terminal.
class Progress {
 public:
  Progress(const char* tool, bool quiet) : tool_(tool), on_(!quiet && isatty(STDERR_FILENO) == 1) {}
  ~Progress() { clear(); }
  void tell(const std::string& run, const char* what) const
  {
    if (!on_) return;
    fmt::print(stderr, "\r{}: {}: {}\033[K", tool_, printable(run), what);
    std::fflush(stderr);
  }
  void clear() const
  {
    if (on_) fmt::print(stderr, "\r\033[K");
  }

 private:
  const char* tool_;
  bool on_;
};

/// A run in the making: what the page has of it, its arrays, and the sums that those of all runs
/// together are made of.
struct RunOfPage {
  Json content;
  BinaryArrays arrays;
  PartitionInput sums;
};

/// Fits, or the sentence that tells why there is nothing to fit.
Json fitted(const PartitionInput& input, PartitionSettings settings, const std::string& base,
            BinaryArrays& arrays)
{
  const auto word = base.empty() ? header_or(input.sums.front(), "base", "contact-point") : base;
  settings.fit.base = choose(word, "--base", base_parts);
  try {
    return {{"fit", partition_data(input, settings, arrays)}};
  } catch (const RunError& nothing) {
    return {{"why_no_fit", printable(nothing.what())}};
  }
}

Json player_of(const FrameLoop& loop, const Settings& s, BinaryArrays& arrays)
{
  std::vector<std::size_t> frames;
  for (const auto& window : loop.windows())
    frames.insert(frames.end(), window.frames.begin(), window.frames.end());
  const auto shown = evenly_spaced(frames, static_cast<std::size_t>(s.shown_frames));
  return with_dimension(loop.dimension(), [&](auto d) {
    return player_data(show_run<d>(loop.run(), loop.grains(), shown), loop.run().box(), arrays);
  });
}

/// `table`: the sums that were given of the run, if any.
RunOfPage show(const ToolInfo& info, const po::variables_map& values, const std::string& path,
               const Table* table, const Settings& s, const std::string& command)
{
  const auto own = with_inputs(values, {path});
  const Progress progress(info.name, s.frames.quiet);
  auto quietly = s.frames;
  quietly.quiet = true;
  FrameLoop loop(info, own, quietly);
  RunOfPage run;
  run.content = run_summary(loop.run());
  run.content["small_diameter"] = loop.run().small_diameter();
  run.content["gravity"] = with_dimension(loop.dimension(), [&](auto d) {
    const auto gravity = loop.run().gravity<d>();
    return Json::array({gravity.start.x(), gravity.start.y()});
  });
  run.content["species"] = Json::array();
  for (const auto& one : loop.species())
    run.content["species"].push_back({{"name", one.name}, {"diameter", one.diameter}});
  run.content["window_times"] = Json::array();
  for (const auto& window : loop.windows())
    run.content["window_times"].push_back({window.begin, window.end});

  progress.tell(path, "frames");
  run.content["player"] = player_of(loop, s, run.arrays);
  progress.tell(path, "sums");
  if (table != nullptr) {
    run.sums.sums.push_back(*table);
    run.content["sums"] = printable(table->name);
  } else {
    const bool two = loop.species().size() == 2;
    auto made = make_stress_tables(loop, two ? power_nodes() : std::vector<double>{}, command);
    run.sums.sums.push_back(std::move(made.sums));
    for (auto& of_power : made.of_powers) run.sums.of_powers.push_back({std::move(of_power)});
  }
  progress.tell(path, "intervals");
  run.content.update(fitted(run.sums, s.partition, s.base, run.arrays));
  progress.tell(path, "tables by layer");
  run.content["layers"] = layer_tables(loop);
  run.content["segregation"] = segregation_data(loop, s.partition.filters.heights);
  progress.tell(path, "checks");
  run.content["checks"] = check_run(path);
  return run;
}

/// The sums of all runs.
PartitionInput together(const std::vector<RunOfPage>& runs)
{
  PartitionInput all;
  const bool have_powers = std::all_of(
      runs.begin(), runs.end(), [](const RunOfPage& run) { return !run.sums.of_powers.empty(); });
  if (have_powers) all.of_powers.resize(runs.front().sums.of_powers.size());
  for (const auto& run : runs) {
    all.sums.push_back(run.sums.sums.front());
    for (std::size_t k = 0; k < all.of_powers.size(); ++k)
      all.of_powers[k].push_back(run.sums.of_powers[k].front());
  }
  return all;
}

/// Runs that cannot be taken together, such as of discs and of spheres, still stand side by side.
Json fitted_together(const std::vector<RunOfPage>& runs, const Settings& s, BinaryArrays& arrays)
{
  try {
    return fitted(together(runs), s.partition, s.base, arrays);
  } catch (const FormatError& different) {
    return {{"why_no_fit", printable(different.what())}};
  }
}

Json rules_known()
{
  Json rules = Json::array();
  for (const auto& rule : rule_definitions())
    rules.push_back({{"word", rule.word},
                     {"number", rule.number},
                     {"meaning", rule.meaning},
                     {"used_by", rule.used_by},
                     {"stock", rule.stock}});
  return rules;
}

std::vector<std::string> digests_of(const std::vector<std::string>& runs, Verify verify)
{
  std::vector<std::string> digests;
  digests.reserve(runs.size());
  for (const auto& path : runs)
    digests.push_back("xxh3 " + format_digest(TrajectoryReader(path, verify).digest()));
  return digests;
}

/// Tells on standard error what the report of a run says against it.
void remark(const ToolInfo& info, const RunOfPage& run)
{
  const auto failures = run.content["checks"]["failures"].get<std::string>();
  const auto name = run.content["name"].get<std::string>();
  if (!failures.empty()) fmt::print(stderr, "{}: {}: {}\n", info.name, name, failures);
  if (run.content.contains("why_no_fit"))
    fmt::print(stderr, "{}: {}: B is not shown: {}\n", info.name, name,
               run.content["why_no_fit"].get<std::string>());
}

void write_page(const ToolInfo& info, const po::variables_map& values, Settings s, PageTab tab,
                const std::string& command)
{
  check(s, values);
  const auto inputs = inputs_of(values);
  const auto tables = read_tables(info, with_inputs(values, inputs.tables), s.frames.quiet);
  const auto of_runs = tables_of_runs(tables, digests_of(inputs.runs, s.frames.trust.verify()));
  std::vector<RunOfPage> runs;
  for (std::size_t k = 0; k < inputs.runs.size(); ++k)
    runs.push_back(show(info, values, inputs.runs[k], of_runs[k], s, command));

  Json content{{"program", program_line(info).second},
               {"command", command},
               {"tab", tab == PageTab::report ? "report" : "explore"},
               {"start", parse_rule(s.start).name()},
               {"rules", rules_known()},
               {"runs", Json::array()}};
  std::vector<std::string> arrays;
  arrays.reserve(runs.size() + 1);
  for (auto& run : runs) {
    if (!s.frames.quiet) remark(info, run);
    run.content["arrays"] = run.arrays.directory();
    arrays.push_back(run.arrays.base64());
    content["runs"].push_back(std::move(run.content));
  }
  if (runs.size() > 1) {
    BinaryArrays of_all;
    content["together"] = fitted_together(runs, s, of_all);
    content["together"]["arrays"] = of_all.directory();
    arrays.push_back(of_all.base64());
  }
  write_whole(s.frames.output, s.frames.json ? content.dump(1) + '\n' : page_of(content, arrays));
}

}  // namespace

int write_explore_page(int argc, char** argv, const ToolInfo& info, PageTab tab)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    write_page(info, values, settings, tab, command_line(argc, argv));
  });
}

}  // namespace grseg
