// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"

#include "analysis/frames/sums.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// The names of a flow's tables; "-" where one is not known.
std::vector<std::string> tables_of(const FitReport& report, const Flow& flow)
{
  std::vector<std::string> names;
  names.reserve(flow.tables.size());
  for (const auto table : flow.tables)
    names.push_back(table < report.table_names.size() ? printable(report.table_names[table]) : "-");
  return names;
}

/// "Phi_L = 0.06, 4 tables, 3.1 % of the weight: a.tsv b.tsv"
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
  lines.insert(lines.end(), report.trust.begin(), report.trust.end());
  for (const auto& line : report.history) lines.emplace_back("history", line);
  for (std::size_t m = 0; m < report.flows.size(); ++m)
    lines.emplace_back("flow", flow_line(report, m));
  for (const auto& names : report.shared_runs)
    lines.emplace_back("one run", fmt::format("{}", fmt::join(names, " ")));
  for (const auto& [over, words] : estimands(report))
    lines.emplace_back("estimand", fmt::format("{}: {}", word_of(over, populations), words));
  for (const auto& doubt : doubts(report)) lines.emplace_back("doubt", doubt);
  return lines;
}

/// Of all tables together that of all their grains is not known: not a number, unless there is one
/// flow.
double phi_large_of(const FitReport& report, const RuleFit& fit)
{
  if (!fit.flow && report.flows.size() != 1) return no_number;
  return report.flows[fit.flow.value_or(0)].phi_large();
}

double share_of(const FitReport& report, const RuleFit& fit)
{
  return fit.flow ? report.shares[*fit.flow] : 1;
}

/// Adds the numbers of one fit to a list.
class NumbersOf {
 public:
  NumbersOf(const FitReport& report, const RuleFit& fit, std::vector<NumberRow>& rows)
      : report_(report), fit_(fit), rows_(rows)
  {
  }

  void add_all(bool of_first_rule)
  {
    if (fit_.rule.adds_up()) add_b();
    const auto over = fit_.over;
    add("share", {fit_.share});
    add("neutral", {fit_.neutral});
    add_measured("B_minus_size", fit_.minus_size);
    if (fit_.size_exponent) add("size_exponent", *fit_.size_exponent, over);
    if (report_.with_paper)
      for (const auto& [name, place] : estimator_columns)
        if (std::string(name).starts_with("paper_"))
          add(name, {fit_.value.*place, fit_.low.*place, fit_.high.*place}, over);
    add("effective_windows", {fit_.dependence.effective_windows});
    add("autocorrelation_time[windows]", {fit_.dependence.time});
    if (!of_first_rule) return;
    rule_ = "-";
    add("Phi_L", {phi_large_of(report_, fit_)});
    add("weight_share", {share_of(report_, fit_)});
    add("runs", {static_cast<double>(fit_.runs)});
    add("points", {static_cast<double>(fit_.points)});
    add_measured("p_zero", fit_.line.p_zero);
    add_measured("dB_dp", fit_.line.dB_dp);
  }

 private:
  /// Over what the fit is, then over all others.
  void add_b()
  {
    add("B", {fit_.value.B, fit_.low.B, fit_.high.B}, fit_.over, fit_.degrees);
    for (const auto& [word, population, meaning] : populations)
      if (population != fit_.over) add("B", fit_.at(population), population);
  }
  void add_measured(const char* quantity, const Measured& measured)
  {
    add(quantity, measured.estimate(), fit_.over, measured.error.degrees);
  }
  /// Nothing where there is no number.
  void add(const std::string& quantity, const Estimate& number,
           Population over = Population::automatic, double degrees = no_number)
  {
    if (!std::isfinite(number.value)) return;
    const bool has_interval = std::isfinite(number.low);
    rows_.push_back({.rule = rule_,
                     .flow = flow_name(report_, fit_),
                     .pair = pair_name(report_, fit_),
                     .quantity = quantity,
                     .over = has_interval ? word_of(over, populations) : "-",
                     .of_flow = fit_.flow,
                     .number = number,
                     .degrees = has_interval ? degrees : no_number});
  }

  const FitReport& report_;
  const RuleFit& fit_;
  std::vector<NumberRow>& rows_;
  std::string rule_ = rule_name(report_, fit_);
};

/// The settings of a row's flow in which flows differ; nan of all flows together.
std::vector<std::string> settings_of(const FitReport& report, const NumberRow& row)
{
  std::vector<std::string> values;
  for (std::size_t k = 0; k < report.flows.front().settings.size(); ++k)
    values.push_back(row.of_flow ? report.flows[*row.of_flow].settings[k].second : "nan");
  return values;
}

std::vector<std::string> names_of_settings(const FitReport& report)
{
  std::vector<std::string> names;
  if (report.flows.empty()) return names;
  for (const auto& [name, value] : report.flows.front().settings) names.push_back(name);
  return names;
}

std::string rule_table(const FitReport& report)
{
  std::vector<std::string> columns{"rule", "flow",  "pair", "component", "quantity",
                                   "over", "value", "low",  "high",      "degrees_of_freedom"};
  const auto names = names_of_settings(report);
  columns.insert(columns.end(), names.begin(), names.end());
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : number_rows(report)) {
    auto& cells = rows.emplace_back(std::vector<std::string>{row.rule, row.flow, row.pair,
                                                             word_of(report.component, components),
                                                             row.quantity, row.over});
    for (const double number : {row.number.value, row.number.low, row.number.high, row.degrees})
      cells.push_back(format_number(number));
    if (!names.empty())
      for (auto& value : settings_of(report, row)) cells.push_back(std::move(value));
  }
  return table_text(header_of(report), columns, rows);
}

std::string scan_table(const FitReport& report)
{
  const auto& scan = *report.scan;
  Table table;
  table.header = header_of(report);
  const auto zero = scan.line.p_zero.estimate(), slope = scan.line.dB_dp.estimate();
  for (const auto& [key, value] : {std::pair{"p_zero", zero.value},
                                   {"p_zero_low", zero.low},
                                   {"p_zero_high", zero.high},
                                   {"dB_dp", slope.value},
                                   {"dB_dp_low", slope.low},
                                   {"dB_dp_high", slope.high}})
    table.header.emplace_back(key, format_number(value));
  table.columns = {"p", "B", "low", "high", "neutral"};
  for (const auto& fit : scan.fits)
    table.rows.push_back({fit.rule.value, fit.value.B, fit.low.B, fit.high.B, fit.neutral});
  return table.to_text();
}

Json row_object(const FitReport& report, const NumberRow& row)
{
  Json object{{"rule", row.rule},          {"flow", row.flow},
              {"pair", row.pair},          {"component", word_of(report.component, components)},
              {"quantity", row.quantity},  {"over", row.over},
              {"value", row.number.value}, {"low", row.number.low},
              {"high", row.number.high},   {"degrees_of_freedom", row.degrees}};
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
    NumbersOf(report, fit, rows).add_all(rule_name(report, fit) == first);
  return rows;
}

std::string pair_name(const FitReport& report, const RuleFit& fit)
{
  if (report.species.empty()) return "S+L";
  return report.species[fit.pair.smaller].name + '+' + report.species[fit.pair.larger].name;
}

std::string rule_name(const FitReport& report, const RuleFit& fit)
{
  return report.quantity == Quantity::kinetic ? "kinetic" : fit.rule.name();
}

std::string row_name(const FitReport& report, const RuleFit& fit)
{
  auto name = rule_name(report, fit);
  if (report.names_pairs()) name += " " + pair_name(report, fit);
  if (report.is_by_flow()) name += ", " + flow_name(report, fit);
  return name;
}

std::string share_words(const FitReport& report, std::size_t flow)
{
  if (flow >= report.shares.size()) return "weight unknown";
  return fmt::format("{:.3g} % of the weight", 100 * report.shares[flow]);
}

std::string flow_name(const FitReport& report, const RuleFit& fit)
{
  if (fit.flow) return report.flows[*fit.flow].name;
  return report.flows.size() == 1 ? report.flows.front().name : "all";
}

std::vector<std::pair<Population, std::string>> estimands(const FitReport& report)
{
  std::set<Population> used;
  for (const auto& fit : report.rules) {
    used.insert(fit.over);
    for (const auto& [word, population, meaning] : populations)
      if (std::isfinite(fit.at(population).low)) used.insert(population);
  }
  if (report.scan) used = {report.scan->fits.front().over};
  const auto flows = static_cast<std::size_t>(
      std::count_if(report.shares.begin(), report.shares.end(), [](double s) { return s > 0; }));
  std::vector<std::pair<Population, std::string>> words;
  words.reserve(used.size());
  for (const auto over : used) words.emplace_back(over, estimand_words(over, flows));
  return words;
}

std::string used_by(const FitReport& report, const RuleFit& fit)
{
  const std::string codes = report.quantity == Quantity::kinetic ? "" : fit.rule.used_by();
  return codes.empty() ? "-" : codes;
}

std::vector<std::string> doubts(const FitReport& report)
{
  std::vector<std::pair<std::string, std::string>> of_fits;  // a doubt, and whose it is
  const auto add = [&](const std::string& name, const std::string& doubt) {
    if (doubt.empty()) return;
    const auto same = std::find_if(of_fits.begin(), of_fits.end(),
                                   [&](const auto& known) { return known.first == doubt; });
    if (same == of_fits.end())
      of_fits.emplace_back(doubt, name);
    else
      same->second += ", " + name;
  };
  for (const auto& fit : report.rules) add(row_name(report, fit), fit.doubt);
  if (report.scan) add("scan", report.scan->fits.front().doubt);
  auto all = report.doubts_of_tables;
  for (const auto& [doubt, names] : of_fits) all.push_back(fmt::format("{}: {}", names, doubt));
  return all;
}

std::string to_tsv(const FitReport& report)
{
  return report.scan ? scan_table(report) : rule_table(report);
}

std::string to_json(const FitReport& report)
{
  Json all;
  all["numbers"] = Json::array();
  for (const auto& row : number_rows(report)) all["numbers"].push_back(row_object(report, row));
  if (report.scan) {
    all["scan"] = Json::array();
    for (const auto& fit : report.scan->fits)
      all["scan"].push_back(Json::array({fit.rule.value, fit.value.B, fit.low.B, fit.high.B}));
  }
  for (const auto& [key, value] : report.header) all["settings"][key] = value;
  all["flows"] = Json::array();
  for (std::size_t m = 0; m < report.flows.size(); ++m)
    all["flows"].push_back({{"name", report.flows[m].name},
                            {"Phi_L", report.flows[m].phi_large()},
                            {"weight_share", report.shares[m]},
                            {"tables", tables_of(report, report.flows[m])}});
  if (!report.shared_runs.empty()) all["one_run"] = report.shared_runs;
  for (const auto& [over, words] : estimands(report))
    all["estimands"][word_of(over, populations)] = words;
  all["inputs"] = report.inputs;
  for (const auto& [key, value] : report.trust) all[key].push_back(value);
  all["history"] = Json::array();
  for (const auto& line : report.history) all["history"].push_back(printable(line));
  all["doubts"] = doubts(report);
  return all.dump(2) + '\n';
}

}  // namespace grseg
