// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/short_table.hpp"

#include "formats/cli/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace grseg {
namespace {

std::string rounded(double value)
{
  if (!std::isfinite(value)) return "-";
  const auto text = fmt::format("{:.3f}", value);
  return text == "-0.000" ? "0.000" : text;
}

std::string interval_text(double low, double high)
{
  if (!std::isfinite(low) || !std::isfinite(high)) return "-";
  return fmt::format("{:>6} to {:>6}", rounded(low), rounded(high));
}

std::string with_interval(double value, const Interval& interval)
{
  if (!std::isfinite(interval.low)) return rounded(value);
  return fmt::format("{} ({} to {})", rounded(value), rounded(interval.low),
                     rounded(interval.high));
}

using Line = std::vector<std::string>;  // all of the same length

/// Words to the left in the first and last column, numbers to the right between them, columns as
/// wide as they must be.
std::string aligned(const std::vector<Line>& lines)
{
  std::vector<std::size_t> width(lines.front().size());
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  std::string text;
  for (const auto& line : lines) {
    text += fmt::format("{:<{}}", line.front(), width.front());
    for (std::size_t c = 1; c + 1 < line.size(); ++c)
      text += fmt::format("  {:>{}}", line[c], width[c]);
    text += fmt::format("  {}\n", line.back());
  }
  return text;
}

/// B of the component that the report is not about; none where no rule has it.
struct OtherComponent {
  const char* title;
  Estimate RuleFit::*b;
};
std::optional<OtherComponent> other_component(const FitReport& report)
{
  const OtherComponent other = report.component == Component::yy
                                   ? OtherComponent{"B_half, pressure", &RuleFit::B_pressure}
                                   : OtherComponent{"B_half, yy", &RuleFit::B_yy};
  const bool any = std::any_of(report.rules.begin(), report.rules.end(), [&](const RuleFit& fit) {
    return std::isfinite((fit.*other.b).value);
  });
  return any ? std::optional(other) : std::nullopt;
}

std::string rules_text(const FitReport& report)
{
  const auto other = other_component(report);
  const bool by_mixture = report.is_by_mixture();
  std::vector<Line> lines{{by_mixture ? "rule, mixture" : "rule", "B_half", "95 % interval",
                           "B_sums", "95 % interval"}};
  if (other) lines.back().insert(lines.back().end(), {other->title, "95 % interval"});
  lines.back().insert(lines.back().end(), {"share", "points", "used by"});
  for (const auto& fit : report.rules) {
    Line line{row_name(report, fit), rounded(fit.value.B_half),
              interval_text(fit.low.B_half, fit.high.B_half), rounded(fit.value.B_sums),
              interval_text(fit.low.B_sums, fit.high.B_sums)};
    if (other) {
      const Estimate& b = fit.*other->b;
      line.insert(line.end(), {rounded(b.value), interval_text(b.low, b.high)});
    }
    line.insert(line.end(),
                {rounded(fit.share), fmt::format("{}", fit.points), used_by(report, fit)});
    lines.push_back(line);
  }
  return aligned(lines);
}

/// B of every pair under a rule, the larger species along the lines.
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
      if (rule_name(report, fit) == rule && fit.pair.larger == b && !fit.mixture)
        text += fmt::format("{:>{}}", rounded(fit.value.B_half), width);
  }
  return text + '\n';
}

/// The numbers for all mixtures together under the rules that have B, and what each of them is.
std::string populations_text(const FitReport& report)
{
  std::string text;
  std::vector<Line> lines;
  for (const auto& fit : report.rules)
    for (const auto& [word, population, meaning] : overs) {
      const auto& b = fit.at(population);
      if (report.shares.half.size() < 2 || fit.mixture || !std::isfinite(b.value)) continue;
      const auto& sums = fit.sums_at(population);
      lines.push_back({row_name(report, fit), rounded(b.value), interval_text(b.low, b.high),
                       rounded(sums.value), interval_text(sums.low, sums.high), word});
    }
  if (!lines.empty()) {
    lines.insert(lines.begin(),
                 {"all together", "B_half", "95 % interval", "B_sums", "95 % interval", "over"});
    text += '\n' + aligned(lines);
  }
  const auto words = estimands(report);
  if (!words.empty() && !report.mixtures.empty()) text += '\n';
  if (!report.mixtures.empty())
    for (const auto& [over, sentence] : words)
      text += fmt::format("over {}: {}\n", word_of(over, overs), sentence);
  if (report.mixtures.size() < 2) return text;
  text += '\n';
  for (std::size_t m = 0; m < report.mixtures.size(); ++m)
    text += fmt::format("{}: {}, {}\n", report.mixtures[m].name,
                        counted(report.mixtures[m].tables.size(), "table"), share_words(report, m));
  return text;
}

bool has_several_pairs(const FitReport& report)
{
  const auto& first = report.rules.front().pair;
  return std::any_of(report.rules.begin(), report.rules.end(), [&first](const RuleFit& fit) {
    return fit.pair.smaller != first.smaller || fit.pair.larger != first.larger;
  });
}

/// What is known of all pairs together, each rule once.
std::string pairs_text(const FitReport& report)
{
  std::string text, last;
  for (const auto& fit : report.rules) {
    const auto rule = rule_name(report, fit);
    if (rule == last) continue;
    last = rule;
    if (report.names_pairs() && has_several_pairs(report)) text += matrix_text(report, rule);
    const auto of_all = std::find_if(
        report.rules.begin(), report.rules.end(),
        [&](const auto& other) { return rule_name(report, other) == rule && other.size_exponent; });
    if (of_all == report.rules.end()) continue;
    if (const auto& a = of_all->size_exponent)
      text += fmt::format("{}: a = {}: sigma^nu/sigma = phi^nu s^a/sum(phi s^a)\n", rule,
                          with_interval(a->value, {a->low, a->high}));
  }
  return text;
}

std::string scan_text(const PartitionScan& scan)
{
  const auto &first = scan.fits.front(), &last = scan.fits.back();
  return fmt::format("B(p) at {} shares: {} at p = {:g} to {} at p = {:g}\n", scan.fits.size(),
                     rounded(first.value.B_half), first.rule.value, rounded(last.value.B_half),
                     last.rule.value);
}

std::string zero_text(const ZeroOfB& zero)
{
  if (std::isnan(zero.p_zero)) return "p*: B has no zero at any share looked at\n";
  return fmt::format("p* = {}: with this share of every mixed contact B = 0; dB/dp = {} there\n",
                     with_interval(zero.p_zero, zero.p_zero_interval),
                     with_interval(zero.dB_dp, zero.dB_dp_interval));
}

/// p* of the sums, of each mixture and of all, which no rule changes.
std::string zeros_of_sums_text(const FitReport& report)
{
  std::string text;
  const auto name = report.rules.empty() ? "" : rule_name(report, report.rules.front());
  for (const auto& fit : report.rules)
    if (rule_name(report, fit) == name && std::isfinite(fit.p_zero_sums.value))
      text += fmt::format("p* by sums = {}: with this share B_sums = 0{}\n",
                          with_interval(fit.p_zero_sums.value, fit.p_zero_sums.interval()),
                          report.is_by_mixture() ? "; " + mixture_name(report, fit) : "");
  return text;
}

/// Each doubt once, with the rules that it is about.
std::string doubts_text(const FitReport& report)
{
  std::vector<std::pair<std::string, std::string>> names_of;  // doubt and rules, in order
  const auto add = [&](const std::string& name, const std::string& doubt) {
    if (doubt.empty()) return;
    const auto known = std::find_if(names_of.begin(), names_of.end(),
                                    [&](const auto& entry) { return entry.first == doubt; });
    if (known == names_of.end())
      names_of.emplace_back(doubt, name);
    else
      known->second += ", " + name;
  };
  for (const auto& fit : report.rules) add(row_name(report, fit), fit.doubt);
  if (report.scan) add("scan", report.scan->fits.front().doubt);
  std::string text = names_of.empty() && report.doubts_of_tables.empty() ? "" : "\n";
  for (const auto& doubt : report.doubts_of_tables) text += fmt::format("doubt: {}\n", doubt);
  for (const auto& [doubt, names] : names_of) text += fmt::format("doubt: {}: {}\n", names, doubt);
  return text;
}

}  // namespace

std::string short_table(const FitReport& report)
{
  std::string text = fmt::format(
      "B of the {} stress ({}), B_half: at phi_L = 1/2, B_sums: mean with weight phi_L phi_S, from {} "
      "of {}{}\n\n",
      word_of(report.quantity, quantities), word_of(report.component, components),
      counted(report.number_of_windows, "window"), counted(report.number_of_runs, "run"),
      report.mixtures.size() > 1 ? fmt::format(" of {} mixtures", report.mixtures.size()) : "");
  text += rules_text(report);
  text += pairs_text(report);
  if (report.scan || report.zero) text += '\n';
  if (report.scan) text += scan_text(*report.scan);
  if (report.scan)
    text += zero_text(*report.scan);
  else if (report.zero)
    text += zero_text(*report.zero);
  text += zeros_of_sums_text(report);
  text += populations_text(report);
  for (const auto& names : report.shared_runs)
    text += fmt::format("one run: {}\n", fmt::join(names, " "));
  return text + doubts_text(report);
}

}  // namespace grseg
