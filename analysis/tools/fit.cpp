// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"
#include "analysis/fit/make_report.hpp"
#include "analysis/frames/presets.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace grseg;

namespace {

constexpr ToolInfo info{
    "grseg-fit", "the segregation strength B, with its interval, from tables of sums.",
    "grseg-fit sums.tsv ... [options]    (-: standard input)",
    "  grseg-fit sums.tsv                               B by size, the default\n"
    "  grseg-fit sums.tsv --partition stock             B by the rules of published codes\n"
    "  grseg-fit sums.tsv --short -o fit.tsv            a short table, and all numbers in a file\n"
    "  grseg-fit a.tsv b.tsv --partition size,half      several runs, several rules\n"
    "  grseg-fit phi*/*.tsv                             B of each flow, then of all\n"
    "  grseg-fit phi*/*.tsv --over windows             one B of all, over the windows of these runs\n"
    "  grseg-fit sums.tsv --scan 0.4:0.9:0.005          B as function of the large grain's share\n"
    "  grseg-fit sums.tsv --series -o series.tsv        B and the motion of the bed over time\n"
    "  grseg-fit thick.tsv --minus thin.tsv             how much the thickness of layers moves B\n"
    "  grseg-fit kinetic.tsv --quantity kinetic         B of the kinetic stress\n"
    "  grseg-stress run.h5 | grseg-fit - --json         through a pipe, without a file\n"
    "\nLarge grains bear the share psi_L = phi_L (1 + B phi_S) of the stress, where phi_L and phi_S are\n"
    "the species' shares of the grains' area or volume. B > 0: large grains bear more than phi_L.\n"
    "Input: tables of grseg-stress or, with --quantity kinetic, of grseg-kinetic.\n",
    presets::fit};

/// True if two values of the header line `key` differ. Lengths may have been given in diameters, so
/// they are compared with the tolerance of diameters.
bool differ(const std::string& key, const std::string& a, const std::string& b)
{
  if (same_setting(a, b)) return false;
  const auto x = parse_number(a), y = parse_number(b);
  const bool length = key == "layer" || key == "width";
  return !length || !x || !y ||
         std::abs(*x - *y) > diameter_tolerance * std::max(std::abs(*x), std::abs(*y));
}

/// Prints remarks on standard error: settings in which the tables differ and, with `with_doubts`,
/// the doubts of the report, which the short table contains itself.
void remark(const std::vector<Table>& tables, const FitReport& report, bool with_doubts)
{
  for (const char* key : {"bins", "cell", "assign", "width", "layer", "window", "base", "partition",
                          "step", "mean", "velocity", "composition", "volume", "origin"})
    for (const auto& table : tables)
      if (differ(key, header_or(table, key, ""), header_or(tables[0], key, "")))
        std::cerr << fmt::format("{}: {} and {} differ in '{}'\n", info.name,
                                 printable(tables[0].name), printable(table.name), key);
  if (!with_doubts) return;
  for (const auto& doubt : doubts(report)) std::cerr << fmt::format("{}: {}\n", info.name, doubt);
}

/// Throws RunError with the reason if there is no number to print.
void require_numbers(const FitReport& report)
{
  const auto has_number = [&](const RuleFit& fit) {
    return std::isfinite(fit.value.B) || (report.with_paper && std::isfinite(fit.value.paper_s));
  };
  const auto& fits = report.scan ? report.scan->fits : report.rules;
  if (std::ranges::any_of(fits, has_number)) return;
  const auto& first = fits.front();
  throw RunError(fmt::format(
      "{}: {}", rule_name(report, first),
      first.rule.adds_up() ? first.doubt
                           : "there is no B, because the species' stresses do not add up to the "
                             "whole; --fit paper prints what can be fitted"));
}

}  // namespace

int main(int argc, char** argv)
{
  FitOptions options;
  const auto description = options.description();
  return run_tool(argc, argv, info, description, [&](const po::variables_map& values) {
    options.check(values);
    const auto tables = read_tables(values, options.wanted());
    auto report = make_report(info, options, preset_of(values), tables);
    report.history.push_back(command_line(argc, argv));
    require_numbers(report);
    const bool brief =
        options.output.prints_short() && !options.json && !report.scan && report.series.empty();
    if (!options.quiet) remark(tables, report, !brief);
    report.digits = options.output.digits;
    write_table(options.output, options.json ? to_json(report) : to_tsv(report),
                brief ? short_table(report) : "");
  });
}
