// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/run_of_page.hpp"

#include "analysis/explore/layer_tables.hpp"
#include "analysis/explore/player_data.hpp"
#include "analysis/explore/run_summary.hpp"
#include "analysis/explore/segregation_data.hpp"
#include "analysis/explore/shown_run.hpp"
#include "analysis/explore/stress_tables.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <algorithm>
#include <utility>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

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

/// What the file says, and how it is cut into species and windows.
Json facts_of(const FrameLoop& loop)
{
  auto facts = run_summary(loop.run());
  facts["small_diameter"] = loop.run().small_diameter();
  facts["gravity"] = with_dimension(loop.dimension(), [&](auto d) {
    const auto gravity = loop.run().gravity<d>();
    return Json::array({gravity.start.x(), gravity.start.y()});
  });
  facts["species"] = Json::array();
  for (const auto& one : loop.species())
    facts["species"].push_back({{"name", one.name}, {"diameter", one.diameter}});
  facts["window_times"] = Json::array();
  for (const auto& window : loop.windows())
    facts["window_times"].push_back({window.begin, window.end});
  return facts;
}

Json player_of(const FrameLoop& loop, const ExploreSettings& s, BinaryArrays& arrays)
{
  std::vector<std::size_t> frames;
  for (const auto& window : loop.windows())
    frames.insert(frames.end(), window.frames.begin(), window.frames.end());
  const auto shown = evenly_spaced(frames, static_cast<std::size_t>(s.shown_frames));
  return with_dimension(loop.dimension(), [&](auto d) {
    return player_data(show_run<d>(loop.run(), loop.grains(), shown), loop.run().box(), arrays);
  });
}

/// Those that were given, or made of the run.
PartitionInput sums_of(FrameLoop& loop, const Table* given, const std::string& command)
{
  if (given != nullptr) return {{*given}, {}};
  const bool two = loop.species().size() == 2;
  auto made = make_stress_tables(loop, two ? power_nodes() : std::vector<double>{}, command);
  PartitionInput sums{{std::move(made.sums)}, {}};
  sums.of_powers.reserve(made.of_powers.size());
  for (auto& of_power : made.of_powers) sums.of_powers.push_back({std::move(of_power)});
  return sums;
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

}  // namespace

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
  tell("intervals");
  run.content.update(fitted(run.sums, s.partition, s.base, run.arrays));
  tell("tables by layer");
  run.content["layers"] = layer_tables(loop);
  run.content["segregation"] = segregation_data(loop, s.partition.filters.heights);
  tell("checks");
  run.content["checks"] = check_run(path);
  return run;
}

Json fitted_together(const std::vector<RunOfPage>& runs, const ExploreSettings& s,
                     BinaryArrays& arrays)
{
  try {
    return fitted(together(runs), s.partition, s.base, arrays);
  } catch (const FormatError& different) {  // of discs and spheres: still they stand side by side
    return {{"why_no_fit", printable(different.what())}};
  }
}

}  // namespace grseg
