// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/run_errors.hpp"

#include "analysis/statistics/confidence.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <map>

namespace grseg {
namespace {

Eigen::VectorXd values_of(const Estimators& estimators)
{
  Eigen::VectorXd values(static_cast<Eigen::Index>(estimator_columns.size()));
  for (std::size_t k = 0; k < estimator_columns.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = estimators.*estimator_columns[k].value;
  return values;
}

/// d(estimators)/d(sums), a row per sum, by central differences.
Eigen::MatrixXd derivatives(const Eigen::MatrixXd& sums)
{
  constexpr double relative_step = 1e-5;
  const Eigen::RowVectorXd total = sums.colwise().sum(), scale = sums.cwiseAbs().colwise().sum();
  Eigen::MatrixXd slope(sums.cols(), static_cast<Eigen::Index>(estimator_columns.size()));
  for (Eigen::Index k = 0; k < sums.cols(); ++k) {
    const double step = scale[k] > 0 ? relative_step * scale[k] : relative_step;
    auto up = total, down = total;
    up[k] += step;
    down[k] -= step;
    slope.row(k) =
        (values_of(estimators_from_sums(up)) - values_of(estimators_from_sums(down))) / (2 * step);
  }
  return slope;
}

}  // namespace

Eigen::Index column_of_estimator(double Estimators::*place)
{
  const auto at = std::find_if(estimator_columns.begin(), estimator_columns.end(),
                               [place](const auto& column) { return column.value == place; });
  return at - estimator_columns.begin();
}

Influences influences_of(const WindowSums& windows)
{
  const Eigen::MatrixXd slope = derivatives(windows.sums);
  return {windows.sums * slope, windows.noise * slope};
}

RunErrors::RunErrors(const FitData& data, const Eigen::VectorXd& weight) : weight_(weight)
{
  std::map<std::size_t, Group> groups;
  std::size_t first = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    auto& group = groups[data.flow_of(run)];
    group.first.push_back(first);
    group.length.push_back(data.runs[run]);
    first += data.runs[run];
  }
  for (auto& [flow, group] : groups) {
    group.weight.resize(static_cast<Eigen::Index>(group.first.size()));
    for (std::size_t k = 0; k < group.first.size(); ++k)
      group.weight[static_cast<Eigen::Index>(k)] =
          weight
              .segment(static_cast<Eigen::Index>(group.first[k]),
                       static_cast<Eigen::Index>(group.length[k]))
              .sum();
    groups_.push_back(std::move(group));
  }
}

StandardError RunErrors::within_flows(const Eigen::VectorXd& sums,
                                      const Eigen::VectorXd& noise) const
{
  std::vector<StandardError> parts;
  for (const auto& group : groups_) {
    const auto run = [&group](const Eigen::VectorXd& of_windows, std::size_t k) {
      return of_windows.segment(static_cast<Eigen::Index>(group.first[k]),
                                static_cast<Eigen::Index>(group.length[k]));
    };
    if (group.first.size() == 1) {
      const Eigen::VectorXd own = run(noise, 0);
      parts.push_back(standard_error(own - own.sum() / group.weight[0] * run(weight_, 0), 1));
      continue;
    }
    Eigen::VectorXd of_runs(group.weight.size());
    for (std::size_t k = 0; k < group.first.size(); ++k)
      of_runs[static_cast<Eigen::Index>(k)] = run(sums, k).sum();
    parts.push_back(scatter_of_runs(of_runs, group.weight));
  }
  return added(parts);
}

double RunErrors::chance_of_likeness(const Eigen::VectorXd& influence, double fitted) const
{
  double sum = 0, all = 0, within = 0, of_means = 0;
  std::size_t runs = 0;
  for (const auto& group : groups_) {
    Eigen::VectorXd value(group.weight.size());
    for (std::size_t k = 0; k < group.first.size(); ++k) {
      const auto place = static_cast<Eigen::Index>(k);
      value[place] = influence
                         .segment(static_cast<Eigen::Index>(group.first[k]),
                                  static_cast<Eigen::Index>(group.length[k]))
                         .sum() /
                     group.weight[place];
    }
    const double weight = group.weight.sum(), mean = group.weight.dot(value) / weight;
    within += group.weight.dot((value.array() - mean).square().matrix());
    of_means += weight * mean * mean;
    sum += weight * mean;
    all += weight;
    runs += group.first.size();
  }
  const auto within_degrees = static_cast<double>(runs - groups_.size());
  if (groups_.size() < 2 || !(within_degrees > 0) || !(within > 0)) return 1;
  const double between_degrees = std::max(1.0, static_cast<double>(groups_.size()) - fitted);
  const double between = of_means - sum * sum / all;
  return gsl_cdf_fdist_Q(between / between_degrees / (within / within_degrees), between_degrees,
                         within_degrees);
}

std::size_t RunErrors::single_runs() const
{
  return static_cast<std::size_t>(std::count_if(
      groups_.begin(), groups_.end(), [](const Group& group) { return group.first.size() == 1; }));
}

}  // namespace grseg
