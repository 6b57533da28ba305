// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"

#include "formats/cli/provenance.hpp"
#include "formats/cli/readable_table.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <set>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// Names of a flow's tables; "-" for a table without a known name.
std::vector<std::string> tables_of(const FitReport& report, const Flow& flow)
{
  return listed(flow.tables, [&](std::size_t table) -> std::string {
    return table < report.table_names.size() ? printable(report.table_names[table]) : "-";
  });
}

std::string pair_name(const FitReport& report, const RuleFit& fit)
{
  if (report.species.empty()) return "S+L";
  return report.species[fit.pair.smaller].name + '+' + report.species[fit.pair.larger].name;
}

/// Name of the row's flow; "all" if the row is about all of several flows.
std::string flow_name(const FitReport& report, const RuleFit& fit)
{
  if (fit.flow) return report.flows[*fit.flow].name;
  return report.flows.size() == 1 ? report.flows.front().name : "all";
}

/// The rule, with the pair of species if there are more than two species, and the flow if each flow
/// has its own rows.
std::string row_name(const FitReport& report, const RuleFit& fit)
{
  auto name = rule_name(report, fit);
  if (report.names_pairs()) name += " " + pair_name(report, fit);
  if (report.is_by_flow()) name += ", " + flow_name(report, fit);
  return name;
}

/// Weight of a flow in words: "3.1 % of the weight".
std::string share_words(const FitReport& report, std::size_t flow)
{
  if (flow >= report.shares.size()) return "weight unknown";
  return fmt::format("{:.3g} % of the weight", 100 * report.shares[flow]);
}

/// True if the short table has rows of B over each population, for all flows together.
bool shows_all_populations(const FitReport& report)
{
  return report.shares.size() > 1;
}

/// Header line of flow m: "Phi_L = 0.06, 4 tables, 3.1 % of the weight: a.tsv b.tsv".
std::string flow_line(const FitReport& report, std::size_t m)
{
  const auto& flow = report.flows[m];
  return fmt::format("{}, {}, {}: {}", flow.name, counted(flow.tables.size(), "table"),
                     share_words(report, m), fmt::join(tables_of(report, flow), " "));
}

Header header_of(const FitReport& report)
{
  Header lines = report.header;
  for (const auto& input : report.inputs) lines.emplace_back("input", input);
  add_all(lines, report.trust);
  for (const auto& line : report.history) lines.emplace_back("history", line);
  for (std::size_t m = 0; m < report.flows.size(); ++m)
    lines.emplace_back("flow", flow_line(report, m));
  if (!report.other_names.empty())
    lines.emplace_back("minus", fmt::format("{}", fmt::join(report.other_names, " ")));
  for (const auto& names : report.shared_runs)
    lines.emplace_back("one run", fmt::format("{}", fmt::join(names, " ")));
  for (const auto& [over, words] : estimands(report))
    lines.emplace_back("estimand", fmt::format("{}: {}", word_of(over, populations), words));
  for (const auto& sentence : report.verdict) lines.emplace_back("verdict", sentence);
  for (const auto& doubt : doubts(report)) lines.emplace_back("doubt", doubt);
  return lines;
}

/// Appends the rows of one fit to `rows`.
void add_numbers(const FitReport& report, const RuleFit& fit, bool of_first_rule,
                 std::vector<NumberRow>& rows)
{
  auto rule = rule_name(report, fit);
  const auto add = [&](const std::string& quantity, const Estimate& number,
                       Population over = Population::automatic, double degrees = no_number) {
    if (!std::isfinite(number.value)) return;
    const bool has_interval = std::isfinite(number.low);
    rows.push_back({.rule = rule,
                    .flow = flow_name(report, fit),
                    .pair = pair_name(report, fit),
                    .quantity = quantity,
                    .over = has_interval ? word_of(over, populations) : "-",
                    .of_flow = fit.flow,
                    .number = number,
                    .degrees = has_interval ? degrees : no_number});
  };
  const auto add_measured = [&](const char* quantity, const Measured& measured) {
    add(quantity, measured.estimate(), fit.over, measured.error.degrees);
  };
  if (fit.rule.adds_up()) {
    add("B", fit.estimate(&Estimators::B), fit.over, fit.degrees);
    for (const auto& [word, population, meaning] : populations)
      if (population != fit.over) add("B", fit.at(population), population);
  }
  add("share", {fit.share});
  add("neutral", {fit.neutral});
  add("B_of_thickness", {fit.of_thickness});
  add_measured("B_minus_size", fit.minus_size);
  add_measured("B_minus_other", fit.minus_other);
  if (fit.size_exponent) add("size_exponent", *fit.size_exponent, fit.over);
  for (const auto& [name, place] : estimator_columns)
    if (report.with_paper && std::string(name).starts_with("paper_"))
      add(name, fit.estimate(place), fit.over);
  if (!of_first_rule) return;
  rule = "-";
  // Phi_L of several flows together is unknown: tables do not include the sizes of the beds.
  if (fit.flow || report.flows.size() == 1)
    add("Phi_L", {report.flows[fit.flow.value_or(0)].phi_large()});
  add("weight_share", {fit.flow ? report.shares[*fit.flow] : 1});
  add("runs", {static_cast<double>(fit.runs)});
  add("points", {static_cast<double>(fit.points)});
  add_measured("p_zero", fit.line.p_zero);
  add_measured("dB_dp", fit.line.dB_dp);
}

/// Words of a row, each with the name of its column; next function: its numbers.
std::vector<std::pair<const char*, std::string>> words_in(const FitReport& report,
                                                          const NumberRow& row)
{
  return {{"rule", row.rule},         {"flow", row.flow},
          {"pair", row.pair},         {"component", word_of(report.component, components)},
          {"quantity", row.quantity}, {"over", row.over}};
}
std::vector<Cell> numbers_in(const NumberRow& row)
{
  return {{"value", row.number.value},
          {"low", row.number.low},
          {"high", row.number.high},
          {"degrees_of_freedom", row.degrees}};
}

/// Table with a row per number. The last columns are settings in which flows differ, with the
/// values of the row's flow; nan in rows of all flows together.
std::string rule_table(const FitReport& report)
{
  std::vector<std::string> columns;
  for (const auto& [column, word] : words_in(report, {})) columns.emplace_back(column);
  add_all(columns, columns_of(numbers_in({})));
  const auto settings =
      report.flows.empty() ? decltype(Flow::settings){} : report.flows.front().settings;
  for (const auto& [name, value] : settings) columns.push_back(name);
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : number_rows(report)) {
    auto& cells = rows.emplace_back();
    for (const auto& [column, word] : words_in(report, row)) cells.push_back(word);
    add_all(cells, listed(values_of(numbers_in(row)), format_number));
    for (std::size_t k = 0; k < settings.size(); ++k)
      cells.push_back(row.of_flow ? report.flows[*row.of_flow].settings[k].second : "nan");
  }
  return table_text(header_of(report), columns, rows);
}

std::string scan_table(const FitReport& report)
{
  const auto& scan = *report.scan;
  Table table;
  table.header = header_of(report);
  for (const auto& [key, measured] :
       {std::pair<std::string, Measured>{"p_zero", scan.line.p_zero}, {"dB_dp", scan.line.dB_dp}}) {
    const auto number = measured.estimate();
    for (const auto& [end, value] :
         {std::pair{"", number.value}, {"_low", number.low}, {"_high", number.high}})
      table.header.emplace_back(key + end, format_number(value));
  }
  table.columns = {"p", "B", "low", "high", "neutral"};
  for (const auto& fit : scan.fits)
    table.rows.push_back({fit.rule.value, fit.value.B, fit.low.B, fit.high.B, fit.neutral});
  return table.to_text();
}

std::string series_table(const FitReport& report)
{
  Table table;
  table.header = header_of(report);
  table.columns = columns_of(report.series.front());
  for (const auto& row : report.series) table.rows.push_back(values_of(row));
  return table.to_text();
}

Json row_object(const FitReport& report, const NumberRow& row)
{
  Json object;
  for (const auto& [column, word] : words_in(report, row)) object[column] = word;
  for (const auto& [column, number] : numbers_in(row)) object[column] = number;
  if (row.of_flow)
    for (const auto& [name, value] : report.flows[*row.of_flow].settings) {
      const auto number = parse_number(value);
      object[name] = number ? Json(*number) : Json(value);
    }
  return object;
}

}  // namespace

std::vector<NumberRow> number_rows(const FitReport& report)
{
  std::vector<NumberRow> rows;
  const auto first = report.rules.empty() ? "" : rule_name(report, report.rules.front());
  for (const auto& fit : report.rules)
    add_numbers(report, fit, rule_name(report, fit) == first, rows);
  return rows;
}

std::string rule_name(const FitReport& report, const RuleFit& fit)
{
  return report.quantity == Quantity::kinetic ? "kinetic" : fit.rule.name();
}

std::vector<std::pair<Population, std::string>> estimands(const FitReport& report, bool all)
{
  std::set<Population> used;
  for (const auto& fit : report.rules) {
    used.insert(fit.over);
    for (const auto& [word, population, meaning] : populations)
      if (all && std::isfinite(fit.at(population).low)) used.insert(population);
  }
  if (report.scan) used = {report.scan->fits.front().over};
  const auto flows = static_cast<std::size_t>(
      std::ranges::count_if(report.shares, [](double share) { return share > 0; }));
  return listed(used, [&](Population over) {
    return std::pair(
        over, over == Population::windows && report.changes
                  ? "B of these runs over these times alone, since the flow changes; from the "
                    "scatter of windows inside runs"
                  : estimand_words(over, flows));
  });
}

namespace {

/// Warnings about p*, which is the same for every rule, of each flow and of all flows.
std::vector<std::string> doubts_of_zeros(const FitReport& report)
{
  std::vector<std::string> all;
  const auto first = report.rules.empty() ? "" : rule_name(report, report.rules.front());
  for (const auto& fit : report.rules) {
    const auto doubt = doubt_of_zero(fit.line.p_zero.estimate());
    if (rule_name(report, fit) != first || doubt.empty()) continue;
    all.push_back(report.is_by_flow() ? flow_name(report, fit) + ": " + doubt : doubt);
  }
  return all;
}

}  // namespace

std::vector<std::string> doubts(const FitReport& report)
{
  Header of_fits;  // each doubt with the names of its fits
  const auto add = [&](const std::string& name, const std::string& doubt) {
    const auto same = std::ranges::find(of_fits, doubt, &HeaderLine::first);
    if (same != of_fits.end())
      same->second += ", " + name;
    else if (!doubt.empty())
      of_fits.emplace_back(doubt, name);
  };
  for (const auto& fit : report.rules) add(row_name(report, fit), fit.doubt);
  if (report.scan) add("scan", report.scan->fits.front().doubt);
  auto all = report.doubts_of_tables;
  for (const auto& [doubt, names] : of_fits) all.push_back(fmt::format("{}: {}", names, doubt));
  return add_all(all, doubts_of_zeros(report));
}

std::string to_tsv(const FitReport& report)
{
  if (!report.series.empty()) return series_table(report);
  return report.scan ? scan_table(report) : rule_table(report);
}

std::string to_json(const FitReport& report)
{
  Json all;
  all["numbers"] =
      listed(number_rows(report), [&](const NumberRow& row) { return row_object(report, row); });
  if (report.scan)
    all["scan"] = listed(report.scan->fits, [](const RuleFit& fit) {
      return std::array{fit.rule.value, fit.value.B, fit.low.B, fit.high.B};
    });
  for (const auto& [key, value] : report.header) all["settings"][key] = value;
  all["flows"] = Json::array();
  for (std::size_t m = 0; m < report.flows.size(); ++m)
    all["flows"].push_back({{"name", report.flows[m].name},
                            {"Phi_L", report.flows[m].phi_large()},
                            {"weight_share", report.shares[m]},
                            {"tables", tables_of(report, report.flows[m])}});
  if (!report.other_names.empty()) all["minus"] = report.other_names;
  if (!report.shared_runs.empty()) all["one_run"] = report.shared_runs;
  for (const auto& [over, words] : estimands(report))
    all["estimands"][word_of(over, populations)] = words;
  all["inputs"] = report.inputs;
  for (const auto& [key, value] : report.trust) all[key].push_back(value);
  all["history"] = listed(report.history, [](const auto& line) { return printable(line); });
  all["verdict"] = report.verdict;
  all["doubts"] = doubts(report);
  return all.dump(2) + '\n';
}

namespace {

std::string rounded(const FitReport& report, double value)
{
  if (!std::isfinite(value)) return "-";
  if (report.digits > 0) return fmt::format("{:.{}g}", value, report.digits);
  const auto text = fmt::format("{:.3f}", value);
  return text == "-0.000" ? "0.000" : text;
}

/// Names of programs that use this rule, shortened if long; "-" if none is known.
std::string used_by(const FitReport& report, const RuleFit& fit)
{
  constexpr std::size_t most = 44;  // characters, so that the table fits into 100 columns
  const std::string codes = report.quantity == Quantity::kinetic ? "" : fit.rule.used_by();
  if (codes.empty()) return "-";
  return codes.size() <= most ? codes : codes.substr(0, codes.rfind(' ', most - 4)) + " ...";
}

using Line = std::vector<std::string>;  // cells of a row; all rows have the same number

/// Aligned table with words in the first and last column, and numbers between them.
std::string with_words_outside(const std::vector<Line>& lines)
{
  const auto last = lines.front().size() - 1;
  return aligned(lines, [last](std::size_t c) { return c == 0 || c == last; });
}

std::string b_text(const FitReport& report, const Estimate& b)
{
  return std::isfinite(b.low) ? fmt::format("{} [{}, {}]", rounded(report, b.value),
                                            rounded(report, b.low), rounded(report, b.high))
                              : rounded(report, b.value);
}

std::string rules_text(const FitReport& report)
{
  std::vector<Line> lines{
      {report.is_by_flow() ? "rule, flow" : "rule", "B [95 %]", "share", "used by"}};
  for (const auto& fit : report.rules)
    lines.push_back({row_name(report, fit), b_text(report, fit.estimate(&Estimators::B)),
                     rounded(report, fit.share), used_by(report, fit)});
  return with_words_outside(lines);
}

/// B minus B of another reading of the same runs.
std::string differences_text(const FitReport& report)
{
  if (report.other_names.empty()) return "";
  std::vector<Line> lines{{"same windows", "B minus B of the other tables [95 %]"}};
  for (const auto& fit : report.rules)
    if (std::isfinite(fit.minus_other.value))
      lines.push_back({row_name(report, fit), b_text(report, fit.minus_other.estimate())});
  return '\n' + aligned(lines, [](std::size_t c) { return c == 0; });
}

/// Coefficients of the fits of Staron & Phillips (2015): sigma^S/sigma^L = s phi_S/phi_L, and
/// sigma^S/sigma^L = k (phi_S/phi_L)^a.
std::string paper_text(const FitReport& report)
{
  if (!report.with_paper) return "";
  std::vector<Line> lines{
      {"as the paper fits", "s [95 %]", "B of s [95 %]", "k [95 %]", "a [95 %]"}};
  for (const auto& fit : report.rules) {
    auto& line = lines.emplace_back(Line{row_name(report, fit)});
    for (const auto place :
         {&Estimators::paper_s, &Estimators::paper_B, &Estimators::paper_k, &Estimators::paper_a})
      line.push_back(b_text(report, fit.estimate(place)));
  }
  return '\n' + with_words_outside(lines) +
         "stress of small over large grains: s phi_S/phi_L, or k (phi_S/phi_L)^a; s < 1 means "
         "B > 0\n";
}

/// Matrix of B under a rule: one row per larger species, one column per smaller species.
std::string matrix_text(const FitReport& report, const std::string& rule)
{
  const auto& species = report.species;
  std::size_t width = 8;
  for (const auto& one : species) width = std::max(width, one.name.size() + 2);
  std::string text =
      fmt::format("\nB by {}, larger species down, smaller across\n{:{}}", rule, "", width);
  for (std::size_t k = 0; k + 1 < species.size(); ++k)
    text += fmt::format("{:>{}}", species[k].name, width);
  for (std::size_t b = 1; b < species.size(); ++b) {
    text += fmt::format("\n{:<{}}", species[b].name, width);
    for (const auto& fit : report.rules)
      if (rule_name(report, fit) == rule && fit.pair.larger == b && !fit.flow)
        text += fmt::format("{:>{}}", rounded(report, fit.value.B), width);
  }
  return text + '\n';
}

/// The populations of the intervals of a flow, and of all flows; "" unless each flow has its rows.
std::string populations_by_flow(const FitReport& report)
{
  if (!report.is_by_flow()) return "";
  std::set<std::string> of_flow, of_all;
  for (const auto& fit : report.rules)
    (fit.flow ? of_flow : of_all).insert(word_of(fit.over, populations));
  return fmt::format("intervals of one flow are over {}, of all over {}\n",
                     fmt::join(of_flow, " or "), fmt::join(of_all, " or "));
}

/// B of all flows together over each population, the meaning of the populations, and the flows with
/// their weights.
std::string populations_text(const FitReport& report)
{
  std::string text = populations_by_flow(report);
  std::vector<Line> lines{{"all together", "B [95 %]", "over"}};
  for (const auto& fit : report.rules)
    for (const auto& [word, population, meaning] : populations) {
      const auto& b = fit.at(population);
      if (!shows_all_populations(report) || fit.flow || !std::isfinite(b.value)) continue;
      lines.push_back({row_name(report, fit), b_text(report, b), word});
    }
  if (lines.size() > 1) text += '\n' + with_words_outside(lines);
  if (report.flows.empty()) return text;
  const auto words = estimands(report, shows_all_populations(report));
  if (!words.empty()) text += '\n';
  for (const auto& [over, sentence] : words)
    text += wrapped(fmt::format("{}over {}: {}", words.size() == 1 ? "intervals " : "",
                                word_of(over, populations), sentence));
  if (report.flows.size() < 2) return text;
  text += '\n';
  for (std::size_t m = 0; m < report.flows.size(); ++m)
    text += fmt::format("{}: {}, {}\n", report.flows[m].name,
                        counted(report.flows[m].tables.size(), "table"), share_words(report, m));
  return text;
}

/// Matrix of B by pair and the size exponent, once per rule.
std::string pairs_text(const FitReport& report)
{
  const auto& first = report.rules.front().pair;
  const bool several =
      std::ranges::any_of(report.rules, [&](const RuleFit& fit) { return fit.pair != first; });
  std::string text, last;
  for (const auto& fit : report.rules) {
    const auto rule = rule_name(report, fit);
    if (rule == last) continue;
    last = rule;
    if (report.names_pairs() && several) text += matrix_text(report, rule);
    const auto of_all = std::ranges::find_if(report.rules, [&](const RuleFit& other) {
      return rule_name(report, other) == rule && other.size_exponent;
    });
    if (of_all != report.rules.end())
      text += fmt::format("{}: a = {}: sigma^nu/sigma = phi^nu s^a/sum(phi s^a)\n", rule,
                          b_text(report, *of_all->size_exponent));
  }
  return text;
}

/// p* and dB/dp of each flow and of all flows; they are the same for every rule.
std::string line_text(const FitReport& report)
{
  std::string text;
  const auto name = report.rules.empty() ? "" : rule_name(report, report.rules.front());
  for (const auto& fit : report.rules)
    if (rule_name(report, fit) == name && std::isfinite(fit.line.p_zero.value))
      text += wrapped(fmt::format(
          "B = 0 if the large grain gets p* = {} of every mixed contact; dB/dp = {}{}",
          b_text(report, fit.line.p_zero.estimate()), b_text(report, fit.line.dB_dp.estimate()),
          report.is_by_flow() ? "; " + flow_name(report, fit) : ""));
  return text.empty() ? "" : '\n' + text;
}

}  // namespace

std::string short_table(const FitReport& report)
{
  std::string text = fmt::format(
      "B of the {} stress ({}), a mean with the weight phi_L phi_S, from {} of {}{}\n\n",
      word_of(report.quantity, quantities), word_of(report.component, components),
      counted(report.number_of_windows, "window"), counted(report.number_of_runs, "run"),
      report.flows.size() > 1 ? fmt::format(" of {} flows", report.flows.size()) : "");
  text += rules_text(report);
  text += differences_text(report);
  text += paper_text(report);
  text += pairs_text(report);
  text += line_text(report);
  text += populations_text(report);
  for (const auto& names : report.shared_runs)
    text += fmt::format("counted as one run: {}\n", fmt::join(names, " "));
  if (!report.verdict.empty()) text += '\n';
  for (const auto& sentence : report.verdict) text += wrapped("verdict: " + sentence);
  std::string of_doubts;
  for (const auto& doubt : doubts(report)) of_doubts += wrapped("doubt: " + doubt);
  return of_doubts.empty() ? text : text + '\n' + of_doubts;
}

}  // namespace grseg
