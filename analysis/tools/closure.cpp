// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/closure.hpp"

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/segregation/closure_points.hpp"
#include "analysis/segregation/named_numbers.hpp"
#include "analysis/segregation/prediction.hpp"
#include "analysis/tools/tool_main.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-closure",
    "coefficients of Gray & Thornton's closure from fluxes: B/c, d/c, and c under each rule.",
    "grseg-closure a.segregation.tsv a.stress.tsv ... [options] > closure.tsv",
    "  grseg-closure *.segregation.tsv *.stress.tsv --heights 4dS:56dS --begin 10\n"
    "  grseg-closure *.segregation.tsv *.stress.tsv --partition size,half --instruments same\n"
    "  grseg-closure a.segregation.tsv a.stress.tsv --predict b.segregation.tsv   phi_L(y, t) of b\n"};

const WantedTables wanted{
    {"", "grseg-segregation", "grseg-stress", "grseg-merge"},
    "name a table of grseg-segregation (without --summary) and one of grseg-stress for each run",
    "--predict"};

struct Settings {
  ClosureFilter filter;
  std::vector<std::string> partition;
  std::string instruments = "previous";
  std::vector<std::string> predict;
  OutputOptions profiles;
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
  add("predict", po::value(&s.predict)->multitoken()->value_name("FILES"),
      "tables of grseg-segregation of other runs: predict them from their first window by the fitted "
      "flux, and by Trewhela, Ancey & Gray (2021); put this option last");
  add("profiles", po::value(&s.profiles.path)->value_name("FILE"),
      "write the predicted and measured phi_L to this table");
  s.filter.add_layers_to(options);
  s.filter.add_times_to(options);
  add("json", po::bool_switch(&s.json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&s.quiet), "no remarks");
  s.output.add_to(options);
  return options;
}

/// Throws UsageError for impossible option values, before any table is read.
void check(Settings& s, const po::variables_map& values)
{
  s.output.check(values);
  s.profiles.overwrite = s.output.overwrite;
  if (!s.profiles.path.empty()) {
    if (s.predict.empty()) throw UsageError("--profiles needs --predict and the runs to predict");
    if (s.profiles.path == s.output.path)
      throw UsageError("--profiles and --output name the same file; name two");
    s.profiles.check(values);
  }
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

/// Adds the predictions of other runs to `summary`, and writes their profiles.
void predict_runs(const Settings& s, const std::vector<Table>& fitted, const ClosureData& data,
                  const Header& header, NamedNumbers& summary)
{
  std::vector<Table> tables;
  for (const auto& path : s.predict) tables.push_back(Table::read(path));
  refuse_fitted_runs(tables, fitted);
  const auto coefficients = flux_coefficients(data);
  const auto predictions =
      listed(tables, [&](const Table& table) { return predict(table, coefficients, s.filter); });
  add_predictions(summary, predictions, [&](double value, const std::array<double, 2>& slopes) {
    return estimate_from_flux(data, value, slopes);
  });
  if (s.profiles.path.empty()) return;
  auto profiles = prediction_table(predictions);
  profiles.header = header;
  for (const auto& table : tables) profiles.header.emplace_back("predicted", table.name);
  write_whole(s.profiles, profiles.to_text());
}

void close(Settings& s, const po::variables_map& values, const std::string& command)
{
  check(s, values);
  if (s.partition.empty()) s.partition = {"stock"};
  const auto rules = parse_rules(s.partition);
  s.filter.instruments = choose(s.instruments, "--instruments", instrument_choices);
  const auto tables = read_tables(values, wanted);
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
                               {"over", closure_population(data.runs.size())}});
  add_all(header, s.filter.lines());
  header.emplace_back("interval", "95 %");
  auto summary = closure_summary(data, rules);
  if (!s.predict.empty()) predict_runs(s, tables, data, header, summary);
  write_numbers(summary, header, info, s.output, s.json, s.quiet);
}

}  // namespace

int main(int argc, char** argv)
{
  return tool_main(argc, argv, info, options_into, close);
}
