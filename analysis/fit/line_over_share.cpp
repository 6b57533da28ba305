// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/line_over_share.hpp"

#include "analysis/fit/estimators.hpp"

#include <cmath>

namespace grseg {
namespace {

std::vector<FitPoint> points_at(const FitData& data, double share, const FitSettings& settings)
{
  return fit_points(data, {PartitionRule::Kind::uniform, share}, settings);
}

/// What B(p) follows from at one share.
struct AtShare {
  WindowSums value;       // psi_L - phi_L
  WindowSums derivative;  // d psi_L/dp in its place
};

AtShare at_share(const FitData& data, double share, const FitSettings& settings)
{
  const auto none = points_at(data, 0, settings), all = points_at(data, 1, settings);
  const auto points = points_at(data, share, settings);
  auto slopes = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double large = all[k].large - none[k].large, total = all[k].total - none[k].total;
    const double psi = points[k].large / points[k].total;
    slopes[k].large = slopes[k].phi_large + (large - psi * total) / points[k].total;
    slopes[k].total = points[k].total > 0 ? 1 : 0;
  }
  return {window_sums(points, data.runs), window_sums(slopes, data.runs)};
}

/// Newton's method; one step where B(p) is straight.
double zero_of_b(const FitData& data, const FitSettings& settings)
{
  double share = 0.5;
  for (int step = 0; step < 8; ++step) {
    const auto at = at_share(data, share, settings);
    const double change = at.value.excess().sum() / at.derivative.excess().sum();
    if (!std::isfinite(change)) return change;
    share -= change;
    if (std::abs(change) < 1e-14) break;
  }
  return share;
}

}  // namespace

// With E the sum over frames of psi_L - phi_L, a window adds its part of E over -dE/dp to p*, and its
// part of dE/dp over sum f phi_L phi_S to dB/dp.
LineOverShare line_over_share(const FitData& data, const FitSettings& settings,
                              const Bootstrap& bootstrap, Population over)
{
  if (data.quantity != Quantity::contact || data.species.size() > 2) return {};
  const double zero = zero_of_b(data, settings);
  if (!std::isfinite(zero)) return {};
  const auto at = at_share(data, zero, settings);
  const Eigen::VectorXd weight = at.value.weight();
  const double change = at.derivative.excess().sum(), slope = change / weight.sum();
  if (bootstrap.count() == 0) return {{zero}, {slope}};
  const auto how_dependent = dependence(at.value, data.runs, true);
  const RunErrors run_errors(data, weight);
  const auto error = [&](const Eigen::VectorXd& sums, const Eigen::VectorXd& noise) {
    if (over == Population::windows)
      return bootstrap.window_error(bootstrap.blocks(how_dependent.block) * noise, how_dependent);
    if (over == Population::compositions)
      return bootstrap.run_error(bootstrap.whole_runs() * noise, how_dependent);
    return run_errors.within_flows(sums, noise);
  };
  return {{zero, error(at.value.excess() / -change, at.value.excess_noise() / -change)},
          {slope, error((at.derivative.excess() - slope * weight) / weight.sum(),
                        at.derivative.excess_noise() / weight.sum())}};
}

double share_of_large(const FitData& data, const std::vector<FitPoint>& points,
                      const FitSettings& settings)
{
  const auto none = points_at(data, 0, settings), all = points_at(data, 1, settings);
  double given = 0, mixed = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!(points[k].total > 0)) continue;
    given += points[k].frames * (points[k].excess() - none[k].excess());
    mixed += points[k].frames * (all[k].excess() - none[k].excess());
  }
  return given / mixed;
}

}  // namespace grseg
