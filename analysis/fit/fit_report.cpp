// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"

#include "formats/cli/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

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
    {"minus_size", [](const RuleFit& fit) { return fit.minus_size; }},
    {"minus_size_low", [](const RuleFit& fit) { return fit.minus_size_interval.low; }},
    {"minus_size_high", [](const RuleFit& fit) { return fit.minus_size_interval.high; }},
    {"not_positive", [](const RuleFit& fit) { return static_cast<double>(fit.not_positive); }},
    {"autocorrelation_time[windows]", [](const RuleFit& fit) { return fit.dependence.time; }},
    {"block_length[windows]",
     [](const RuleFit& fit) { return static_cast<double>(fit.dependence.block); }},
    {"effective_windows", [](const RuleFit& fit) { return fit.dependence.effective_windows; }},
    {"B_half_windows_low", [](const RuleFit& fit) { return fit.B_half_windows.low; }},
    {"B_half_windows_high", [](const RuleFit& fit) { return fit.B_half_windows.high; }},
    {"share", [](const RuleFit& fit) { return fit.share; }},
};

std::string header_lines(const FitReport& report)
{
  std::string text;
  for (const auto& [key, value] : report.header) text += fmt::format("# {}: {}\n", key, value);
  for (const auto& input : report.inputs) text += fmt::format("# input: {}\n", input);
  for (const auto& line : report.history) text += fmt::format("# history: {}\n", line);
  for (const auto& doubt : doubts(report)) text += fmt::format("# doubt: {}\n", doubt);
  return text;
}

std::string cells(const std::vector<double>& numbers)
{
  std::vector<std::string> texts;
  texts.reserve(numbers.size());
  for (const double number : numbers) texts.push_back(format_number(number));
  return fmt::format("{}", fmt::join(texts, "\t"));
}

std::string rule_table(const FitReport& report)
{
  std::string text = "rule\tpoints";
  for (const auto& [name, place] : estimator_columns)
    text += fmt::format("\t{0}\t{0}_low\t{0}_high", name);
  for (const auto& column : rule_columns) text += fmt::format("\t{}", column.name);
  text += "\tused_by\n";
  for (const auto& fit : report.rules) {
    std::vector<double> numbers{static_cast<double>(fit.points)};
    for (const auto& [name, place] : estimator_columns)
      numbers.insert(numbers.end(), {fit.value.*place, fit.low.*place, fit.high.*place});
    for (const auto& column : rule_columns) numbers.push_back(column.of(fit));
    text +=
        fmt::format("{}\t{}\t{}\n", rule_name(report, fit), cells(numbers), used_by(report, fit));
  }
  return text;
}

std::string scan_table(const PartitionScan& scan)
{
  std::string text;
  for (const auto& [key, value] : {std::pair{"p_zero", scan.p_zero},
                                   {"p_zero_low", scan.p_zero_interval.low},
                                   {"p_zero_high", scan.p_zero_interval.high},
                                   {"dB_dp", scan.dB_dp},
                                   {"dB_dp_low", scan.dB_dp_interval.low},
                                   {"dB_dp_high", scan.dB_dp_interval.high},
                                   {"autocorrelation_time", scan.dependence.time},
                                   {"block_length", static_cast<double>(scan.dependence.block)}})
    text += fmt::format("# {}: {}\n", key, format_number(value));
  text += "p\tB\tlow\thigh\tB_direct\tB_direct_low\tB_direct_high\tneutral\n";
  for (const auto& fit : scan.fits)
    text += cells({fit.rule.value, fit.value.B_half, fit.low.B_half, fit.high.B_half,
                   fit.value.B_direct, fit.low.B_direct, fit.high.B_direct, fit.neutral}) +
            '\n';
  return text;
}

Json pair(const Interval& interval)
{
  return Json::array({interval.low, interval.high});
}

Json rule_object(const FitReport& report, const RuleFit& fit)
{
  Json estimators = Json::object();
  for (const auto& [name, place] : estimator_columns)
    estimators[name] = {{"value", fit.value.*place},
                        {"interval", {fit.low.*place, fit.high.*place}}};
  return {{"rule", rule_name(report, fit)},
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
          {"share", fit.share},
          {"neutral", fit.neutral},
          {"minus_size", fit.minus_size},
          {"minus_size_interval", pair(fit.minus_size_interval)},
          {"points", fit.points},
          {"not_positive", fit.not_positive},
          {"autocorrelation_time", fit.dependence.time},
          {"block_length", fit.dependence.block},
          {"effective_windows", fit.dependence.effective_windows},
          {"estimators", estimators}};
}

}  // namespace

std::string rule_name(const FitReport& report, const RuleFit& fit)
{
  return report.quantity == Quantity::kinetic ? "kinetic" : fit.rule.name();
}

std::string used_by(const FitReport& report, const RuleFit& fit)
{
  const std::string codes = report.quantity == Quantity::kinetic ? "" : fit.rule.used_by();
  return codes.empty() ? "-" : codes;
}

std::vector<std::string> doubts(const FitReport& report)
{
  std::vector<std::string> all;
  for (const auto& fit : report.rules)
    if (!fit.doubt.empty()) all.push_back(fmt::format("{}: {}", rule_name(report, fit), fit.doubt));
  if (report.scan && !report.scan->fits.front().doubt.empty())
    all.push_back("scan: " + report.scan->fits.front().doubt);
  return all;
}

std::string to_tsv(const FitReport& report)
{
  return header_lines(report) + (report.scan ? scan_table(*report.scan) : rule_table(report));
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
    all["block_length"] = report.scan->dependence.block;
  }
  for (const auto& [key, value] : report.header) all["settings"][key] = value;
  all["inputs"] = report.inputs;
  all["history"] = report.history;
  all["doubts"] = doubts(report);
  return all.dump(2) + '\n';
}

}  // namespace grseg
