// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/rule_fit.hpp"
#include "analysis/fit/window_sums.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/stress/neutral_contacts.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

/// Windows of known correlation whose mean and whose B are known, with the intervals that grseg-fit
/// gives them and the plain percentiles that it does not.
namespace grseg::synthetic {

inline Eigen::Index total_windows(const RunLengths& runs)
{
  Eigen::Index windows = 0;
  for (const auto length : runs) windows += static_cast<Eigen::Index>(length);
  return windows;
}

/// x_{k+1} = rho x_k + noise, of variance 1 and mean 0; rho = 0 is independent noise.
class Ar1 {
 public:
  explicit Ar1(double rho, unsigned long seed = 7)
      : rng_(gsl_rng_alloc(gsl_rng_ranlxd2), &gsl_rng_free), rho_(rho)
  {
    gsl_rng_set(rng_.get(), seed);
  }

  Eigen::VectorXd series(Eigen::Index length)
  {
    Eigen::VectorXd values(length);
    double value = normal();
    for (double& place : values) {
      place = value;
      value = rho_ * value + std::sqrt(1 - rho_ * rho_) * normal();
    }
    return values;
  }

  /// One series per run; runs differ by a normal variate of standard deviation `run_scatter`.
  Eigen::VectorXd series(const RunLengths& runs, double run_scatter)
  {
    Eigen::VectorXd values(total_windows(runs));
    Eigen::Index first = 0;
    for (const auto length : runs) {
      const auto windows = static_cast<Eigen::Index>(length);
      values.segment(first, windows) = series(windows).array() + run_scatter * normal();
      first += windows;
    }
    return values;
  }

  double normal() { return gsl_ran_gaussian(rng_.get(), 1); }

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng_;
  double rho_;
};

/// What several windows say of one number.
struct Verdict {
  double estimate = 0;
  Interval interval{}, plain{};  // plain: 2.5 and 97.5 % of the samples of blocks
};

inline bool holds(const Interval& interval, double truth)
{
  return interval.low <= truth && truth <= interval.high;
}

inline Interval percentiles(Eigen::VectorXd samples)
{
  if (samples.size() == 0) return {Estimators::nan, Estimators::nan};
  std::sort(samples.begin(), samples.end());
  const auto tail = static_cast<Eigen::Index>(0.025 * static_cast<double>(samples.size()));
  return {samples[tail], samples[samples.size() - 1 - tail]};
}

inline Dependence dependence_of_mean(const Eigen::VectorXd& series, const RunLengths& runs)
{
  return dependence(series.array() - series.mean(), Eigen::VectorXd::Ones(series.size()), runs);
}

inline Eigen::VectorXd sampled_means(const Eigen::MatrixXd& times, const Eigen::VectorXd& series)
{
  if (times.rows() == 0) return {};
  return (times * series).array() / times.rowwise().sum().array();
}

/// Of the mean of a series.
inline Verdict mean_of(const Eigen::VectorXd& series, const Bootstrap& bootstrap)
{
  const auto how = dependence_of_mean(series, bootstrap.runs());
  const double mean = series.mean();
  return {.estimate = mean,
          .interval = bootstrap.interval(mean, sampled_means(bootstrap.samples(how), series), how),
          .plain = percentiles(sampled_means(bootstrap.blocks(how.block), series))};
}

/// Layers whose stresses scatter about sigma^S/sigma^L = 0.966 phi_S/phi_L, by 10 % where the
/// composition is even and by 32 % at its ends: as grains of the rarer species are counted.
class ScatteredStress {
 public:
  static constexpr double slope = 0.966;
  static constexpr double scatter = 0.1;
  static constexpr double compositions[] = {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95};

  /// The layers of all windows, whose noise is independent from layer to layer.
  static FitData windows(const RunLengths& runs, double run_scatter, Ar1& noise)
  {
    FitData data;
    data.quantity = Quantity::kinetic;  // two species and nothing mixed
    data.runs = runs;
    for (const double phi : compositions) {
      std::size_t window = 0;
      for (const double normal : noise.series(runs, run_scatter))
        add_sample(data, window++, phi, normal);
    }
    return data;
  }

  /// What infinitely many windows would give, by Gauss-Hermite quadrature over the noise.
  static Estimators truth(double run_scatter)
  {
    constexpr std::size_t nodes = 60;
    const std::unique_ptr<gsl_integration_fixed_workspace, decltype(&gsl_integration_fixed_free)>
        rule(gsl_integration_fixed_alloc(gsl_integration_fixed_hermite, nodes, 0, 0.5, 0, 0),
             &gsl_integration_fixed_free);
    FitData data;
    data.runs = {nodes};
    const double deviation = std::sqrt(1 + run_scatter * run_scatter);
    for (std::size_t k = 0; k < nodes; ++k)
      for (const double phi : compositions)
        add_sample(data, k, phi, deviation * gsl_integration_fixed_nodes(rule.get())[k]);
    const Eigen::Map<const Eigen::RowVectorXd> weights(gsl_integration_fixed_weights(rule.get()),
                                                       nodes);
    return estimators_from_sums(weights * window_sums(fit_points(data, {}, {}), data.runs).sums);
  }

  /// A third of that scatter while layers segregate, from phi_L = 0.3 in all of them, under a rule
  /// that gives B a course over phi_L: that of neutral contacts of which large grains get 0.8.
  /// Without noise what the fit is to find.
  static FitData drifting(std::size_t windows, Ar1* noise)
  {
    FitData data;
    data.quantity = Quantity::kinetic;
    data.runs = {windows};
    for (const double end : compositions) {
      const auto length = static_cast<Eigen::Index>(windows);
      const Eigen::VectorXd normal = noise ? noise->series(length) : Eigen::VectorXd::Zero(length);
      for (std::size_t window = 0; window < windows; ++window) {
        const double progress = (static_cast<double>(window) + 0.5) / static_cast<double>(windows);
        const double phi = 0.3 + (end - 0.3) * progress;
        const double b = neutral_b({PartitionRule::Kind::uniform, 0.8}, 2, phi);
        const double of_rule = (1 - b * phi) / (1 + b * (1 - phi));
        add_sample(data, window, phi, normal[static_cast<Eigen::Index>(window)] / 3, of_rule);
      }
    }
    return data;
  }

 private:
  /// Adds a layer of one window.
  static void add_sample(FitData& data, std::size_t window, double phi, double normal,
                         double of_slope = slope)
  {
    const double rarer = std::min(phi, 1 - phi);
    const double ratio =
        of_slope * (1 - phi) / phi * std::exp(scatter * std::sqrt(0.5 / rarer) * normal);
    ContactSums<3> sums;
    sums.volume = 1;
    sums.of(OwnSum::inside, 1)(1, 1) = 1 / (1 + ratio);
    sums.of(OwnSum::inside, 0)(1, 1) = ratio / (1 + ratio);
    data.samples.push_back({.window = window,
                            .phi_large = phi,
                            .weight = rarer,
                            .size_ratio = 2,
                            .row = data.rows.size()});
    data.rows.push_back(sums);
  }
};

}  // namespace grseg::synthetic
