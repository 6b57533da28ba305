// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/command.hpp"

#include "analysis/explore/page.hpp"
#include "analysis/explore/run_of_page.hpp"
#include "analysis/explore/settings.hpp"
#include "analysis/explore/stress_tables.hpp"
#include "formats/cli/bed.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

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

const WantedTables wanted{{"grseg-stress", "grseg-merge"},
                          "beside runs, give tables of grseg-stress only"};

/// Digest and bed of each run as written in its file. The digest is verified later, when the run is read.
std::vector<RunIdentity> identities_of(const std::vector<std::string>& runs)
{
  std::vector<RunIdentity> identities;
  identities.reserve(runs.size());
  for (const auto& path : runs) {
    const TrajectoryReader run(path, Verify::no);
    identities.push_back({"xxh3 " + format_digest(run.digest()), bed_of(run).text()});
  }
  return identities;
}

/// Prints on standard error which checks a run fails, and why there is no B.
void remark(const ToolInfo& info, const RunOfPage& run)
{
  const auto failures = run.content["checks"]["failures"].get<std::string>();
  const auto name = run.content["name"].get<std::string>();
  if (!failures.empty()) fmt::print(stderr, "{}: {}: {}\n", info.name, name, failures);
  if (run.content.contains("why_no_fit"))
    fmt::print(stderr, "{}: {}: B is not shown: {}\n", info.name, name,
               run.content["why_no_fit"].get<std::string>());
}

void write_page(const ToolInfo& info, const po::variables_map& values, ExploreSettings s,
                PageTab tab, const std::string& command)
{
  s.check(values);
  const auto inputs = inputs_of(values);
  const auto tables = inputs.tables.empty()
                          ? std::vector<Table>{}
                          : read_tables(with_inputs(values, inputs.tables), wanted);
  const auto of_runs = tables_of_runs(tables, identities_of(inputs.runs));
  refuse_too_large(info, values, inputs.runs, s);
  std::vector<RunOfPage> runs;
  for (std::size_t k = 0; k < inputs.runs.size(); ++k) {
    runs.push_back(run_of_page(info, values, inputs.runs[k], of_runs[k], s, command));
    runs[k].content["commands"] =
        commands_of(inputs.runs[k], of_runs[k], s, inputs.runs.size() == 1 ? 0 : k + 1);
  }

  Json content{{"program", program_line(info).second},
               {"command", printable(command)},
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
  if (!s.frames.output.path.empty() && !s.frames.json)
    say_next("xdg-open " + shell_word(s.frames.output.path), s.frames.quiet);
}

}  // namespace

int write_explore_page(int argc, char** argv, const ToolInfo& info, PageTab tab)
{
  ExploreSettings settings;
  po::options_description options("Options");
  settings.add_to(options);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    write_page(info, values, settings, tab, command_line(argc, argv));
  });
}

}  // namespace grseg
