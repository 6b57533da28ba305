// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/closure.hpp"

#include "analysis/frames/layer_key.hpp"
#include "analysis/segregation/closure_points.hpp"
#include "analysis/segregation/named_numbers.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-closure",
    "coefficients of Gray & Thornton's closure from fluxes: B/c, d/c, and c under each rule.",
    "grseg-closure a.segregation.tsv a.stress.tsv ... [options] > closure.tsv",
    "  grseg-closure *.segregation.tsv *.stress.tsv --heights 4dS:56dS --begin 10\n"
    "  grseg-closure *.segregation.tsv *.stress.tsv --partition size,half --instruments same\n"};

struct Settings {
  ClosureFilter filter;
  std::vector<std::string> partition;
  std::string instruments = "previous";
  int bootstrap = 1000;
  long seed = 1;
  TableOptions output;
  bool json = false, quiet = false;
};

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  auto add = options.add_options();
  const auto rules =
      "partition rules for which c is printed: " + list_of_rules() + ", or stock (default)";
  add("partition", words_option(s.partition, words_of_rules()), rules.c_str());
  const auto instruments =
      "instrumental variables of the regression: " + list_of(instrument_choices);
  add("instruments", word_option(&s.instruments, words_of(instrument_choices)),
      instruments.c_str());
  add("bootstrap", po::value(&s.bootstrap)->default_value(s.bootstrap)->value_name("N"),
      "samples for the 95 % intervals; 0: no intervals");
  add("seed", po::value(&s.seed)->default_value(s.seed)->value_name("N"), "seed of the samples");
  s.filter.add_layers_to(options);
  s.filter.add_times_to(options);
  add("json", po::bool_switch(&s.json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&s.quiet), "no remarks");
  s.output.add_to(options);
  return options;
}

/// Throws UsageError for impossible option values, before any table is read.
void check(const Settings& s, const po::variables_map& values)
{
  if (s.bootstrap != 0 && (s.bootstrap < 100 || s.bootstrap > 100000))
    throw UsageError(fmt::format("--bootstrap {}: it must be 0 or 100 to 100000", s.bootstrap));
  if (s.seed < 0) throw UsageError("--seed must not be negative");
  s.output.check(values);
  s.filter.check();
}

std::string text_of_times(const RowFilter& filter)
{
  const auto text = [](double time) {
    return std::isfinite(time) ? fmt::format("{:g}", time) : "";
  };
  const auto times = fmt::format("{}:{}", text(filter.begin), text(filter.end));
  return times == ":" ? "all" : times;
}

void close(Settings& s, const po::variables_map& values, const std::string& command)
{
  check(s, values);
  if (s.partition.empty()) s.partition = {"stock"};
  const auto rules = parse_rules(s.partition);
  s.filter.instruments = choose(s.instruments, "--instruments", instrument_choices);
  const auto tables = read_tables(values);
  if (tables.empty())
    throw UsageError(
        "no table given; name a table of grseg-segregation and one of grseg-stress for each run");
  const auto data = read_closure(tables, rules, s.filter);
  auto header = provenance_of(tables, info, "", command);
  if (!data.doubt.empty()) header.emplace_back("doubt", data.doubt);
  header.insert(header.end(), {{"closure", "q_L = (B/c) driving - (d/c) gradient"},
                               {"partition", names_of(rules)},
                               {"instruments", s.instruments},
                               {"times", text_of_times(s.filter)},
                               {"rows", fmt::format("{} of {}", data.points.size(), data.rows)},
                               {"runs", fmt::format("{}", data.runs.size())},
                               {"windows", fmt::format("{}", number_of_windows(data.runs))},
                               {"over", closure_population(data.runs.size())},
                               {"bootstrap", fmt::format("{}", s.bootstrap)},
                               {"seed", fmt::format("{}", s.seed)}});
  add_all(header, s.filter.lines());
  header.emplace_back("interval", "95 %");
  const auto summary = closure_summary(
      data, rules, {static_cast<std::size_t>(s.bootstrap), static_cast<unsigned long>(s.seed)});
  write_numbers(summary, header, info, s.output, s.json, s.quiet);
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main(argc, argv, info, options_into, close);
}
