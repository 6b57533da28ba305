// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/checks.hpp"
#include "analysis/check/physics_check.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iostream>

using namespace grseg;

namespace {

constexpr const char* name = "grseg-check";

ToolInfo info()
{
  static const std::string help =
      "  grseg-check run.h5                               closed, readable, digests agree\n"
      "  grseg-check run.h5 --deep                        every path and chunk as specified in\n"
      "                                                   formats/README.md\n"
      "  grseg-check run.h5 --physics                     balances, contact laws, layers, drift\n"
      "  grseg-check run.h5 --physics --begin 20 --mean-overlap 1e-3 --json -o check.json\n"
      "\nChecks of --physics: quantity, option of its tolerance, law (docs/studies/check.md):\n" +
      checks::listed();
  return {name,
          "checks that a run is undamaged, as specified (--deep), and obeys mechanics (--physics).",
          "grseg-check run.h5 [options] > check.tsv", help.c_str()};
}

struct Settings {
  PhysicsSettings physics;
  TableOptions output;
  bool deep = false, with_physics = false, json = false, quiet = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  auto& windows = s.physics.windows;
  add("deep", po::bool_switch(&s.deep),
      "compare every path of the file with formats/README.md, and read every chunk");
  add("physics", po::bool_switch(&s.with_physics),
      "also check the laws of mechanics, with the tolerances below");
  add("layer", po::value(&s.physics.layer)->default_value(s.physics.layer)->value_name("LENGTH"),
      "thickness of the layers whose load is checked: 4dS, 2dL, 20mm, 0.02m");
  add("window", window_option(windows),
      "duration of averaging windows; errors follow from the scatter of window means");
  add("begin", time_option(windows.begin), "leave out frames before this time (default: t = 0)");
  add("end", time_option(windows.end), "leave out frames from this time on (default: none)");
  for (const auto& tolerance : CheckTolerances::options()) {
    double& value = s.physics.tolerances.*tolerance.value;
    add(tolerance.name,
        po::value(&value)->default_value(value, fmt::format("{:g}", value))->value_name("X"),
        tolerance.meaning);
  }
  add("json", po::bool_switch(&s.json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&s.quiet), "no progress on standard error");
  s.output.add_to(options);
  return options;
}

Header header_of(const TrajectoryReader& run, const Settings& s, const std::string& command)
{
  Header header = provenance(info(), "", run, command);
  if (!s.with_physics) return header;
  header.emplace_back("layer", s.physics.layer);
  header.emplace_back("window", window_text(s.physics.windows));
  for (const auto& tolerance : CheckTolerances::options())
    header.emplace_back(tolerance.name, format_number(s.physics.tolerances.*tolerance.value));
  return header;
}

/// The usual window, or the time between frames where that is longer, in s.
double default_window(const RunTimes& times)
{
  return std::max(WindowSettings{}.length,
                  static_cast<double>(longest_interval(times)) * times.step);
}

void check(Settings& s, const po::variables_map& values, const std::string& command)
{
  s.output.check(values);
  const TrajectoryReader run(single_input(values, "check one at a time"), Verify::no);
  ChecksAsked asked{.deep = s.deep, .physics = {}};
  if (values["window"].defaulted()) s.physics.windows.length = default_window(times_of(run));
  if (s.with_physics) asked.physics = s.physics;
  ProgressBar progress(name, {.things = "frames", .total = static_cast<double>(run.size())},
                       s.quiet);
  const CheckReport report{header_of(run, s, command), with_dimension(run.dimension(), [&](auto d) {
                             return check_run<d>(run, asked, [&](std::size_t done) {
                               progress.show(static_cast<double>(done));
                             });
                           })};
  progress.clear();
  write_table(s.output, s.json ? to_json(report) : to_tsv(report));
  std::cout.flush();
  if (const auto failures = report.failures(); !failures.empty())
    throw CheckError(fmt::format("{}: {}", run.path(), failures));
  if (const auto undecided = report.undecided(); !undecided.empty() && !s.quiet)
    fmt::print(stderr, "{}: {}: {}\n", name, run.path(), undecided);
  say_next(fmt::format("grseg-stress {} -o stress.tsv", shell_word(run.path())), s.quiet);
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main<Settings>(argc, argv, info(), options_into, check);
}
