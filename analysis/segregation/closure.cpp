// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/closure.hpp"

#include "analysis/frames/sums.hpp"
#include "analysis/statistics/composition_fit.hpp"
#include "analysis/statistics/correlated_windows.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

// Correlation of the regressors above which the error of a coefficient is more than three times its
// error with the other coefficient known.
constexpr double collinear = 0.95;

/// A number that is linear in the noise of the windows.
struct Linear {
  double value = no_number;
  Eigen::VectorXd influence;  // contribution of each window's noise to the number
  Eigen::VectorXd weight;     // weight of each window in the number
  Eigen::MatrixXd taken{};    // part that a fit to composition takes (CompositionFit::taken)
};

/// A function of several numbers, with its value, and its derivative by each number.
Linear combined(double value, const std::vector<std::pair<double, const Linear*>>& parts)
{
  Linear of{value, Eigen::VectorXd::Zero(parts.front().second->influence.size()),
            parts.front().second->weight, parts.front().second->taken};
  for (const auto& [derivative, part] : parts) of.influence += derivative * part->influence;
  return of;
}

Linear quotient(const Linear& above, const Linear& below)
{
  const double value = above.value / below.value;
  return combined(value, {{1 / below.value, &above}, {-value / below.value, &below}});
}

Linear sum(const Linear& a, const Linear& b)
{
  return combined(a.value + b.value, {{1, &a}, {1, &b}});
}

/// Regressors of the point: X and -G.
Eigen::Vector2d regressors(const ClosurePoint& point)
{
  return {point.driving, -point.gradient};
}

class Regressions {
 public:
  explicit Regressions(const ClosureData& data)
      : data_(data), windows_(index(number_of_windows(data.runs)))
  {
    for (const auto& point : data.points) {
      const Eigen::Vector2d x = regressors(point), z = instruments(point);
      squares_ += point.weight * x * x.transpose();
      matrix_ += point.weight * z * x.transpose();
      of_instruments_ += point.weight * z * z.transpose();
    }
    inverse_ = matrix_.inverse();
  }

  /// Cosine of the angle between X and G as vectors over all points, weighted.
  double correlation() const
  {
    return -squares_(0, 1) / std::sqrt(squares_(0, 0) * squares_(1, 1));
  }
  bool is_singular() const { return !(1 - std::abs(correlation()) > 1e-10); }
  /// Error of a coefficient over its error with the other coefficient known, for noise of one
  /// size; the larger of the two ratios. In least squares it is 1/sqrt(1 - r^2).
  double error_factor() const
  {
    const Eigen::Matrix2d variance = inverse_ * of_instruments_ * inverse_.transpose();
    double most = 0;
    for (const Eigen::Index k : {0, 1})
      most = std::max(most,
                      std::abs(matrix_(k, k)) * std::sqrt(variance(k, k) / of_instruments_(k, k)));
    return most;
  }

  /// Coefficients of X and of -G in the regression of of(point).
  template <class Of>
  std::array<Linear, 2> on_both(const Of& of) const
  {
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const auto& point : data_.points) right += point.weight * of(point) * instruments(point);
    const Eigen::Vector2d value = inverse_ * right;
    std::array<Linear, 2> both{none(value[0]), none(value[1])};
    for (const auto& point : data_.points) {
      const Eigen::Vector2d x = regressors(point);
      const Eigen::Vector2d influence =
          point.weight * (of(point) - x.dot(value)) * (inverse_ * instruments(point));
      for (Eigen::Index k = 0; k < 2; ++k) {
        auto& coefficient = both[static_cast<std::size_t>(k)];
        coefficient.influence[index(point.window)] += influence[k];
        coefficient.weight[index(point.window)] += point.weight * x[k] * x[k];
      }
    }
    return both;
  }

  /// sum of weight x value/sum of weight, over points with a finite value and a positive weight.
  /// The part that composition explains is not counted as noise (composition_fit.hpp).
  template <class Value, class Weight>
  Linear mean(const Value& value, const Weight& weight) const
  {
    std::vector<const ClosurePoint*> used;
    for (const auto& point : data_.points)
      if (weight(point) > 0 && std::isfinite(value(point))) used.push_back(&point);
    const auto list = [&](const auto& of) {
      return numbers_of(used, [&](const ClosurePoint* point) { return of(*point); });
    };
    if (used.empty()) return none(no_number);
    const Eigen::VectorXd values = list(value), weights = list(weight);
    const CompositionFit fit(numbers_of(used, &ClosurePoint::phi_large), weights);
    const Eigen::VectorXd noise = fit.noise(values);
    auto all = none(weights.dot(values) / weights.sum());
    for (std::size_t k = 0; k < used.size(); ++k) {
      const auto point = index(k), window = index(used[k]->window);
      all.influence[window] += weights[point] * noise[point] / weights.sum();
      all.weight[window] += weights[point];
    }
    all.taken = fit.taken(listed(used, &ClosurePoint::window), static_cast<std::size_t>(windows_));
    return all;
  }

 private:
  Linear none(double value) const
  {
    return {value, Eigen::VectorXd::Zero(windows_), Eigen::VectorXd::Zero(windows_)};
  }

  Eigen::Vector2d instruments(const ClosurePoint& point) const
  {
    if (data_.instruments == Instruments::same) return regressors(point);
    return {point.driving_before, -point.gradient_before};
  }

  const ClosureData& data_;
  Eigen::Index windows_;
  Eigen::Matrix2d squares_ = Eigen::Matrix2d::Zero(), matrix_ = Eigen::Matrix2d::Zero(),
                  of_instruments_ = Eigen::Matrix2d::Zero(), inverse_;
};

/// Collects the numbers in the order of printing, with their intervals.
class Report {
 public:
  explicit Report(const ClosureData& data) : runs_(data.runs) {}

  Estimate estimate(const Linear& of) const { return deviation(of).error().around(of.value); }
  void add(const std::string& name, const Linear& of)
  {
    summary.numbers.emplace_back(name, estimate(of));
  }
  void add(const std::string& name, double value)
  {
    summary.numbers.emplace_back(name, Estimate{value});
  }
  /// Correlation between the errors of two numbers, from the same waves for both.
  double correlation(const Linear& a, const Linear& b) const
  {
    const Eigen::VectorXd x = deviation(a).parts,
                          y = deviation({b.value, b.influence, a.weight, a.taken}).parts;
    return x.size() == 0 ? no_number : x.dot(y) / (x.norm() * y.norm());
  }
  void add_doubt(const Linear& of)
  {
    const auto doubt = runs_.size() > 1 ? doubt_of_runs(by_run(of.weight, runs_))
                                        : doubt_of_windows(of.influence, of.weight, runs_);
    if (!doubt.empty()) summary.remarks.push_back(doubt);
  }

  NamedNumbers summary;

 private:
  /// Over runs if there are several, over windows if there is one.
  Deviation deviation(const Linear& of) const
  {
    return runs_.size() > 1
               ? deviation_of_runs(by_run(of.influence, runs_), by_run(of.weight, runs_))
               : deviation_of_windows(of.influence, of.weight, runs_, of.taken);
  }

  RunLengths runs_;
};

void add_collinearity(Report& report, const Regressions& regressions,
                      const std::array<Linear, 2>& flux)
{
  const double r = regressions.correlation(), factor = regressions.error_factor();
  report.add("regressor_correlation", r);
  report.add("condition_number", std::sqrt((1 + std::abs(r)) / (1 - std::abs(r))));
  report.add("error_factor", factor);
  report.add("estimate_correlation", report.correlation(flux[0], flux[1]));
  if (std::abs(r) > collinear)
    report.summary.remarks.push_back(fmt::format(
        "driving and gradient are collinear over these rows (correlation {:.3f}): the errors of "
        "B/c and d/c are {:.1f} times as large as if the other of the two were known; add windows or "
        "runs of other stages of segregation",
        r, factor));
}

/// Adds tau_X and tau_G, by which kinetic terms and inertia change B and d (closure.hpp), and their
/// parts. Returns tau_X and tau_G.
std::array<Linear, 2> add_taus(Report& report, const Regressions& regressions)
{
  const auto add = [&](const char* name, double (*of)(const ClosurePoint&)) {
    auto tau = regressions.on_both(of);
    report.add(fmt::format("tau_X{}", name), tau[0]);
    report.add(fmt::format("tau_G{}[m^2/s^2]", name), tau[1]);
    return tau;
  };
  auto whole =
      add("", [](const ClosurePoint& p) { return p.kinetic_push + p.kinetic_spread - p.inertia; });
  add("_of_kinetic_push", [](const ClosurePoint& p) { return p.kinetic_push; });
  add("_of_kinetic_spread", [](const ClosurePoint& p) { return p.kinetic_spread; });
  add("_of_inertia", [](const ClosurePoint& p) { return -p.inertia; });
  return whole;
}

/// B under the rule with index `rule`, as a ratio of sums.
Linear b_of(const Regressions& regressions, std::size_t rule)
{
  return regressions.mean([rule](const ClosurePoint& p) { return p.excess[rule] / p.product; },
                          [](const ClosurePoint& p) { return p.frames * p.product; });
}

/// Sign of the whole interval: "+", "-", or "not known" if the interval contains 0.
const char* sign_of(const Estimate& estimate)
{
  if (estimate.low > 0) return "+";
  if (estimate.high < 0) return "-";
  return "not known";
}

/// B at this share of mixed contacts, and dB/dp there.
std::array<Linear, 2> b_at(const Regressions& regressions, double share)
{
  const auto mean = [&](const auto& of) {
    return regressions.mean([&](const ClosurePoint& p) { return of(p) / p.product; },
                            [](const ClosurePoint& p) { return p.frames * p.product; });
  };
  return {mean([&](const ClosurePoint& p) { return p.excess_at(share); }),
          mean([&](const ClosurePoint& p) { return p.slope_of_excess(share); })};
}

/// The share p at which B(p) + `more` = 0, by Newton's method.
Linear zero_of(const Regressions& regressions, const Linear* more)
{
  constexpr int most_steps = 50;
  double share = 0.5, step = 1;
  for (int k = 0; k < most_steps && std::abs(step) > 1e-14 * std::abs(share); ++k) {
    const auto [b, slope] = b_at(regressions, share);
    step = (b.value + (more ? more->value : 0)) / slope.value;
    share -= step;
  }
  const auto [b, slope] = b_at(regressions, share);
  std::vector<std::pair<double, const Linear*>> parts{{-1 / slope.value, &b}};
  if (more) parts.emplace_back(-1 / slope.value, more);
  return combined(share, parts);
}

void add_rules(Report& report, const Regressions& regressions,
               const std::vector<PartitionRule>& rules, const std::array<Linear, 2>& flux,
               const std::array<Linear, 2>* tau)
{
  const auto b_over_c = report.estimate(flux[0]);
  if (b_over_c.low <= 0 && b_over_c.high >= 0)
    report.summary.remarks.emplace_back(
        "the interval of B/c contains 0: c(p) = B(p)/(B/c) is not determined");
  const auto zero = zero_of(regressions, nullptr);
  report.add("p_zero", zero);
  if (tau) report.add("p_zero_kept", zero_of(regressions, &(*tau)[0]));
  report.add("dc_dp[1/s]", quotient(b_at(regressions, zero.value)[1], flux[0]));
  std::string signs;
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    const auto name = rules[rule].name();
    const auto b = b_of(regressions, rule), c = quotient(b, flux[0]);
    const auto d = combined(c.value * flux[1].value, {{flux[1].value, &c}, {c.value, &flux[1]}});
    report.add("B@" + name, b);
    report.add(fmt::format("c@{}[1/s]", name), c);
    report.add(fmt::format("d@{}[m^2/s^2]", name), d);
    signs += fmt::format("{}{} {}", signs.empty() ? "" : ", ", name, sign_of(report.estimate(c)));
    if (!tau) continue;
    const auto kept = quotient(sum(b, (*tau)[0]), flux[0]);
    report.add(fmt::format("c_kept@{}[1/s]", name), kept);
    report.add(fmt::format("d_kept@{}[m^2/s^2]", name),
               combined(kept.value * flux[1].value - (*tau)[1].value,
                        {{flux[1].value, &kept}, {kept.value, &flux[1]}, {-1, &(*tau)[1]}}));
  }
  report.summary.remarks.push_back(fmt::format(
      "sign of the drag coefficient c by rule: {}; c is 0 at p* = {:.3f}; a negative c is "
      "unphysical, since its drag pushes grains in their direction of motion",
      signs, zero.value));
}

}  // namespace

NamedNumbers closure_summary(const ClosureData& data, const std::vector<PartitionRule>& rules)
{
  Report report(data);
  const Regressions regressions(data);
  if (regressions.is_singular()) {
    report.add("B_over_c[s]", no_number);
    report.add("d_over_c[m^2/s]", no_number);
    report.add("regressor_correlation", regressions.correlation());
    report.summary.remarks.emplace_back(
        "driving and gradient are proportional over all rows, so that B/c and d/c cannot be "
        "told apart; add windows or runs of other stages of segregation");
    return report.summary;
  }
  const auto flux = regressions.on_both([](const ClosurePoint& p) { return p.flux; });
  report.add("B_over_c[s]", flux[0]);
  report.add("d_over_c[m^2/s]", flux[1]);
  add_collinearity(report, regressions, flux);
  report.add(
      "D_displacements[m^2/s]",
      regressions.mean([](const ClosurePoint& p) { return p.diffusivity; },
                       [](const ClosurePoint& p) { return p.weight * p.gradient * p.gradient; }));
  report.add_doubt(flux[0]);
  if (data.has_kinetic) {
    report.add("stress_slope_over_weight",
               regressions.mean([](const ClosurePoint& p) { return p.weight_above; },
                                [](const ClosurePoint& p) { return p.weight; }));
    const auto tau = add_taus(report, regressions);
    add_rules(report, regressions, rules, flux, &tau);
  } else {
    report.summary.remarks.emplace_back(
        "kinetic terms and inertia are left out: the tables of grseg-segregation lack mass, mvv and "
        "gain; make them again with this version");
    add_rules(report, regressions, rules, flux, nullptr);
  }
  return report.summary;
}

FluxCoefficients flux_coefficients(const ClosureData& data)
{
  const Regressions regressions(data);
  if (regressions.is_singular()) return {};
  const auto flux = regressions.on_both([](const ClosurePoint& p) { return p.flux; });
  double weight = 0, d = 0, d2 = 0;
  for (const auto& point : data.points) {
    weight += point.weight;
    d += point.weight * point.shear_rate * point.diameter;
    d2 += point.weight * point.shear_rate * point.diameter * point.diameter;
  }
  return {flux[0].value, flux[1].value, d / weight, d2 / weight};
}

Estimate estimate_from_flux(const ClosureData& data, double value,
                            const std::array<double, 2>& slopes)
{
  const auto flux = Regressions(data).on_both([](const ClosurePoint& p) { return p.flux; });
  return Report(data).estimate(combined(value, {{slopes[0], &flux[0]}, {slopes[1], &flux[1]}}));
}

std::string closure_population(std::size_t runs)
{
  return runs > 1
             ? "runs: all that are like these, taken as one population; of several mixtures, how "
               "they differ counts as scatter of runs"
             : "windows: this very run, had it lasted longer";
}

}  // namespace grseg
