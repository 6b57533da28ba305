// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/judge.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

CheckLine line_of(const Check& check, double measured, double tolerance, const std::string& remark)
{
  CheckLine line;
  line.quantity = check.name;
  line.measured = measured;
  line.tolerance = tolerance;
  line.verdict = measured <= tolerance ? Verdict::passed : Verdict::failed;
  line.remark = remark;
  return line;
}

std::string place_of(const WorstCase& worst, const std::string& what)
{
  if (worst.count == 0) return "there is none";
  if (worst.largest == 0) return "";
  const auto at = fmt::format("at t = {:.6g} s", worst.time);
  return what.empty() ? at : fmt::format("{}, {} {}", at, what, worst.number);
}

}  // namespace

CheckLine Judge::skipped(const Check& check, const std::string& why)
{
  CheckLine line;
  line.quantity = check.name;
  line.remark = why;
  return line;
}

double Judge::tolerance_of(const Check& check) const
{
  const bool rounded = single_precision_ && check.tolerance == &CheckTolerances::round_off;
  return rounded ? tolerances_.single_precision : tolerances_.*check.tolerance;
}

CheckLine Judge::largest(const Check& check, const WorstCase& worst, const std::string& what,
                         double unit) const
{
  return line_of(check, worst.largest / unit, tolerance_of(check), place_of(worst, what));
}

CheckLine Judge::mean(const Check& check, const WorstCase& worst, double unit) const
{
  return line_of(check, worst.mean() / unit, tolerance_of(check), "");
}

CheckLine Judge::statistical(const Check& check, double deviation, double error,
                             std::size_t windows, std::size_t together) const
{
  const double tail = tolerances_.false_alarm / 2 / static_cast<double>(together);
  const double quantile = gsl_cdf_tdist_Qinv(tail, static_cast<double>(windows) - 1);
  const double stated = tolerances_.*check.tolerance, chance = quantile * error;
  auto line = line_of(check, std::abs(deviation), std::max(stated, chance), "");
  line.error = error;
  if (line.verdict == Verdict::passed && chance > stated) line.verdict = Verdict::undecided;
  return line;
}

}  // namespace grseg
