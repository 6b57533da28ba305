// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/settings.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <string_view>

namespace grseg {
namespace {

bool is_hdf5(const std::string& path)
{
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::string start(signature.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) && start == signature;
}

}  // namespace

void ExploreSettings::add_to(po::options_description& options)
{
  auto add = options.add_options();
  add("frames", po::value(&shown_frames)->default_value(shown_frames)->value_name("N"),
      "show about N frames, evenly spaced; B and all tables use all frames");
  const auto first = "partition rule that is selected when the page opens: " + list_of_rules("or");
  add("partition", word_option(&start, words_of_rule()), first.c_str());
  add("rules", words_option(rules, words_of_rules()),
      "rules that the report compares (default: stock, the rules of published programs)");
  add("component", word_option(&component, words_of(components)), list_of(components).c_str());
  add("base-part", word_option(&base, words_of(base_parts)),
      ("grain's part of its contact with base or wall: " + list_of(base_parts) +
       " (default: as in the table)")
          .c_str());
  add("pair", po::value(&partition.pair)->value_name("A,B"),
      "the two species to compare, by name or number, if there are more than two (default: 1,2)");
  add("heights",
      po::value(&partition.filters.heights)->value_name("y0:y1")->default_value(inside_the_bed),
      fmt::format("layers from which B is computed: {}", heights_help).c_str());
  frames.add_to(options, FrameOptions::Makes::page);
}

void ExploreSettings::check(const po::variables_map& values)
{
  if (shown_frames < 1 || shown_frames > 10000)
    throw UsageError(fmt::format("--frames {}: it must be 1 to 10000", shown_frames));
  partition.fit.component = choose(component, "--component", components);
  if (!base.empty()) choose(base, "--base-part", base_parts);
  check_heights(partition.filters.heights);
  const auto first = parse_rule(start);
  if (first.kind == PartitionRule::Kind::power &&
      !(first.value >= 0 && first.value <= highest_power))
    throw UsageError(fmt::format(
        "--partition {}: the page shows power:Q for Q from 0 to {:g}; for another Q use grseg-stress "
        "and grseg-fit with --partition {}",
        first.name(), highest_power, first.name()));
  partition.rules = parse_rules(rules);
  for (const auto& rule : partition.rules)
    if (rule.definition().sum == PairSum::by_power)
      throw UsageError(fmt::format(
          "--rules {}: the report compares only rules that need no sums of their own; move the slider Q "
          "of the page instead, or use grseg-stress and grseg-fit with --partition {}",
          rule.name(), rule.name()));
  auto& filters = partition.filters;
  filters.begin = frames.windows.begin.value_or(filters.begin);
  filters.end = frames.windows.end.value_or(filters.end);
  frames.output.check(values);
  const bool to_terminal = frames.output.path.empty() && isatty(STDOUT_FILENO) == 1;
  if (to_terminal && !frames.json)
    throw UsageError("a terminal cannot show a page; name a file for it, e.g. -o explore.html");
}

ExploreInputs inputs_of(const po::variables_map& values)
{
  ExploreInputs inputs;
  if (values.count("input") > 0)
    for (const auto& path : values["input"].as<std::vector<std::string>>()) {
      if (path != "-") require_file(path);
      (is_hdf5(path) ? inputs.runs : inputs.tables).push_back(path);
    }
  if (inputs.runs.empty())
    throw UsageError(
        inputs.tables.empty()
            ? "no run given; name a trajectory file, e.g. run.h5"
            : fmt::format(
                  "{}: is not a run (HDF5); give a run, e.g. run.h5, beside the tables of sums",
                  printable(inputs.tables.front())));
  return inputs;
}

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

namespace {

/// " NAME VALUE" for a shell, or "" if the value is the default, `usual`.
template <class T>
std::string option(const char* name, const T& value, const T& usual)
{
  return value == usual ? "" : fmt::format(" {} {}", name, shell_word(fmt::format("{}", value)));
}

std::string times_of(const WindowSettings& windows)
{
  std::string text;
  if (windows.begin) text += fmt::format(" --begin {}", *windows.begin);
  if (windows.end) text += fmt::format(" --end {}", *windows.end);
  return text;
}

std::string stress_options(const FrameOptions& own)
{
  const FrameOptions usual;
  auto text = option("--layer", own.layer, usual.layer) +
              option("--window", window_text(own.windows), window_text(usual.windows)) +
              times_of(own.windows) + option("--stride", own.windows.stride, usual.windows.stride);
  for (const auto& group : own.grouping.groups) text += option("--group", group, std::string());
  return text + option("--classes", own.grouping.classes, usual.grouping.classes) +
         option("--edges", own.grouping.edges, usual.grouping.edges) +
         (own.trust.trust ? " --trust" : "");
}

/// Options of grseg-fit. --begin and --end are passed only if the table was `given`: a table made from the
/// run gets them from grseg-stress.
std::string fit_options(const ExploreSettings& own, bool given)
{
  const ExploreSettings usual;
  return (given ? times_of(own.frames.windows) : "") +
         option("--heights", own.partition.filters.heights, std::string(inside_the_bed)) +
         option("--component", own.component, usual.component) +
         option("--base-part", own.base, usual.base);
}

}  // namespace

nlohmann::ordered_json commands_of(const std::string& run, const Table* given,
                                   const ExploreSettings& settings, std::size_t number)
{
  const auto made = number == 0 ? std::string("sums.tsv") : fmt::format("sums-{}.tsv", number);
  return {{"sums", given == nullptr
                       ? "grseg-stress " + shell_word(run) + stress_options(settings.frames)
                       : std::string()},
          {"file", given == nullptr ? made : shell_word(given->name)},
          {"fit", fit_options(settings, given != nullptr)}};
}

}  // namespace grseg
