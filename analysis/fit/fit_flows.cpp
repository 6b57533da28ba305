// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_flows.hpp"

#include "analysis/fit/flows.hpp"
#include "analysis/statistics/confidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace grseg {
namespace {

/// The unweighted mean over flows of what of(fit) gives.
template <class Of>
MeanOfEquals mean_of(const std::vector<RuleFit>& flows, const Of& of)
{
  std::vector<Measured> numbers;
  numbers.reserve(flows.size());
  for (const auto& fit : flows) numbers.push_back(of(fit));
  return mean_of_equals(numbers);
}

MeanOfEquals mean_of(const std::vector<RuleFit>& flows, double Estimators::*place)
{
  return mean_of(flows, [place](const RuleFit& fit) {
    return Measured{fit.value.*place, {fit.error.*place, fit.degrees}};
  });
}

std::string doubt_of_random(std::size_t flows)
{
  if (flows > 3) return {};
  return fmt::format(
      "{} flows tell little of how flows differ; four or more give a narrower "
      "interval",
      flows);
}

/// Makes the mean over flows the result. Whatever stands beside it is such a mean, too.
void take_mean(RuleFit& all, const std::vector<RuleFit>& flows)
{
  const bool random = all.over == Over::random_flows;
  const auto error_of = [random](const MeanOfEquals& mean) {
    return random ? mean.by_scatter : mean.by_errors;
  };
  for (const auto& [name, place] : estimator_columns) {
    const auto mean = mean_of(flows, place);
    all.value.*place = mean.value;
    set_error(all, place, error_of(mean));
  }
  const auto take = [&](const auto& of) {
    const auto mean = mean_of(flows, [&](const RuleFit& fit) { return of(fit); });
    of(all) = {mean.value, error_of(mean)};
  };
  take([](auto& fit) -> auto& { return fit.minus_size; });
  take([](auto& fit) -> auto& { return fit.line.p_zero; });
  take([](auto& fit) -> auto& { return fit.line.dB_dp; });
  for (const auto place : {&RuleFit::neutral, &RuleFit::share})
    all.*place = mean_of(flows, [place](const RuleFit& fit) { return Measured{fit.*place}; }).value;
}

/// What limits the intervals of such means.
void doubt_mean(RuleFit& all, const std::vector<RuleFit>& flows)
{
  const auto single =
      std::count_if(flows.begin(), flows.end(), [](const RuleFit& fit) { return fit.runs == 1; });
  all.doubt = all.over == Over::random_flows
                  ? doubt_of_random(flows.size())
                  : doubt_of_flows(all, static_cast<std::size_t>(single), flows.size());
}

/// Adds what rests on the flows one by one, and makes it the result where it was asked for.
void combine(RuleFit& all, const std::vector<RuleFit>& flows)
{
  const auto b = mean_of(flows, &Estimators::B);
  all.at(Over::equal_flows) = b.by_errors.around(b.value);
  all.at(Over::random_flows) = b.by_scatter.around(b.value);
  if (all.over != Over::equal_flows && all.over != Over::random_flows) return;
  take_mean(all, flows);
  doubt_mean(all, flows);
}

}  // namespace

FlowFits fit_flows(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                   const Resampling& resampling)
{
  const auto fit = [&](const FitData& of, const FitSettings& how) {
    return fit_rule(of, rule, how, Bootstrap(of.runs, resampling.samples, resampling.seed));
  };
  FlowFits fits{fit(data, settings), {}};
  if (data.number_of_flows() == 1) return fits;
  auto of_one = settings;
  of_one.over = Over::automatic;
  for (const auto flow : std::set(data.flows.begin(), data.flows.end())) {
    fits.of_each.push_back(fit(of_flow(data, flow), of_one));
    fits.of_each.back().flow = flow;
  }
  combine(fits.all, fits.of_each);
  return fits;
}

}  // namespace grseg
