// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/run_of_page.hpp"

#include "analysis/check/physics_check.hpp"
#include "analysis/explore/player_data.hpp"
#include "analysis/explore/shown_run.hpp"
#include "analysis/explore/stress_tables.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// {"fit": the fits}, or {"why_no_fit": the reason why there are none}.
Json fitted(const StressTables& input, PartitionSettings settings, const std::string& base,
            BinaryArrays& arrays)
{
  const auto word = base.empty() ? header_or(input.sums.front(), "base", "contact-point") : base;
  settings.fit.base = choose(word, "--base-part", base_parts);
  try {
    return {{"fit", partition_data(input, settings, arrays)}};
  } catch (const RunError& nothing) {
    return {{"why_no_fit", printable(nothing.what())}};
  }
}

/// Summary of the file, and the species of grains.
Json facts_of(const FrameLoop& loop)
{
  auto facts = run_summary(loop.run());
  facts["small_diameter"] = loop.run().small_diameter();
  facts["species"] = Json::array();
  for (const auto& one : loop.species())
    facts["species"].push_back({{"name", one.name}, {"diameter", one.diameter}});
  return facts;
}

/// Begin and end of the windows of the sums, s, and the kind of their bins: "layers" by default, else the
/// word in the line "bins" of the table.
Json cut_of(const Table& sums)
{
  const auto begin = sums.column("t0"), end = sums.column("t1");
  std::set<std::pair<double, double>> windows;
  for (const auto& row : sums.rows) windows.emplace(row[begin], row[end]);
  const auto bins = header_or(sums, "bins", "layers");
  Json cut{{"bins", bins.substr(0, bins.find(' '))}, {"window_times", Json::array()}};
  for (const auto& window : windows) cut["window_times"].push_back({window.first, window.second});
  return cut;
}

std::vector<std::size_t> frames_to_show(const FrameLoop& loop, const ExploreSettings& s)
{
  std::vector<std::size_t> frames;
  for (const auto& window : loop.windows())
    frames.insert(frames.end(), window.frames.begin(), window.frames.end());
  return evenly_spaced(frames, static_cast<std::size_t>(s.shown_frames));
}

Json player_of(const FrameLoop& loop, const ExploreSettings& s, BinaryArrays& arrays)
{
  const auto shown = frames_to_show(loop, s);
  return with_dimension(loop.dimension(), [&](auto d) {
    return player_data(show_run<d>(loop.run(), loop.grains(), shown), loop.run().box(), arrays);
  });
}

/// Table of sums of a run: `given`, or made from the run if `given` is null.
StressTables sums_of(FrameLoop& loop, const Table* given, const std::string& command)
{
  if (given == nullptr) return make_stress_tables(loop, command);
  require_same_species(*given, loop.species());
  return {{*given}, {}};
}

/// True if the table, between --begin and --end, has the windows, frames and layers of the loop.
bool is_over_windows_of(const FrameLoop& loop, const Table& sums, const RowFilter& filter)
{
  std::set<std::array<double, 3>> own, of_table;
  for (const auto& window : loop.windows())
    own.insert({window.begin, window.end, static_cast<double>(window.frames.size())});
  const auto begin = sums.column("t0"), end = sums.column("t1"), frames = sums.column("frames"),
             bottom = sums.column("y0"), top = sums.column("y1");
  const double thickness = loop.layers().thickness();
  for (const auto& row : sums.rows) {
    if (row[begin] < filter.begin || row[end] > filter.end) continue;
    of_table.insert({row[begin], row[end], row[frames]});
    if (std::abs(row[top] - row[bottom] - thickness) > 1e-6 * thickness) return false;
  }
  return own == of_table;
}

/// Tables by layer and numbers of segregation. Both are left out if B, from the table `given`, is over other
/// windows or layers, so that all of a page is from one set of data.
Json averages_of(FrameLoop& loop, const Table* given, const ExploreSettings& s)
{
  if (given == nullptr || is_over_windows_of(loop, *given, s.partition.filters))
    return {{"layers", layer_tables(loop)},
            {"segregation", segregation_data(loop, s.partition.filters.heights)}};
  const auto why = fmt::format(
      "Profiles, tables by layer and segregation are left out: B is of the windows and layers of {}, "
      "which are not those of {} with these options",
      printable(given->name), printable(loop.run().path()));
  return {{"layers", {{"tables", Json::array()}, {"missing", {why}}}}, {"segregation", nullptr}};
}

/// Tables of sums of all runs, in order.
StressTables together(const std::vector<RunOfPage>& runs)
{
  auto all = runs.front().sums;
  for (std::size_t run = 1; run < runs.size(); ++run) {
    const auto& [sums, of_powers] = runs[run].sums;
    all.sums.push_back(sums.front());
    all.of_powers.resize(std::min(all.of_powers.size(), of_powers.size()));
    for (std::size_t k = 0; k < all.of_powers.size(); ++k)
      all.of_powers[k].push_back(of_powers[k].front());
  }
  return all;
}

Json lines_of(const std::string& text)
{
  Json all = Json::array();
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) all.push_back(printable(line));
  return all;
}

std::string text_of(const std::vector<double>& numbers)
{
  return fmt::format("{:.9g}", fmt::join(numbers, " "));
}

constexpr std::string_view summary_prefix = "summary_";

/// Names and values of /parameters. `of_summary`: parameters named summary_*; otherwise all other ones,
/// except texts that the page shows elsewhere.
Json parameters_of(const TrajectoryReader& run, bool of_summary)
{
  Json all = Json::array();
  const auto& [numbers, texts] = run.parameters();
  for (const auto& [name, value] : numbers)
    if (name.starts_with(summary_prefix) == of_summary)
      all.push_back(
          {printable(of_summary ? name.substr(summary_prefix.size()) : name), text_of(value)});
  if (of_summary) return all;
  for (const auto& [name, value] : texts)
    if (name != "scene" && name != "history" && name != "command_line")
      all.push_back({printable(name), printable_lines(value)});
  return all;
}

Json observables_of(const TrajectoryReader& run)
{
  Json all = Json::array();
  for (const auto& [name, unit] : run.observables()) {
    const auto values = run.observable(name);
    if (values.empty()) continue;
    const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    all.push_back(
        {printable(name), printable(unit), mean, *std::max_element(values.begin(), values.end())});
  }
  return all;
}

}  // namespace

void refuse_too_large(const ToolInfo& info, const po::variables_map& values,
                      const std::vector<std::string>& runs, const ExploreSettings& s)
{
  auto unread = s.frames;
  unread.quiet = unread.trust.trust = true;
  double megabytes = 0;
  for (const auto& path : runs) {
    const FrameLoop loop(info, with_inputs(values, {path}), unread);
    megabytes += 1e-6 * player_bytes(loop.run(), frames_to_show(loop, s).size());
  }
  if (megabytes <= most_megabytes) return;
  // Divided by 1.5, since evenly_spaced() may return up to 1.5 times the frames asked for.
  const double fewer = s.shown_frames * most_megabytes / megabytes / 1.5;
  throw UsageError(fmt::format(
      "{}: about {} frames (--frames {}) are {:.0f} MB of positions and forces, and a page of more than "
      "{:.0f} MB does not open in every browser; {}",
      printable(runs.front()) + (runs.size() > 1 ? " and the others" : ""), s.shown_frames,
      s.shown_frames, megabytes, most_megabytes,
      fewer >= 1 ? fmt::format("use --frames {:.0f}, or a part of the run with --begin and --end",
                               std::floor(fewer))
                 : "use a part of the run with --begin and --end, or grseg-render"));
}

RunOfPage run_of_page(const ToolInfo& info, const po::variables_map& values,
                      const std::string& path, const Table* table, const ExploreSettings& s,
                      const std::string& command)
{
  const auto own = with_inputs(values, {path});
  const ProgressBar progress(info.name, {}, s.frames.quiet);
  const auto tell = [&](const char* what) { progress.say(path + ": " + what); };
  auto quietly = s.frames;
  quietly.quiet = true;
  FrameLoop loop(info, own, quietly);
  RunOfPage run{facts_of(loop), {}, {}};
  tell("frames");
  run.content["player"] = player_of(loop, s, run.arrays);
  tell("sums");
  run.sums = sums_of(loop, table, command);
  if (table != nullptr) run.content["sums"] = printable(table->name);
  run.content.update(cut_of(run.sums.sums.front()));
  tell("intervals");
  run.content.update(fitted(run.sums, s.partition, s.base, run.arrays));
  tell("tables by layer");
  run.content.update(averages_of(loop, table, s));
  tell("checks");
  run.content["checks"] = check_run(path);
  return run;
}

Json fitted_together(const std::vector<RunOfPage>& runs, const ExploreSettings& s,
                     BinaryArrays& arrays)
{
  try {
    return fitted(together(runs), s.partition, s.base, arrays);
  } catch (const FormatError& different) {  // e.g. discs and spheres; both are shown all the same
    return {{"why_no_fit", printable(different.what())}};
  }
}

Json run_summary(const TrajectoryReader& run)
{
  const auto& parameters = run.parameters();
  Json notes = Json::array();
  for (const auto& [key, value] : verification_lines(run))
    if (key != "verified") notes.push_back({key, value});
  return {{"name", printable(std::filesystem::path(run.path()).filename().string())},
          {"digest", fmt::format("xxh3 {}", format_digest(run.digest()))},
          {"verified", run.verified()},
          {"notes", std::move(notes)},
          {"history", lines_of(parameters.text("history"))},
          {"program", printable(parameters.text("program"))},
          {"dimension", run.dimension()},
          {"frames", run.size()},
          {"contacts", run.contacts()},
          {"begin", run.times().front()},
          {"end", run.times().back()},
          {"scene", printable_lines(parameters.text("scene"))},
          {"parameters", parameters_of(run, false)},
          {"accuracy", parameters_of(run, true)},
          {"observables", observables_of(run)}};
}

Json check_run(const std::string& path)
{
  const TrajectoryReader run(path, Verify::no);
  CheckReport report;
  with_dimension(run.dimension(), [&](auto d) {
    report.lines = check_run<d>(run, {.deep = false, .physics = PhysicsSettings{}});
  });
  Json all{{"command", "grseg-check --physics"},
           {"failures", report.failures()},
           {"undecided", report.undecided()},
           {"lines", Json::array()}};
  for (const auto& line : report.lines)
    all["lines"].push_back({{"quantity", printable(line.quantity)},
                            {"y0", line.y0},
                            {"y1", line.y1},
                            {"measured", line.measured},
                            {"tolerance", line.tolerance},
                            {"verdict", to_text(line.verdict)},
                            {"remark", printable(line.remark)}});
  return all;
}

}  // namespace grseg
