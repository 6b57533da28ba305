// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/short_table.hpp"

#include "formats/cli/readable_table.hpp"
#include "formats/cli/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace grseg {
namespace {

std::string rounded(const FitReport& report, double value)
{
  if (!std::isfinite(value)) return "-";
  if (report.digits > 0) return fmt::format("{:.{}g}", value, report.digits);
  const auto text = fmt::format("{:.3f}", value);
  return text == "-0.000" ? "0.000" : text;
}

/// The first words of a text; a table is to fit 100 columns.
std::string shortened(const std::string& text)
{
  constexpr std::size_t most = 44;
  return text.size() <= most ? text : text.substr(0, text.rfind(' ', most - 4)) + " ...";
}

/// A sentence in lines of a hundred columns at most, those after the first indented.
std::string wrapped(const std::string& sentence)
{
  constexpr auto most = readable_width;
  std::string text;
  std::size_t column = 0;
  std::istringstream words(sentence);
  for (std::string word; words >> word;) {
    if (column > 0 && column + 1 + word.size() > most) {
      text += "\n  ";
      column = 2;
    } else if (column > 0) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text + '\n';
}

using Line = std::vector<std::string>;  // all of the same length

/// Words in the first and last column, numbers between them.
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
    lines.push_back({row_name(report, fit), b_text(report, {fit.value.B, fit.low.B, fit.high.B}),
                     rounded(report, fit.share), shortened(used_by(report, fit))});
  return with_words_outside(lines);
}

/// What the paper fits: sigma^S/sigma^L = s phi_S/phi_L, or k (phi_S/phi_L)^a.
std::string paper_text(const FitReport& report)
{
  if (!report.with_paper) return "";
  std::vector<Line> lines{
      {"as the paper fits", "s [95 %]", "B of s [95 %]", "k [95 %]", "a [95 %]"}};
  for (const auto& fit : report.rules) {
    const auto text = [&](double Estimators::*place) {
      return b_text(report, {fit.value.*place, fit.low.*place, fit.high.*place});
    };
    lines.push_back({row_name(report, fit), text(&Estimators::paper_s), text(&Estimators::paper_B),
                     text(&Estimators::paper_k), text(&Estimators::paper_a)});
  }
  return '\n' + with_words_outside(lines);
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
      if (rule_name(report, fit) == rule && fit.pair.larger == b && !fit.flow)
        text += fmt::format("{:>{}}", rounded(report, fit.value.B), width);
  }
  return text + '\n';
}

/// The numbers for all flows together under the rules that have B, and what each of them is.
std::string populations_text(const FitReport& report)
{
  std::string text;
  std::vector<Line> lines;
  for (const auto& fit : report.rules)
    for (const auto& [word, population, meaning] : populations) {
      const auto& b = fit.at(population);
      if (report.shares.size() < 2 || fit.flow || !std::isfinite(b.value)) continue;
      lines.push_back({row_name(report, fit), b_text(report, b), word});
    }
  if (!lines.empty()) {
    lines.insert(lines.begin(), {"all together", "B [95 %]", "over"});
    text += '\n' + with_words_outside(lines);
  }
  const auto words = estimands(report);
  if (!words.empty() && !report.flows.empty()) text += '\n';
  if (!report.flows.empty())
    for (const auto& [over, sentence] : words)
      text += wrapped(fmt::format("over {}: {}", word_of(over, populations), sentence));
  if (report.flows.size() < 2) return text;
  text += '\n';
  for (std::size_t m = 0; m < report.flows.size(); ++m)
    text += fmt::format("{}: {}, {}\n", report.flows[m].name,
                        counted(report.flows[m].tables.size(), "table"), share_words(report, m));
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
                          b_text(report, *a));
  }
  return text;
}

/// p* and dB/dp of each flow and of all, which no rule changes.
std::string line_text(const FitReport& report)
{
  std::string text;
  const auto name = report.rules.empty() ? "" : rule_name(report, report.rules.front());
  for (const auto& fit : report.rules)
    if (rule_name(report, fit) == name && std::isfinite(fit.line.p_zero.value))
      text += wrapped(fmt::format(
          "B = 0 where the large grain gets p* = {} of every mixed contact; dB/dp = {}{}",
          b_text(report, fit.line.p_zero.estimate()), b_text(report, fit.line.dB_dp.estimate()),
          report.is_by_flow() ? "; " + flow_name(report, fit) : ""));
  return text.empty() ? "" : '\n' + text;
}

std::string doubts_text(const FitReport& report)
{
  std::string text;
  for (const auto& doubt : doubts(report)) text += wrapped("doubt: " + doubt);
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
  text += paper_text(report);
  text += pairs_text(report);
  text += line_text(report);
  text += populations_text(report);
  for (const auto& names : report.shared_runs)
    text += fmt::format("counted as one run: {}\n", fmt::join(names, " "));
  return text + doubts_text(report);
}

}  // namespace grseg
