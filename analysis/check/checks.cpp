// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/checks.hpp"

#include "formats/cli/table.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace grseg {

const std::array<CheckTolerances::Option, 12>& CheckTolerances::options()
{
  using T = CheckTolerances;
  static const std::array<Option, 12> all{
      {{"round-off", &T::round_off, "tolerance of checks that hold to round-off, relative"},
       {"single-precision", &T::single_precision, "the same tolerance, for files in float32"},
       {"mean-overlap", &T::mean_overlap, "tolerance of overlap_mean, d_S"},
       {"largest-overlap", &T::largest_overlap, "tolerance of overlap_largest, d_S"},
       {"mean-approach", &T::mean_approach, "tolerance of approach_mean, d_S per step"},
       {"largest-approach", &T::largest_approach, "tolerance of approach_largest, d_S per step"},
       {"false-alarm", &T::false_alarm,
        "probability that a statistical check fails by chance alone"},
       {"weight", &T::weight, "tolerance of weight: load of a layer over weight above, minus 1"},
       {"stress-ratio", &T::slope, "tolerance of slope and slope_across, ratio of stresses"},
       {"overlap-drift", &T::overlap_drift, "tolerance of overlap_drift, d_S over the run"},
       {"x-drift", &T::x_drift, "tolerance of x_drift and z_drift, sqrt(g d_S)"},
       {"least-load", &T::least_load, "skip layers whose load over the first layer's is less"}}};
  return all;
}

const char* CheckTolerances::option_of(double CheckTolerances::*value)
{
  const auto& all = options();
  return std::ranges::find(all, value, &Option::value)->name;
}

void CheckTolerances::require_valid() const
{
  for (const auto& [name, value, meaning] : options())
    if (!(this->*value >= 0) || !std::isfinite(this->*value))
      throw UsageError(fmt::format("--{} is {}: it must be 0 or more", name, this->*value));
  if (!(false_alarm > 0) || !(false_alarm < 1))
    throw UsageError(fmt::format("--false-alarm is {}: it must lie between 0 and 1", false_alarm));
}

namespace checks {

std::string listed()
{
  std::string text;
  for (const auto& check : all)
    text += fmt::format("  {:<20} {}\n{:<23}--{}; {}\n", check.name, check.measured, "",
                        CheckTolerances::option_of(check.tolerance), check.law);
  return text;
}

}  // namespace checks

namespace {

using Json = nlohmann::ordered_json;

bool is_layer(const CheckLine& line)
{
  return !std::isnan(line.y0);
}

std::string description(const CheckLine& line)
{
  if (line.quantity.starts_with('/')) return fmt::format("{} {}", line.quantity, line.remark);
  const auto where =
      is_layer(line) ? fmt::format(" at y = {:.4g} to {:.4g} m", line.y0, line.y1) : "";
  return fmt::format("{}{} is {:.3g} (at most {:.3g})", line.quantity, where, line.measured,
                     line.tolerance);
}

}  // namespace

CheckLine judged(const std::string& quantity, double measured, double tolerance,
                 const std::string& remark)
{
  CheckLine line;
  line.quantity = quantity;
  line.measured = measured;
  line.tolerance = tolerance;
  line.verdict = measured <= tolerance ? Verdict::passed : Verdict::failed;
  line.remark = remark;
  return line;
}

CheckLine skipped(const std::string& quantity, const std::string& why)
{
  CheckLine line;
  line.quantity = quantity;
  line.remark = why;
  return line;
}

std::string CheckReport::failures() const
{
  std::vector<std::string> failed;
  for (const auto& line : lines)
    if (line.verdict == Verdict::failed) failed.push_back(description(line));
  return failed.empty() ? "" : fmt::format("beyond tolerance: {}", fmt::join(failed, ", "));
}

std::string CheckReport::undecided() const
{
  std::vector<std::pair<std::string, int>> counts;
  for (const auto& line : lines) {
    if (line.verdict != Verdict::undecided) continue;
    if (counts.empty() || counts.back().first != line.quantity)
      counts.emplace_back(line.quantity, 0);
    ++counts.back().second;
  }
  if (counts.empty()) return "";
  const auto names = listed(counts, [](const auto& of) {
    return of.second > 1 ? fmt::format("{} ({} layers)", of.first, of.second) : of.first;
  });
  return fmt::format(
      "undecided, because chance alone can exceed the tolerance: {}; a longer run decides",
      fmt::join(names, ", "));
}

std::string to_tsv(const CheckReport& report)
{
  std::vector<std::vector<std::string>> rows;
  for (const auto& line : report.lines)
    rows.push_back({line.quantity, format_number(line.y0), format_number(line.y1),
                    format_number(line.measured), format_number(line.error),
                    format_number(line.tolerance), to_text(line.verdict), line.remark});
  return table_text(
      report.header,
      {"quantity", "y0[m]", "y1[m]", "measured", "error", "tolerance", "verdict", "remark"}, rows);
}

std::string to_json(const CheckReport& report)
{
  Json all;
  all["lines"] = Json::array();
  for (const auto& line : report.lines) {
    Json object{{"quantity", printable(line.quantity)}};
    if (is_layer(line)) object["layer"] = {line.y0, line.y1};
    object["measured"] = line.measured;
    object["error"] = line.error;
    object["tolerance"] = line.tolerance;
    object["verdict"] = to_text(line.verdict);
    object["remark"] = printable(line.remark);
    all["lines"].push_back(object);
  }
  all["passed"] = report.failures().empty();
  all["undecided"] = std::ranges::count_if(
      report.lines, [](const CheckLine& line) { return line.verdict == Verdict::undecided; });
  all["history"] = Json::array();
  for (const auto& [key, value] : report.header) {
    if (key == "history" || key == "verified" || key == "incomplete")
      all[key].push_back(printable(value));
    else
      all["settings"][key] = printable(value);
  }
  return all.dump(2) + '\n';
}

namespace {

std::string place_of(const WorstCase& worst, const std::string& what)
{
  if (worst.count == 0) return "there is none";
  if (worst.largest == 0) return "";
  const auto at = fmt::format("at t = {:.6g} s", worst.time);
  return what.empty() ? at : fmt::format("{}, {} {}", at, what, worst.number);
}

}  // namespace

double Judge::tolerance_of(const Check& check) const
{
  const bool rounded = single_precision_ && check.tolerance == &CheckTolerances::round_off;
  return rounded ? tolerances_.single_precision : tolerances_.*check.tolerance;
}

CheckLine Judge::largest(const Check& check, const WorstCase& worst, const std::string& what,
                         double unit) const
{
  return judged(check.name, worst.largest / unit, tolerance_of(check), place_of(worst, what));
}

CheckLine Judge::mean(const Check& check, const WorstCase& worst, double unit) const
{
  return judged(check.name, worst.mean() / unit, tolerance_of(check));
}

CheckLine Judge::statistical(const Check& check, double deviation, double error,
                             std::size_t windows, std::size_t together) const
{
  const double tail = tolerances_.false_alarm / 2 / static_cast<double>(together);
  const double quantile = gsl_cdf_tdist_Qinv(tail, static_cast<double>(windows) - 1);
  const double stated = tolerances_.*check.tolerance, chance = quantile * error;
  auto line = judged(check.name, std::abs(deviation), std::max(stated, chance));
  line.error = error;
  if (line.verdict == Verdict::passed && chance > stated) line.verdict = Verdict::undecided;
  return line;
}

}  // namespace grseg
