// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_mixtures.hpp"

#include "analysis/fit/mixtures.hpp"
#include "analysis/statistics/run_scatter.hpp"

#include <fmt/format.h>

#include <set>

namespace grseg {
namespace {

struct Mean {
  double value;
  StandardError equal, random;
};

/// The unweighted mean over mixtures with its errors over equal and over random mixtures, of numbers
/// that value(fit) and error(fit) give.
template <class Value, class Error>
Mean mean_of(const std::vector<RuleFit>& mixtures, const Value& value, const Error& error)
{
  const auto count = static_cast<double>(mixtures.size());
  Eigen::VectorXd values(static_cast<Eigen::Index>(mixtures.size()));
  std::vector<StandardError> parts;
  for (std::size_t k = 0; k < mixtures.size(); ++k) {
    values[static_cast<Eigen::Index>(k)] = value(mixtures[k]);
    parts.push_back({error(mixtures[k]) / count, mixtures[k].degrees});
  }
  return {values.mean(), added(parts), scatter_of_values(values)};
}

Mean mean_of(const std::vector<RuleFit>& mixtures, double Estimators::*place)
{
  return mean_of(
      mixtures, [place](const RuleFit& fit) { return fit.value.*place; },
      [place](const RuleFit& fit) { return fit.error.*place; });
}

Mean mean_of_zeros(const std::vector<RuleFit>& mixtures)
{
  return mean_of(
      mixtures, [](const RuleFit& fit) { return fit.p_zero_sums.value; },
      [](const RuleFit& fit) { return fit.p_zero_sums_error.error; });
}

std::string doubt_of_random(std::size_t mixtures)
{
  if (mixtures > 3) return {};
  return fmt::format(
      "{} mixtures tell little of how mixtures differ; four or more give a narrower "
      "interval",
      mixtures);
}

/// Adds what rests on the mixtures one by one, and makes it the result where it was asked for.
void combine(RuleFit& all, const std::vector<RuleFit>& mixtures)
{
  const bool equal = all.over == Over::equal_mixtures, random = all.over == Over::random_mixtures;
  const auto b = mean_of(mixtures, &Estimators::B_half);
  all.at(Over::equal_mixtures) = b.equal.around(b.value);
  all.at(Over::random_mixtures) = b.random.around(b.value);
  const auto sums = mean_of(mixtures, &Estimators::B_sums);
  all.sums_at(Over::equal_mixtures) = sums.equal.around(sums.value);
  all.sums_at(Over::random_mixtures) = sums.random.around(sums.value);
  if (!equal && !random) return;
  for (const auto& [name, place] : estimator_columns) {
    const auto mean = mean_of(mixtures, place);
    all.value.*place = mean.value;
    set_error(all, place, equal ? mean.equal : mean.random);
  }
  const auto zero = mean_of_zeros(mixtures);
  all.p_zero_sums_error = equal ? zero.equal : zero.random;
  all.p_zero_sums = all.p_zero_sums_error.around(zero.value);
  if (random) all.doubt = doubt_of_random(mixtures.size());
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
  if (settings.over != Over::windows) of_one.over = Over::automatic;
  for (const auto mixture : std::set(data.mixtures.begin(), data.mixtures.end())) {
    fits.of_each.push_back(fit(of_mixture(data, mixture), of_one));
    fits.of_each.back().mixture = mixture;
  }
  combine(fits.all, fits.of_each);
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
