// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"

#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// A number of a rule's row behind the estimators. To add one is to add a line here (and a key in
/// rule_object, where JSON is to have it).
struct RuleColumn {
  const char* name;
  double (*of)(const RuleFit&);
};
constexpr RuleColumn rule_columns[] = {
    {"neutral", [](const RuleFit& fit) { return fit.neutral; }},
    {"minus_size", [](const RuleFit& fit) { return fit.minus_size.value; }},
    {"minus_size_low", [](const RuleFit& fit) { return fit.minus_size.interval().low; }},
    {"minus_size_high", [](const RuleFit& fit) { return fit.minus_size.interval().high; }},
    {"not_positive", [](const RuleFit& fit) { return static_cast<double>(fit.not_positive); }},
    {"autocorrelation_time[windows]", [](const RuleFit& fit) { return fit.dependence.time; }},
    {"block_length[windows]",
     [](const RuleFit& fit) { return static_cast<double>(fit.dependence.block); }},
    {"effective_windows", [](const RuleFit& fit) { return fit.dependence.effective_windows; }},
    {"B_half_windows_low", [](const RuleFit& fit) { return fit.B_half_windows.low; }},
    {"B_half_windows_high", [](const RuleFit& fit) { return fit.B_half_windows.high; }},
    {"share", [](const RuleFit& fit) { return fit.share; }},
    {"B_yy", [](const RuleFit& fit) { return fit.B_yy.value; }},
    {"B_yy_low", [](const RuleFit& fit) { return fit.B_yy.low; }},
    {"B_yy_high", [](const RuleFit& fit) { return fit.B_yy.high; }},
    {"B_pressure", [](const RuleFit& fit) { return fit.B_pressure.value; }},
    {"B_pressure_low", [](const RuleFit& fit) { return fit.B_pressure.low; }},
    {"B_pressure_high", [](const RuleFit& fit) { return fit.B_pressure.high; }},
    {"p_zero_sums", [](const RuleFit& fit) { return fit.p_zero_sums.value; }},
    {"p_zero_sums_low", [](const RuleFit& fit) { return fit.p_zero_sums.interval().low; }},
    {"p_zero_sums_high", [](const RuleFit& fit) { return fit.p_zero_sums.interval().high; }},
    {"B_sums_windows_low", [](const RuleFit& fit) { return fit.B_sums_windows.low; }},
    {"B_sums_windows_high", [](const RuleFit& fit) { return fit.B_sums_windows.high; }},
};

/// The names of a mixture's tables; "-" where one is not known.
std::vector<std::string> tables_of(const FitReport& report, const Mixture& mixture)
{
  std::vector<std::string> names;
  names.reserve(mixture.tables.size());
  for (const auto table : mixture.tables)
    names.push_back(table < report.table_names.size() ? printable(report.table_names[table]) : "-");
  return names;
}

/// "Phi_L = 0.06, 4 tables, 1.7 % of the weight of B_half, 3.1 % of that of B_sums: a.tsv b.tsv"
std::string mixture_line(const FitReport& report, std::size_t m)
{
  const auto& mixture = report.mixtures[m];
  return fmt::format("{}, {}, {}: {}", mixture.name, counted(mixture.tables.size(), "table"),
                     share_words(report, m), fmt::join(tables_of(report, mixture), " "));
}

/// B_half of a population, its columns "B_equal_mixtures", "B_equal_mixtures_low" ...; of B_sums
/// with `stem` "B_sums_".
std::string column_of_population(const char* stem, Over over)
{
  std::string name = std::string(stem) + word_of(over, overs);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

Header header_of(const FitReport& report)
{
  Header lines = report.header;
  for (const auto& input : report.inputs) lines.emplace_back("input", input);
  lines.insert(lines.end(), report.trust.begin(), report.trust.end());
  for (const auto& line : report.history) lines.emplace_back("history", line);
  for (std::size_t m = 0; m < report.mixtures.size(); ++m)
    lines.emplace_back("mixture", mixture_line(report, m));
  for (const auto& names : report.shared_runs)
    lines.emplace_back("one run", fmt::format("{}", fmt::join(names, " ")));
  for (const auto& [over, words] : estimands(report))
    lines.emplace_back("estimand", fmt::format("{}: {}", word_of(over, overs), words));
  for (const auto& doubt : doubts(report)) lines.emplace_back("doubt", doubt);
  return lines;
}

/// Those that have columns of their own; of windows there is B_half_windows_low and _high.
constexpr Over populations[] = {Over::runs, Over::mixtures, Over::equal_mixtures,
                                Over::random_mixtures, Over::compositions};

/// Of all tables together that of all their grains is not known: not a number, unless there is one
/// mixture.
double phi_large_of(const FitReport& report, const RuleFit& fit)
{
  if (!fit.mixture && report.mixtures.size() != 1) return Estimators::nan;
  return report.mixtures[fit.mixture.value_or(0)].phi_large();
}

double share_of(const FitReport& report, const RuleFit& fit)
{
  return fit.mixture ? report.shares.half[*fit.mixture] : 1;
}

std::vector<std::string> rule_table_columns(const FitReport& report)
{
  std::vector<std::string> columns{"rule"};
  const auto add_with_interval = [&columns](const std::string& name) {
    columns.insert(columns.end(), {name, name + "_low", name + "_high"});
  };
  if (report.is_by_mixture()) columns.emplace_back("mixture");
  if (report.names_pairs()) columns.insert(columns.end(), {"smaller", "larger"});
  columns.emplace_back("points");
  for (const auto& [name, place] : estimator_columns) add_with_interval(name);
  for (const auto& column : rule_columns) columns.emplace_back(column.name);
  if (report.has_exponent()) add_with_interval("size_exponent");
  columns.insert(columns.end(), {"over", "runs", "degrees_of_freedom", "Phi_L", "weight_share"});
  for (const char* stem : {"B_", "B_sums_"})
    for (const auto& population : populations)
      add_with_interval(column_of_population(stem, population));
  columns.emplace_back("used_by");
  return columns;
}

/// The cells of one fit, in the order of those columns.
std::vector<std::string> rule_table_row(const FitReport& report, const RuleFit& fit)
{
  std::vector<std::string> row{rule_name(report, fit)};
  const auto add = [&row](std::initializer_list<double> numbers) {
    for (const double number : numbers) row.push_back(format_number(number));
  };
  if (report.is_by_mixture()) row.push_back(mixture_name(report, fit));
  if (report.names_pairs())
    row.insert(row.end(),
               {report.species[fit.pair.smaller].name, report.species[fit.pair.larger].name});
  add({static_cast<double>(fit.points)});
  for (const auto& [name, place] : estimator_columns)
    add({fit.value.*place, fit.low.*place, fit.high.*place});
  for (const auto& column : rule_columns) add({column.of(fit)});
  if (report.has_exponent()) {
    const auto exponent = fit.size_exponent.value_or(Estimate{});
    add({exponent.value, exponent.low, exponent.high});
  }
  row.emplace_back(word_of(fit.over, overs));
  add({static_cast<double>(fit.runs), fit.degrees, phi_large_of(report, fit),
       share_of(report, fit)});
  for (const auto* over : {&fit.B_over, &fit.B_sums_over})
    for (const auto& population : populations) {
      const auto& b = (*over)[static_cast<std::size_t>(population)];
      add({b.value, b.low, b.high});
    }
  row.push_back(used_by(report, fit));
  return row;
}

std::string rule_table(const FitReport& report)
{
  std::vector<std::vector<std::string>> rows;
  rows.reserve(report.rules.size());
  for (const auto& fit : report.rules) rows.push_back(rule_table_row(report, fit));
  return table_text(header_of(report), rule_table_columns(report), rows);
}

std::string scan_table(const FitReport& report)
{
  const auto& scan = *report.scan;
  Table table;
  table.header = header_of(report);
  const auto zero_of_sums = scan.p_zero_sums.estimate();
  for (const auto& [key, value] : {std::pair{"p_zero", scan.p_zero},
                                   {"p_zero_low", scan.p_zero_interval.low},
                                   {"p_zero_high", scan.p_zero_interval.high},
                                   {"dB_dp", scan.dB_dp},
                                   {"dB_dp_low", scan.dB_dp_interval.low},
                                   {"dB_dp_high", scan.dB_dp_interval.high},
                                   {"p_zero_sums", zero_of_sums.value},
                                   {"p_zero_sums_low", zero_of_sums.low},
                                   {"p_zero_sums_high", zero_of_sums.high},
                                   {"autocorrelation_time", scan.dependence.time},
                                   {"block_length", static_cast<double>(scan.dependence.block)}})
    table.header.emplace_back(key, format_number(value));
  table.columns = {
      "p",       "B",      "low",        "high",       "B_direct", "B_direct_low", "B_direct_high",
      "neutral", "B_sums", "B_sums_low", "B_sums_high"};
  for (const auto& fit : scan.fits)
    table.rows.push_back({fit.rule.value, fit.value.B_half, fit.low.B_half, fit.high.B_half,
                          fit.value.B_direct, fit.low.B_direct, fit.high.B_direct, fit.neutral,
                          fit.value.B_sums, fit.low.B_sums, fit.high.B_sums});
  return table.to_text();
}

Json pair(const Interval& interval)
{
  return Json::array({interval.low, interval.high});
}

Json of_estimate(const Estimate& estimate)
{
  return {{"value", estimate.value}, {"interval", {estimate.low, estimate.high}}};
}

Json rule_object(const FitReport& report, const RuleFit& fit)
{
  Json estimators = Json::object();
  for (const auto& [name, place] : estimator_columns)
    estimators[name] = {{"value", fit.value.*place},
                        {"interval", {fit.low.*place, fit.high.*place}}};
  Json object{{"rule", rule_name(report, fit)},
              {"used_by", used_by(report, fit)},
              {"component", word_of(report.component, components)},
              {"quantity", word_of(report.quantity, quantities)},
              {"slope", fit.value.slope},
              {"slope_interval", {fit.low.slope, fit.high.slope}},
              {"exponent", fit.value.exponent},
              {"B_half", fit.value.B_half},
              {"B_mean", fit.value.B_mean},
              {"B_direct", fit.value.B_direct},
              {"B_interval", {fit.low.B_half, fit.high.B_half}},
              {"B_windows_interval", pair(fit.B_half_windows)},
              {"B_yy", of_estimate(fit.B_yy)},
              {"B_pressure", of_estimate(fit.B_pressure)},
              {"share", fit.share},
              {"neutral", fit.neutral},
              {"minus_size", fit.minus_size.value},
              {"minus_size_interval", pair(fit.minus_size.interval())},
              {"points", fit.points},
              {"not_positive", fit.not_positive},
              {"autocorrelation_time", fit.dependence.time},
              {"block_length", fit.dependence.block},
              {"effective_windows", fit.dependence.effective_windows},
              {"estimators", estimators}};
  object["over"] = word_of(fit.over, overs);
  object["mixture"] = mixture_name(report, fit);
  object["runs"] = fit.runs;
  object["degrees_of_freedom"] = fit.degrees;
  object["weight_share"] = share_of(report, fit);
  object["populations"]["windows"] = of_estimate(fit.at(Over::windows));
  for (const auto& population : populations)
    object["populations"][word_of(population, overs)] = of_estimate(fit.at(population));
  object["populations_of_B_sums"]["windows"] = of_estimate(fit.sums_at(Over::windows));
  for (const auto& population : populations)
    object["populations_of_B_sums"][word_of(population, overs)] =
        of_estimate(fit.sums_at(population));
  object["p_zero_sums"] = of_estimate(fit.p_zero_sums.estimate());
  if (report.names_pairs())
    object["species"] = {report.species[fit.pair.smaller].name,
                         report.species[fit.pair.larger].name};
  if (fit.size_exponent) object["size_exponent"] = of_estimate(*fit.size_exponent);
  return object;
}

}  // namespace

std::string rule_name(const FitReport& report, const RuleFit& fit)
{
  return report.quantity == Quantity::kinetic ? "kinetic" : fit.rule.name();
}

std::string row_name(const FitReport& report, const RuleFit& fit)
{
  auto name = rule_name(report, fit);
  if (report.names_pairs())
    name += fmt::format(" {}+{}", report.species[fit.pair.smaller].name,
                        report.species[fit.pair.larger].name);
  if (report.is_by_mixture()) name += ", " + mixture_name(report, fit);
  return name;
}

std::string share_words(const FitReport& report, std::size_t mixture)
{
  if (mixture >= report.shares.half.size()) return "weight unknown";
  return fmt::format("{:.3g} % of the weight of B_half, {:.3g} % of that of B_sums",
                     100 * report.shares.half[mixture], 100 * report.shares.sums[mixture]);
}

std::string mixture_name(const FitReport& report, const RuleFit& fit)
{
  if (fit.mixture) return report.mixtures[*fit.mixture].name;
  return report.mixtures.size() == 1 ? report.mixtures.front().name : "all";
}

std::vector<std::pair<Over, std::string>> estimands(const FitReport& report)
{
  std::set<Over> used;
  for (const auto& fit : report.rules) {
    used.insert(fit.over);
    for (const auto& [word, population, meaning] : overs)
      if (std::isfinite(fit.at(population).low)) used.insert(population);
  }
  if (report.scan) used = {report.scan->fits.front().over};
  const auto mixtures = static_cast<std::size_t>(std::count_if(
      report.shares.half.begin(), report.shares.half.end(), [](double s) { return s > 0; }));
  std::vector<std::pair<Over, std::string>> words;
  words.reserve(used.size());
  for (const auto over : used) words.emplace_back(over, estimand_words(over, mixtures));
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
  all["rules"] = Json::array();
  for (const auto& fit : report.rules) all["rules"].push_back(rule_object(report, fit));
  if (report.scan) {
    all["scan"] = Json::array();
    for (const auto& fit : report.scan->fits)
      all["scan"].push_back(
          Json::array({fit.rule.value, fit.value.B_half, fit.low.B_half, fit.high.B_half}));
    all["p_zero"] = report.scan->p_zero;
    all["p_zero_interval"] = pair(report.scan->p_zero_interval);
    all["dB_dp"] = report.scan->dB_dp;
    all["dB_dp_interval"] = pair(report.scan->dB_dp_interval);
    all["autocorrelation_time"] = report.scan->dependence.time;
    all["p_zero_sums"] = of_estimate(report.scan->p_zero_sums.estimate());
    all["block_length"] = report.scan->dependence.block;
  }
  for (const auto& [key, value] : report.header) all["settings"][key] = value;
  all["mixtures"] = Json::array();
  for (std::size_t m = 0; m < report.mixtures.size(); ++m)
    all["mixtures"].push_back({{"name", report.mixtures[m].name},
                               {"Phi_L", report.mixtures[m].phi_large()},
                               {"weight_share", report.shares.half[m]},
                               {"weight_share_sums", report.shares.sums[m]},
                               {"tables", tables_of(report, report.mixtures[m])}});
  if (!report.shared_runs.empty()) all["one_run"] = report.shared_runs;
  for (const auto& [over, words] : estimands(report))
    all["estimands"][word_of(over, overs)] = words;
  all["inputs"] = report.inputs;
  for (const auto& [key, value] : report.trust) all[key].push_back(value);
  all["history"] = Json::array();
  for (const auto& line : report.history) all["history"].push_back(printable(line));
  all["doubts"] = doubts(report);
  return all.dump(2) + '\n';
}

}  // namespace grseg
