// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/correlated_windows.hpp"
#include "analysis/stress/partition_rule.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

/// Windows of known correlation whose mean and B are known.
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

  /// One series per run; means of runs differ by a normal variate with standard deviation `run_scatter`.
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

inline bool holds(const Estimate& interval, double truth)
{
  return interval.low <= truth && truth <= interval.high;
}

/// The mean of a series with its error over windows.
inline Measured mean_over_windows(const Eigen::VectorXd& series, const RunLengths& runs)
{
  const auto n = static_cast<double>(series.size());
  const Eigen::VectorXd influence = (series.array() - series.mean()) / n;
  return {series.mean(),
          deviation_of_windows(influence, Eigen::VectorXd::Ones(series.size()), runs).error()};
}

/// Layers whose stresses scatter about sigma^S/sigma^L = 0.966 phi_S/phi_L: by 10 % if the composition is
/// even and by 32 % at its ends, as results from counting grains of the rarer species.
class ScatteredStress {
 public:
  static constexpr double slope = 0.966;
  static constexpr double scatter = 0.1;
  static constexpr double compositions[] = {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95};

  /// Layers of all windows, with noise that is independent from layer to layer.
  static FitData windows(const RunLengths& runs, double run_scatter, Ar1& noise)
  {
    FitData data;
    data.quantity = Quantity::kinetic;  // two species, no mixed contacts
    data.runs = runs;
    for (const double phi : compositions) {
      std::size_t window = 0;
      for (const double normal : noise.series(runs, run_scatter))
        add_sample(data, window++, phi, normal);
    }
    return data;
  }

  /// Estimators in the limit of infinitely many windows, by Gauss-Hermite quadrature over the noise.
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

  /// A third of that scatter, in layers that segregate, starting from phi_L = 0.3 everywhere. The
  /// rule makes B a function of phi_L: neutral contacts of which large grains get the share 0.8.
  /// With `noise` null: the exact values that the fit has to find.
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

/// Runs of several flows with known B, as input of fit_flows().
struct FlowDesign {
  std::size_t flows = 6, runs = 4;  // number of flows; number of runs of each flow
  double flow_scatter = 0;          // s.d. of ln s between flows, in standard errors of one flow
  double run_variance = 0;          // variance of ln s between runs, over that of a run's mean
};

class RunsOfFlows {
 public:
  static constexpr std::size_t windows = 10;  // number of windows of each run
  static constexpr double rho = 0.5;

  explicit RunsOfFlows(const FlowDesign& design, unsigned long seed = 7)
      : design_(design), noise_(rho, seed)
  {
  }

  /// Data of all runs, and the true B for each kind of interval.
  struct Draw {
    FitData data;
    struct Truth {
      double of_runs = 0, of_flows = 0;
      std::vector<double> of_each;  // B of each flow
    } truth;
  };

  Draw draw()
  {
    Draw drawn;
    drawn.data.quantity = Quantity::kinetic;  // two species, no mixed contacts
    drawn.data.tables = {"synthetic"};
    offset_.clear();
    own_.clear();
    for (std::size_t m = 0; m < design_.flows; ++m) {
      const double error = std::sqrt(run_variance(m));
      const double flow = design_.flow_scatter * error_of_flow() * noise_.normal();
      offset_.push_back(flow);
      for (std::size_t run = 0; run < design_.runs; ++run) {
        own_.push_back(flow + std::sqrt(design_.run_variance) * error * noise_.normal());
        add_run(drawn.data, m, own_.back());
      }
    }
    drawn.truth = truth();
    return drawn;
  }

 private:
  /// phi_L of three layers about the composition of the flow.
  static std::vector<double> layers_of(std::size_t flow)
  {
    static constexpr double compositions[] = {0.1, 0.25, 0.4, 0.5, 0.6, 0.75};
    const double phi = compositions[flow % std::size(compositions)];
    return {phi - 0.05, phi, phi + 0.05};
  }
  /// Number of grains of the rarer species, up to a factor; d_L = 2 d_S.
  static double layer_weight(double phi) { return std::min(phi / 4, 1 - phi); }
  static double layer_scatter(double phi)
  {
    return ScatteredStress::scatter * std::sqrt(0.5 / std::min(phi, 1 - phi));
  }
  static double weight_of(std::size_t flow)
  {
    double weight = 0;
    for (const double phi : layers_of(flow)) weight += layer_weight(phi);
    return weight;
  }
  /// Variance of a run's mean of ln s that is due to the noise of its windows alone.
  static double run_variance(std::size_t flow)
  {
    double of_mean = 1;
    for (std::size_t lag = 1; lag < windows; ++lag)
      of_mean += 2 * (1 - static_cast<double>(lag) / windows) * std::pow(rho, lag);
    double squares = 0;
    for (const double phi : layers_of(flow))
      squares += std::pow(layer_weight(phi) * layer_scatter(phi), 2);
    return squares / std::pow(weight_of(flow), 2) * of_mean / windows;
  }
  /// Standard error of ln s of a flow, root mean square over the flows.
  double error_of_flow() const
  {
    double squares = 0;
    for (std::size_t m = 0; m < design_.flows; ++m)
      squares += run_variance(m) * (1 + design_.run_variance) / static_cast<double>(design_.runs);
    return std::sqrt(squares / static_cast<double>(design_.flows));
  }
  void add_run(FitData& data, std::size_t flow, double offset)
  {
    const auto first = number_of_windows(data.runs);
    data.runs.push_back(windows);
    data.flows.push_back(flow);
    for (const double phi : layers_of(flow)) {
      const Eigen::VectorXd normal = noise_.series(windows);
      for (std::size_t k = 0; k < windows; ++k) {
        const double log_slope = offset + layer_scatter(phi) * normal[static_cast<Eigen::Index>(k)];
        const double ratio = ScatteredStress::slope * std::exp(log_slope) * (1 - phi) / phi;
        ContactSums<3> sums;
        sums.volume = 1;
        sums.of(OwnSum::inside, 0)(1, 1) = ratio / (1 + ratio);
        sums.of(OwnSum::inside, 1)(1, 1) = 1 / (1 + ratio);
        sums.of(OwnSum::inside, 0)(0, 0) = no_number;  // the xx component is unknown
        data.samples.push_back({.window = first + k,
                                .phi_large = phi,
                                .weight = layer_weight(phi),
                                .size_ratio = 2,
                                .row = data.rows.size()});
        data.rows.push_back(sums);
      }
    }
  }

  /// Numerator and denominator of a ratio of sums over layers.
  struct Ratio {
    double above = 0, below = 0;
    double value() const { return above / below; }
    Ratio& operator+=(const Ratio& other)
    {
      above += other.above;
      below += other.below;
      return *this;
    }
  };
  /// Average contribution of a flow's layers to B, if ln s is off by `offset` and scatters by
  /// `variance` in addition to its windows' noise: the mean of psi_L over the normal distribution.
  static Ratio sums_of(std::size_t flow, double offset, double variance)
  {
    Ratio sums;
    for (const double phi : layers_of(flow)) {
      const double deviation = std::hypot(layer_scatter(phi), std::sqrt(variance));
      double psi = 0, weights = 0;
      for (double z = -6; z <= 6; z += 0.25) {
        const double s = ScatteredStress::slope * std::exp(offset + deviation * z);
        psi += std::exp(-z * z / 2) * phi / (phi + s * (1 - phi));
        weights += std::exp(-z * z / 2);
      }
      sums += {psi / weights - phi, phi * (1 - phi)};
    }
    return sums;
  }
  Draw::Truth truth() const
  {
    Draw::Truth truth;
    Ratio of_runs, of_flows;
    for (std::size_t m = 0; m < design_.flows; ++m) {
      const double of_run = design_.run_variance * run_variance(m);
      for (std::size_t run = 0; run < design_.runs; ++run)
        of_runs += sums_of(m, own_[m * design_.runs + run], 0);
      const auto flow = sums_of(m, offset_[m], of_run);
      of_flows += flow;
      truth.of_each.push_back(flow.value());
    }
    truth.of_runs = of_runs.value();
    truth.of_flows = of_flows.value();
    return truth;
  }

  FlowDesign design_;
  Ar1 noise_;
  std::vector<double> offset_, own_;  // offsets of the last draw: of each flow, and of each run
};

}  // namespace grseg::synthetic
