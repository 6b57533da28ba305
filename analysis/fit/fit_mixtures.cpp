// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_mixtures.hpp"

#include "analysis/fit/mixtures.hpp"
#include "analysis/statistics/run_scatter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace grseg {
namespace {

/// The unweighted mean over mixtures of what of(fit) gives.
template <class Of>
MeanOfEquals mean_of(const std::vector<RuleFit>& mixtures, const Of& of)
{
  std::vector<Measured> numbers;
  numbers.reserve(mixtures.size());
  for (const auto& fit : mixtures) numbers.push_back(of(fit));
  return mean_of_equals(numbers);
}

MeanOfEquals mean_of(const std::vector<RuleFit>& mixtures, double Estimators::*place)
{
  return mean_of(mixtures, [place](const RuleFit& fit) {
    return Measured{fit.value.*place, {fit.error.*place, fit.degrees}};
  });
}

std::string doubt_of_random(std::size_t mixtures)
{
  if (mixtures > 3) return {};
  return fmt::format(
      "{} mixtures tell little of how mixtures differ; four or more give a narrower "
      "interval",
      mixtures);
}

/// Makes the mean over mixtures the result. Whatever stands beside it is such a mean, too.
void take_mean(RuleFit& all, const std::vector<RuleFit>& mixtures)
{
  const bool random = all.over == Over::random_mixtures;
  const auto error_of = [random](const MeanOfEquals& mean) {
    return random ? mean.by_scatter : mean.by_errors;
  };
  for (const auto& [name, place] : estimator_columns) {
    const auto mean = mean_of(mixtures, place);
    all.value.*place = mean.value;
    set_error(all, place, error_of(mean));
  }
  for (const auto place : {&RuleFit::p_zero_sums, &RuleFit::minus_size}) {
    const auto mean = mean_of(mixtures, [place](const RuleFit& fit) { return fit.*place; });
    all.*place = {mean.value, error_of(mean)};
  }
  for (const auto place : {&RuleFit::neutral, &RuleFit::share})
    all.*place =
        mean_of(mixtures, [place](const RuleFit& fit) { return Measured{fit.*place}; }).value;
  all.B_half_windows = all.B_sums_windows = {Estimators::nan, Estimators::nan};
}

/// What limits the intervals of such means.
void doubt_mean(RuleFit& all, const std::vector<RuleFit>& mixtures, double window)
{
  if (all.points == 0) return;
  const auto single = std::count_if(mixtures.begin(), mixtures.end(),
                                    [](const RuleFit& fit) { return fit.runs == 1; });
  all.doubt = all.over == Over::random_mixtures
                  ? doubt_of_random(mixtures.size())
                  : doubt_of_mixtures(all, static_cast<std::size_t>(single), mixtures.size());
  add_doubt(all, doubt_of_logarithms(all, window));
}

/// Adds what rests on the mixtures one by one, and makes it the result where it was asked for.
void combine(RuleFit& all, const std::vector<RuleFit>& mixtures, double window)
{
  const auto b = mean_of(mixtures, &Estimators::B_half);
  all.at(Over::equal_mixtures) = b.by_errors.around(b.value);
  all.at(Over::random_mixtures) = b.by_scatter.around(b.value);
  const auto sums = mean_of(mixtures, &Estimators::B_sums);
  all.sums_at(Over::equal_mixtures) = sums.by_errors.around(sums.value);
  all.sums_at(Over::random_mixtures) = sums.by_scatter.around(sums.value);
  if (all.over != Over::equal_mixtures && all.over != Over::random_mixtures) return;
  take_mean(all, mixtures);
  doubt_mean(all, mixtures, window);
}

MixtureFits fit_component(const FitData& data, const PartitionRule& rule,
                          const FitSettings& settings, const Resampling& resampling)
{
  const auto fit = [&](const FitData& of, const FitSettings& how) {
    return fit_rule(of, rule, how, Bootstrap(of.runs, resampling.samples, resampling.seed));
  };
  MixtureFits fits{fit(data, settings), {}};
  if (data.number_of_mixtures() == 1) return fits;
  auto of_one = settings;
  of_one.over = Over::automatic;
  for (const auto mixture : std::set(data.mixtures.begin(), data.mixtures.end())) {
    fits.of_each.push_back(fit(of_mixture(data, mixture), of_one));
    fits.of_each.back().mixture = mixture;
  }
  combine(fits.all, fits.of_each, data.window);
  return fits;
}

}  // namespace

MixtureFits fit_mixtures(const FitData& data, const PartitionRule& rule,
                         const FitSettings& settings, const Resampling& resampling)
{
  auto fits = fit_component(data, rule, settings, resampling);
  auto swapped = settings;
  const bool is_yy = settings.component == Component::yy;
  swapped.component = is_yy ? Component::pressure : Component::yy;
  MixtureFits others = fits;
  const bool has_other = rule.adds_up() && has_stresses(data, rule, swapped);
  if (has_other) others = fit_component(data, rule, swapped, resampling);
  const auto set = [&](RuleFit& fit, const RuleFit& other) {
    const auto b_half = [](const RuleFit& of) {
      return Estimate{of.value.B_half, of.low.B_half, of.high.B_half};
    };
    (is_yy ? fit.B_yy : fit.B_pressure) = b_half(fit);
    if (has_other) (is_yy ? fit.B_pressure : fit.B_yy) = b_half(other);
  };
  set(fits.all, others.all);
  for (std::size_t k = 0; k < fits.of_each.size(); ++k) set(fits.of_each[k], others.of_each[k]);
  return fits;
}

}  // namespace grseg
