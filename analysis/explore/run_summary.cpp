// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/run_summary.hpp"

#include "analysis/check/content_check.hpp"
#include "analysis/check/physics_check.hpp"
#include "formats/cli/verification.hpp"
#include "formats/core/dimension.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

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

/// /parameters whose names begin with summary_, or the others; texts that are shown elsewhere are not
/// among them.
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

template <int D>
std::vector<CheckLine> check_lines(const TrajectoryReader& run)
{
  ContentCheck content(run);
  PhysicsCheck<D> physics(run, PhysicsSettings{});
  Frame<D> frame;
  for (std::size_t k = 0; k < run.size(); ++k) {
    run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
    content.add(k, frame);
    physics.add(k, frame);
  }
  auto lines = content.lines();
  for (auto& line : physics.lines()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace

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
  with_dimension(run.dimension(), [&](auto d) { report.lines = check_lines<d>(run); });
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
