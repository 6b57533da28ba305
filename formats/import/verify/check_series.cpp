// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/check_series.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <string>

namespace grseg {
namespace {

/// Calls `visit` with name, unit and place of every number of a moment.
template <class Moment, class Visit>
void visit_numbers(Moment& moment, const Visit& visit)
{
  visit("distance", "", moment.distance);
  visit("gap", "", moment.gap);
  visit("overlap", "", moment.overlap);
  visit("pull", "", moment.pull);
  visit("unlisted", "", moment.unlisted);
  visit("unlisted_pairs", "", moment.unlisted_pairs);
  visit("unlisted_may_part", "", moment.unlisted_may_part);
  visit("rigid", "", moment.rigid);
  visit("balance", "", moment.balance);
  visit("balance_grains", "", moment.balance_grains);
  visit("balance_worst", "", moment.balance_worst);
  visit("change", "", moment.change);
  visit("acceleration", "m s-2", moment.acceleration);
  visit("medians", "", moment.medians);
  const auto visit_estimate = [&](const std::string& name, auto& estimate) {
    visit(name + "_grains", "", estimate.grains);
    visit(name + "_x", "m s-2", estimate.gravity.x());
    visit(name + "_y", "m s-2", estimate.gravity.y());
    visit(name + "_z", "m s-2", estimate.gravity.z());
    visit(name + "_error", "m s-2", estimate.error);
  };
  visit_estimate("gravity", moment.all);
  visit_estimate("gravity_smaller", moment.smaller);
  visit_estimate("gravity_larger", moment.larger);
  const auto visit_sums = [&](const std::string& name, auto& sums, const char* square,
                              const char* fourth) {
    visit(name + "_grains", "", sums.grains);
    visit(name + "_xx", square, sums.xx);
    visit(name + "_xy", square, sums.xy);
    visit(name + "_yy", square, sums.yy);
    visit(name + "_xx_xx", fourth, sums.xx_xx);
    visit(name + "_xx_xy", fourth, sums.xx_xy);
    visit(name + "_xy_xy", fourth, sums.xy_xy);
  };
  visit_sums("motion", moment.motion, "", "");
  visit_sums("force", moment.force, "m2 s-4", "m4 s-8");
}

}  // namespace

SlopeSums& SlopeSums::operator+=(const SlopeSums& other)
{
  grains += other.grains, xx += other.xx, xy += other.xy, yy += other.yy;
  xx_xx += other.xx_xx, xx_xy += other.xx_xy, xy_xy += other.xy_xy;
  return *this;
}

CheckMoment in_si(CheckMoment moment, const Units& units)
{
  const double acceleration = units.acceleration(), square = acceleration * acceleration;
  moment.time *= units.time;
  moment.acceleration *= acceleration;
  for (auto* estimate : {&moment.all, &moment.smaller, &moment.larger}) {
    estimate->gravity *= acceleration;
    estimate->error *= acceleration;
  }
  auto& force = moment.force;
  for (auto* sum : {&force.xx, &force.xy, &force.yy}) *sum *= square;
  for (auto* sum : {&force.xx_xx, &force.xx_xy, &force.xy_xy}) *sum *= square * square;
  return moment;
}

const std::vector<Observable>& check_observables()
{
  static const auto observables = [] {
    std::vector<Observable> all;
    const CheckMoment moment;
    visit_numbers(moment, [&](const std::string& name, const char* unit, const double&) {
      all.push_back({"check_" + name, unit});
    });
    return all;
  }();
  return observables;
}

std::vector<double> check_values(const CheckMoment& moment)
{
  std::vector<double> values;
  visit_numbers(moment, [&](const std::string&, const char*, const double& value) {
    values.push_back(value);
  });
  return values;
}

void set_check_values(CheckMoment& moment, const std::vector<double>& values)
{
  auto value = values.begin();
  visit_numbers(moment, [&](const std::string&, const char*, double& place) { place = *value++; });
}

CheckSeries check_series(const TrajectoryReader& run)
{
  CheckSeries series(run.size());
  for (std::size_t k = 0; k < run.size(); ++k) {
    series[k].step = run.steps()[k];
    series[k].time = run.times()[k];
  }
  std::vector<std::vector<double>> columns;
  for (const auto& [name, unit] : check_observables()) {
    if (!run.has_observable(name))
      throw FormatError(fmt::format("{}: /observables/{} is missing: import the archive again",
                                    run.path(), name));
    columns.push_back(run.observable(name));
  }
  for (std::size_t k = 0; k < run.size(); ++k) {
    auto column = columns.begin();
    visit_numbers(series[k],
                  [&](const std::string&, const char*, double& place) { place = (*column++)[k]; });
  }
  return series;
}

}  // namespace grseg
