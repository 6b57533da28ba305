// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/data_doubts.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/statistics/correlated_windows.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace grseg {
namespace {

/// Warning that two tables of one run belong to different flows; "" if there are none.
std::string doubt_of_flows(const std::vector<FitTable>& tables)
{
  for (const auto& one : tables)
    for (const auto& other : tables)
      if (one.run == other.run && one.flow < other.flow)
        return fmt::format(
            "{} and {} are of different flows, but begin from one bed: intervals over several "
            "flows assume that their errors are independent",
            one.table->name, other.table->name);
  return "";
}

}  // namespace

std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data)
{
  std::vector<std::string> doubts{find_runs(tables).doubt(tables), doubt_of_flows(read)};
  std::erase(doubts, "");
  if (data.still > 0)
    doubts.push_back(fmt::format(
        "{} of {} windows equal the window before them, because no grain moves; they are not "
        "counted as observations",
        data.still, number_of_windows(data.runs) + data.still));
  return doubts;
}

namespace {

constexpr double rarely =
    0.025;  // chance below which a series is not steady; 5 % for either of two series
constexpr Eigen::Index fewest_windows = 10;
constexpr double fewest_independent = 2;

/// Mean of a run's first tenth minus the mean of its last half, with the error of the difference.
std::optional<Measured> compare(const Eigen::VectorXd& run)
{
  if (run.size() < fewest_windows) return {};
  const auto early = run.size() / 10, late = run.size() / 2;
  const Eigen::VectorXd last = run.tail(late);
  const double time = autocorrelation_time(last, {static_cast<std::size_t>(late)});
  const double independent = static_cast<double>(late) / time;
  if (independent < fewest_independent) return {};
  const double squares = (last.array() - last.mean()).square().sum();
  // Correlation reduces the sum of squares about the mean by (n_eff - 1)/n_eff.
  const double variance = squares / static_cast<double>(late) * independent / (independent - 1);
  const double error = std::sqrt(
      variance * (1 / std::max(1.0, static_cast<double>(early) / time) + 1 / independent));
  return Measured{run.head(early).mean() - last.mean(), {error, independent - 1}};
}

/// The test of start_of_flow, without the first fraction `left_out` of each run's windows.
std::optional<StartOfFlow> compare(const Eigen::VectorXd& series, const RunLengths& runs,
                                   double left_out)
{
  std::vector<StandardError> errors;
  double excess = 0;
  Eigen::Index first = 0;
  for (const auto windows : runs) {
    const auto length = index(windows);
    const auto begin = static_cast<Eigen::Index>(std::ceil(left_out * static_cast<double>(length)));
    const auto run = compare(series.segment(first + begin, length - begin));
    first += length;
    if (!run) return {};
    excess += run->value;
    errors.push_back(run->error);
  }
  const auto error = added(errors);
  const double t = std::abs(excess) / error.error;
  if (!std::isfinite(t)) return {};
  return StartOfFlow{excess / static_cast<double>(runs.size()),
                     2 * gsl_cdf_tdist_Q(t, error.degrees)};
}

/// Time, s, that lies the fraction `left_out` after the begin of the earliest window.
double time_after(const FitData& data, double left_out)
{
  double begin = data.samples.front().key.begin, end = begin;
  for (const auto& sample : data.samples) {
    begin = std::min(begin, sample.key.begin);
    end = std::max(end, sample.key.end);
  }
  return begin + left_out * (end - begin);
}

/// A number per window that is constant in a steady flow. For contact stress it is
/// |sigma_xy|/sigma_yy: the tangent of the slope in a steady chute, and less if the flow
/// accelerates. For kinetic stress it is sigma_yy, which grows with the speed.
Eigen::VectorXd motion_by_window(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings)
{
  Eigen::VectorXd shear = Eigen::VectorXd::Zero(index(number_of_windows(data.runs)));
  Eigen::VectorXd normal = shear;
  for (const auto& sample : data.samples) {
    const auto stress = partial_stress(data.rows[sample.row], rule, settings.base).total;
    shear[index(sample.window)] += sample.frames * stress(0, 1);
    normal[index(sample.window)] += sample.frames * stress(1, 1);
  }
  return data.quantity == Quantity::kinetic ? normal : (shear.array() / normal.array()).abs();
}

}  // namespace

std::optional<StartOfFlow> start_of_flow(const Eigen::VectorXd& series, const RunLengths& runs)
{
  auto found = compare(series, runs, 0);
  if (!found || found->chance >= rarely) return found;
  found->leave_out = 1;
  for (int twentieths = 10; twentieths >= 1; --twentieths) {
    const auto rest = compare(series, runs, twentieths / 20.0);
    if (rest && !(rest->chance < rarely)) found->leave_out = twentieths / 20.0;
  }
  return found;
}

std::string doubt_of_start(const FitData& data, const PartitionRule& rule,
                           const FitSettings& settings)
{
  if (!rule.adds_up()) return {};
  const bool kinetic = data.quantity == Quantity::kinetic;
  std::string differs;
  double leave_out = 0;
  const auto add = [&](const std::string& name, const Eigen::VectorXd& series) {
    const auto found = start_of_flow(series, data.runs);
    if (!found || !(found->chance < rarely)) return;
    differs += fmt::format("{}{} is {} by {:.2g}", differs.empty() ? "" : " and ", name,
                           found->excess > 0 ? "larger" : "smaller", std::abs(found->excess));
    leave_out = std::max(leave_out, found->leave_out);
  };
  add(kinetic ? "the kinetic stress (yy)" : "|sigma_xy|/sigma_yy",
      motion_by_window(data, rule, settings));
  // The series is the noise of B: the part that the composition of the layers does not explain.
  const auto windows = window_sums(fit_points(data, rule, settings), data.runs);
  add("B by " + rule.name(), windows.excess_noise() / windows.weight().mean());
  if (differs.empty()) return {};
  const auto remedy = leave_out < 1 ? fmt::format("--begin {:.4g} leaves the start out",
                                                  time_after(data, leave_out))
                                    : "the flow is not steady after any later --begin either";
  return fmt::format(
      "{} in the first tenth of the time than in the last half; in a steady flow such a difference "
      "has a probability below 5 % (Geweke's test); {}",
      differs, remedy);
}

namespace {

/// Noise of the windows' excess: its difference from a B that changes linearly in each run.
Eigen::VectorXd noise_about_lines(const Eigen::VectorXd& excess, const Eigen::VectorXd& weight,
                                  const RunLengths& runs)
{
  Eigen::VectorXd noise = excess;
  Eigen::Index begin = 0;
  for (const auto length : runs) {
    const auto count = index(length);
    const auto of_run = weight.segment(begin, count);
    Eigen::MatrixX2d line(count, 2);
    line << of_run, of_run.cwiseProduct(Eigen::VectorXd::LinSpaced(count, -1, 1));
    noise.segment(begin, count) -=
        line * line.colPivHouseholderQr().solve(excess.segment(begin, count));
    begin += count;
  }
  return noise;
}

/// Sum of `series` over the first and over the last third of each run's windows.
std::array<double, 2> sums_of_thirds(const Eigen::VectorXd& series, const RunLengths& runs)
{
  std::array<double, 2> sums{};
  Eigen::Index end = 0;
  for (const auto length : runs) {
    const auto third = index(length) / 3;
    sums[0] += series.segment(end, third).sum();
    end += index(length);
    sums[1] += series.segment(end - third, third).sum();
  }
  return sums;
}

}  // namespace

std::optional<ChangeOfB> change_of_b(const WindowSums& windows, const RunLengths& runs)
{
  const auto noise = noise_about_lines(windows.excess(), windows.weight(), runs);
  const double time = autocorrelation_time(noise, runs);
  const double independent = static_cast<double>(noise.size()) / time;
  const double degrees = independent - 2 * static_cast<double>(runs.size());
  if (!(degrees >= fewest_independent)) return {};
  const double variance = noise.squaredNorm() / static_cast<double>(noise.size()) * independent /
                          degrees * time;  // of a sum over windows, per window
  const auto above = sums_of_thirds(windows.excess(), runs);
  const auto below = sums_of_thirds(windows.weight(), runs);
  const auto count = sums_of_thirds(Eigen::VectorXd::Ones(noise.size()), runs);
  const double first = above[0] / below[0], last = above[1] / below[1];
  const double error =
      std::sqrt(variance * (count[0] / (below[0] * below[0]) + count[1] / (below[1] * below[1])));
  const double t = std::abs(first - last) / error;
  if (!std::isfinite(t)) return {};
  return ChangeOfB{first, last, 2 * gsl_cdf_tdist_Q(t, degrees)};
}

std::string doubt_of_change(const FitData& data, const PartitionRule& rule,
                            const FitSettings& settings)
{
  if (!rule.adds_up()) return {};
  const auto found =
      change_of_b(window_sums(fit_points(data, rule, settings), data.runs), data.runs);
  if (!found || !(found->chance < rarely)) return {};
  return fmt::format(
      "B {} from {:.3f} in the first third of the time to {:.3f} in the last: this flow has no "
      "single B, and a longer run has another; the intervals are over these times alone",
      found->first > found->last ? "falls" : "rises", found->first, found->last);
}

}  // namespace grseg
