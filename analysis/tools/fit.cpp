// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/fit_report.hpp"
#include "analysis/fit/mixtures.hpp"
#include "analysis/fit/over.hpp"
#include "analysis/fit/partition_scan.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/fit/short_table.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/presets.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/cli/input_tables.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-fit", "the segregation strength B, with its interval, from tables of sums.",
    "grseg-fit sums.tsv ... | - [options]",
    "  grseg-fit sums.tsv                               B by size, the default\n"
    "  grseg-fit sums.tsv --partition stock             B by the rules of published codes\n"
    "  grseg-fit sums.tsv --short -o fit.tsv            a table to read, and all columns in a file\n"
    "  grseg-fit a.tsv b.tsv --partition size,half      several runs, several rules\n"
    "  grseg-fit phi*/*.tsv                             B of each mixture, then of all\n"
    "  grseg-fit phi*/*.tsv --over equal-mixtures       one number, each mixture counting the same\n"
    "  grseg-fit sums.tsv --scan 0.4:0.9:0.005          B over the large grains' share\n"
    "  grseg-fit kinetic.tsv --quantity kinetic         B of the kinetic stress\n"
    "  grseg-stress run.h5 | grseg-fit - --json         without a file in between\n",
    presets::fit};

struct Settings {
  std::vector<std::string> partition;
  std::string component, quantity, base, scan, ratio_range, pair, over, mixtures;
  OutputOptions output;
  int bootstrap = 0;
  long seed = 0;
  bool json = false, quiet = false, short_form = false, exponent = false;
  FitFilters filters;
};

std::string rules_help()
{
  std::string text = "the large grain's share of a mixed contact; several rules give a row each.";
  for (const auto& rule : rule_definitions())
    text += fmt::format("\n{}{}{}{}: {}{}", rule.word, *rule.number == '\0' ? "" : ":", rule.number,
                        rule.kind == PartitionRule{}.kind ? " (default)" : "", rule.meaning,
                        *rule.used_by == '\0' ? "" : fmt::format(" [{}]", rule.used_by));
  text += "\nstock:";
  for (const auto& rule : parse_rules({"stock"})) text += fmt::format(" {}", rule.name());
  return text;
}

po::options_description options_into(Settings& s)
{
  po::options_description options("Options");
  const auto text = [](std::string& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  const auto number = [](auto& place, const char* name) {
    return po::value(&place)->value_name(name);
  };
  auto add = options.add_options();
  add("partition", po::value(&s.partition)->composing()->value_name("RULE,..."),
      rules_help().c_str());
  add("component", text(s.component, "NAME")->default_value("yy"), list_of(components).c_str());
  add("quantity", text(s.quantity, "NAME")->default_value("contact"),
      (list_of(quantities) + " stress").c_str());
  add("base", text(s.base, "NAME"),
      ("part of contacts with base and walls: " + list_of(base_parts) +
       " (default: as in the table)")
          .c_str());
  add("pair", text(s.pair, "A,B"), "two of the species, by name or number (default: all pairs)");
  add("exponent", po::bool_switch(&s.exponent),
      "also a of sigma^nu/sigma = phi^nu s^a/sum(phi s^a), s the diameters; of more than two "
      "species always");
  add("scan", text(s.scan, "p0:p1:dp"), "print B over the share p instead of the rules");
  add("over", text(s.over, "NAME"),
      ("what intervals are over, in one row per rule: " + list_of(overs) +
       " (default: windows of one run, runs of one mixture; of several mixtures a row of each over "
       "its runs, then one of all over mixtures)")
          .c_str());
  add("mixtures", text(s.mixtures, "N,N,...")->default_value("auto"),
      "how many of the tables, in their order, are runs of each mixture; auto: those that agree in "
      "what they record of the flow and in overall composition");
  add("bootstrap", number(s.bootstrap, "N")->default_value(1000),
      "samples for the 95 % intervals; 0: no intervals");
  add("seed", number(s.seed, "N")->default_value(1), "seed of the samples");
  add("ratio-range", text(s.ratio_range, "a:b")->default_value("0.01:100"),
      "phi_S/phi_L of the layers that take part");
  add("heights", text(s.filters.heights, "y0:y1"),
      "layers that take part lie between, e.g. 4dS:56dS or 4dS: (default: all)");
  add("min-solid", number(s.filters.min_solid, "X")->default_value(0.5, "0.5"),
      "least solid fraction of a layer, in units of the run's median");
  add("min-grains", number(s.filters.min_grains, "N")->default_value(0),
      "least grains of the rarer species in a layer, mean over the window; 0: off, because choosing "
      "by a number that fluctuates is a bias of its own (B_sums needs no such choice)");
  add("begin", number(s.filters.begin, "s"), "first time of the windows that take part");
  add("end", number(s.filters.end, "s"), "last time of the windows that take part");
  add("short", po::bool_switch(&s.short_form),
      "print a short table for reading, as on a terminal; with -o beside the whole one in FILE");
  add("json", po::bool_switch(&s.json), "print JSON instead of a table");
  add("quiet", po::bool_switch(&s.quiet), "no remarks on standard error");
  s.output.add_to(options,
                  "write the whole table there; -: to standard output, even on a terminal");
  return options;
}

void parse_ratio_range(const std::string& text, FitFilters& filters)
{
  int used = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%n", &filters.ratio_low, &filters.ratio_high, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() ||
      !(filters.ratio_low > 0 && filters.ratio_low <= filters.ratio_high))
    throw UsageError(
        fmt::format("--ratio-range {}: write low:high, 0 < low <= high, e.g. 0.01:100", text));
}

/// Refuses what cannot be meant, before any table is read.
void check(const Settings& s, const po::variables_map& values)
{
  if (!values.contains("input"))
    throw UsageError("no table given; name tables of grseg-stress, or - for standard input");
  if (s.bootstrap != 0 && (s.bootstrap < 100 || s.bootstrap > 100000))
    throw UsageError(fmt::format("--bootstrap {}: 0, or 100 to 100000 samples", s.bootstrap));
  if (s.seed < 0) throw UsageError("--seed must not be negative");
  s.output.check(values);
  if (std::isnan(s.filters.begin) || std::isnan(s.filters.end))
    throw UsageError("--begin and --end are times in seconds");
  if (!(s.filters.min_solid >= 0)) throw UsageError("--min-solid must not be negative");
  if (!(s.filters.min_grains >= 0)) throw UsageError("--min-grains must not be negative");
  if (s.json && s.short_form) throw UsageError("--short and --json exclude each other");
  if (!s.over.empty()) choose(s.over, "--over", overs);
  parse_rules(s.partition);
  parse_heights(s.filters.heights, {1, 1});
  if (!s.scan.empty()) parse_scan(s.scan);
  if (s.quantity == "kinetic")
    for (const char* option : {"partition", "scan", "base"})
      if (values.contains(option) && !values[option].defaulted())
        throw UsageError(
            fmt::format("--{} concerns contacts; leave it out with --quantity kinetic", option));
}

std::vector<PartitionRule> rules_of(const Settings& s, const Table& first)
{
  if (s.quantity == "kinetic") return {PartitionRule{}};
  if (!s.partition.empty()) return parse_rules(s.partition);
  return {parse_rule(header_or(first, "partition", "size"))};
}

/// Prints on standard error what a reader of the numbers should know; `with_doubts`: unless they
/// are part of what is printed.
void remark(const std::vector<Table>& tables, const FitReport& report, bool with_doubts)
{
  for (const char* key : {"assign", "width", "layer", "window", "base", "partition", "step", "mean",
                          "velocity", "composition", "volume", "origin"})
    for (const auto& table : tables)
      if (header_or(table, key, "") != header_or(tables[0], key, ""))
        std::cerr << fmt::format("{}: {} and {} differ in '{}'\n", info.name,
                                 printable(tables[0].name), printable(table.name), key);
  if (!with_doubts) return;
  for (const auto& doubt : doubts(report)) std::cerr << fmt::format("{}: {}\n", info.name, doubt);
}

/// RunError, saying why, where there is no number to print.
void require_numbers(const FitReport& report)
{
  const auto has_number = [](const RuleFit& fit) {
    return std::isfinite(fit.value.slope) || std::isfinite(fit.value.B_direct);
  };
  const auto& fits = report.scan ? report.scan->fits : report.rules;
  if (std::none_of(fits.begin(), fits.end(), has_number))
    throw RunError(fmt::format("{}: {}", rule_name(report, fits[0]), fits[0].doubt));
}

/// On a terminal, 17 digits of 48 columns are of no use.
bool prints_short(const Settings& s)
{
  return s.short_form || (s.output.path.empty() && !s.json && isatty(STDOUT_FILENO) == 1);
}

void add_for_short_table(FitReport& report, const FitData& data, const FitSettings& settings,
                         const Bootstrap& bootstrap)
{
  report.number_of_runs = data.runs.size();
  report.number_of_windows = bootstrap.windows();
  if (settings.over == Over::equal_mixtures || settings.over == Over::random_mixtures) return;
  if (report.quantity == Quantity::contact && !report.scan && !report.names_pairs())
    report.zero = find_zero_of_b(data, {0, 1, 0.05}, settings, bootstrap);
}

/// UsageError where the species of the tables do not make a pair, or too many for a scan.
std::vector<SpeciesPair> pairs_of(const Settings& s, const SpeciesList& species)
{
  if (species.size() < 2)
    throw UsageError(
        "the tables have one species, and B compares two; make them with --classes or --edges");
  if (!s.scan.empty() && species.size() > 2)
    throw UsageError(
        "--scan: p* is that of two species; merge the others with grseg-stress --group");
  if (!s.pair.empty()) return {parse_pair(s.pair, species)};
  return all_pairs(species.size());
}

/// Where the numbers of grains come from.
std::string grains_words(const std::vector<FitTable>& tables, const FitData& data)
{
  if (data.count.uncounted > 0)
    return fmt::format(
        "unknown in {} of the rows used, whose tables give masses without counts; --min-grains does "
        "not apply to them",
        data.count.uncounted);
  const bool counted = std::all_of(tables.begin(), tables.end(), [](const FitTable& table) {
    return table.table->has_column(fmt::format("grains_{}", column_words(table.species)[0]));
  });
  return counted ? "as counted" : "areas or volumes over those of a grain of nominal diameter";
}

/// UsageError where the runs and mixtures at hand cannot be the population asked for.
void require_population(const Settings& s, const FitData& data)
{
  if (s.over.empty()) return;
  const auto over = choose(s.over, "--over", overs);
  const auto mixtures = data.number_of_mixtures();
  if (over == Over::runs && mixtures > 1)
    throw UsageError(
        fmt::format("--over runs: the tables hold runs of {} mixtures; without --over each has its "
                    "own interval, --over mixtures gives one number for all, and --mixtures tells "
                    "which tables belong together",
                    mixtures));
  if ((over == Over::runs || over == Over::compositions) && data.runs.size() < 2)
    throw UsageError(fmt::format(
        "--over {}: there is one run; give the tables of several, or --over windows", s.over));
  const bool of_mixtures =
      over == Over::mixtures || over == Over::equal_mixtures || over == Over::random_mixtures;
  if (of_mixtures && mixtures < 2)
    throw UsageError(fmt::format(
        "--over {}: all tables are of one mixture; leave the option out, or tell with --mixtures "
        "which tables belong together",
        s.over));
  if (!s.scan.empty() && (over == Over::equal_mixtures || over == Over::random_mixtures))
    throw UsageError(
        fmt::format("--scan: B(p) has no intervals over {}; choose --over mixtures or windows, or "
                    "scan each mixture by itself",
                    s.over));
}

/// What the rows' intervals are over: "runs", or "runs, then mixtures" of mixtures one by one.
std::string over_words(const FitReport& report)
{
  const auto of = [](const RuleFit& fit) { return std::string(word_of(fit.over, overs)); };
  const auto& rows = report.scan ? report.scan->fits : report.rules;
  return rows.front().mixture ? of(rows.front()) + ", then " + of(rows.back()) : of(rows.back());
}

/// The lines that say how the fit was made.
Header header_of(const Settings& s, const std::string& preset, const std::vector<Table>& tables,
                 const FitReport& report, const FitData& data, const std::string& grains)
{
  return {
      program_line(info),
      {"preset", preset},
      {"quantity", s.quantity},
      {"component", s.component},
      {"ratio_range", s.ratio_range},
      {"heights", s.filters.heights.empty() ? "all" : s.filters.heights},
      {"times",
       s.filters.all_times() ? "all" : fmt::format("{:g}:{:g}", s.filters.begin, s.filters.end)},
      {"min_solid", format_number(s.filters.min_solid)},
      {"min_grains", format_number(s.filters.min_grains)},
      {"grains", grains},
      {"rows", data.count.sentence()},
      {"runs", fmt::format("{}", data.runs.size())},
      {"windows", fmt::format("{}", number_of_windows(data.runs))},
      {"bootstrap", fmt::format("{}", s.bootstrap)},
      {"seed", fmt::format("{}", s.seed)},
      {"interval", "95 %"},
      {"over", over_words(report)},
      {"mixtures", grouping_words(s.mixtures, tables)}};
}

PartitionScan scan(const FitData& data, const ScanRange& range, const FitSettings& settings,
                   const Bootstrap& bootstrap, bool quiet)
{
  const auto shares = static_cast<double>(range.shares().size());
  ProgressBar progress(info.name, {.things = "shares", .total = shares}, quiet);
  return scan_partition(data, range, settings, bootstrap,
                        [&](double done) { progress.show(done); });
}

FitReport make_report(const Settings& s, const std::string& preset,
                      const std::vector<Table>& tables)
{
  const auto base = s.base.empty() ? header_or(tables[0], "base", "contact-point") : s.base;
  FitReport report;
  report.quantity = choose(s.quantity, "--quantity", quantities);
  report.component = choose(s.component, "--component", components);
  const FitSettings settings{report.component, choose(base, "--base", base_parts),
                             s.over.empty() ? Over::automatic : choose(s.over, "--over", overs)};
  const auto rules = rules_of(s, tables[0]);
  auto read = rules;
  if (!s.scan.empty()) read.push_back({PartitionRule::Kind::uniform});
  auto all = read_fit_tables(tables, report.quantity, read);
  report.mixtures = find_mixtures(all, s.mixtures);
  for (const auto& table : tables) report.table_names.push_back(table.name);
  report.species = all.front().species;
  const auto pairs = pairs_of(s, report.species);
  const auto data = select_fit_data(all, report.quantity, s.filters, pairs);
  require_population(s, data);
  report.shares = weight_shares(data, report.mixtures.size());
  const Resampling resampling{static_cast<std::size_t>(s.bootstrap),
                              static_cast<unsigned long>(s.seed)};
  const Bootstrap bootstrap(data.runs, resampling.samples, resampling.seed);
  report.rules = fit_pairs(all, report.quantity, s.filters, pairs, rules, settings, resampling,
                           s.exponent || report.names_pairs());
  if (!s.scan.empty()) report.scan = scan(data, parse_scan(s.scan), settings, bootstrap, s.quiet);
  if (prints_short(s)) add_for_short_table(report, data, settings, bootstrap);

  report.header = header_of(s, preset, tables, report, data, grains_words(all, data));
  if (report.quantity == Quantity::contact) report.header.emplace_back("base", base);
  if (names_species(report.species))
    report.header.emplace_back("species", species_text(report.species));
  report.inputs = header_values(tables, "input");
  report.trust = trust_of(tables);
  report.history = header_values(tables, "history");
  return report;
}

}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  const auto options = options_into(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    check(settings, values);
    parse_ratio_range(settings.ratio_range, settings.filters);
    const auto tables = read_tables(info, values, settings.quiet);
    auto report = make_report(settings, preset_of(values), tables);
    report.history.push_back(command_line(argc, argv));
    require_numbers(report);
    const bool brief = prints_short(settings);
    if (!settings.quiet) remark(tables, report, !brief);
    if (!brief || !settings.output.path.empty())
      write_whole(settings.output, settings.json ? to_json(report) : to_tsv(report));
    if (brief) std::cout << short_table(report);
  });
}
