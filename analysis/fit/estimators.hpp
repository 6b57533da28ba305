// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/stress/partition.hpp"

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

/// The segregation strength B of Gray & Thornton (2005), psi_L = phi_L (1 + B phi_S), from partial
/// stresses of many layers and windows. With x = phi_S/phi_L and y = sigma^S/sigma^L a slope
/// s = y/x means B(phi_L) = (1 - s)/(phi_L + s phi_S): 1 - s in pure large grains, (1 - s)/s in
/// pure small ones, 2 (1 - s)/(1 + s) at phi_L = 1/2 and -ln s on average over phi_L.
namespace grseg {

/// A point of the fit under one partition rule; stresses in N/m, the chosen component.
struct FitPoint {
  std::size_t window = 0;
  double phi_large = 0;
  double weight = 0;
  double size_ratio = 0;  // nominal d_L/d_S
  double small = 0, large = 0, total = 0;

  double ratio() const { return (1 - phi_large) / phi_large; }  // x
  bool has_logarithm() const { return small > 0 && large > 0; }
};

struct FitSettings {
  Component component = Component::yy;
  BasePart base = BasePart::contact_point;
};

std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings);

/// The estimators side by side; NaN where one cannot be had. The first three describe the same
/// slope, that of the weighted mean of ln(y/x); it is what the printed B stands for.
struct Estimates {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  double slope = nan;            // s = exp(mean of ln(y/x))
  double B_half = nan;           // at phi_L = 1/2
  double B_mean = nan;           // mean over phi_L
  double B_pure_large = nan;     // the ends of the range of B
  double B_pure_small = nan;     //
  double B_paper = nan;          // half the sum of the two ends, as Staron & Phillips quote it
  double slope_linear = nan;     // least squares through the origin, y = s x, unweighted
  double B_linear = nan;         // at phi_L = 1/2
  double prefactor_power = nan;  // y = k x^a, weighted least squares of the logarithms
  double exponent = nan;         //
  double B_power = nan;          // at phi_L = 1/2
  double B_direct = nan;         // sum w (psi_L - phi_L) phi_L phi_S / sum w (phi_L phi_S)^2
};

/// Name and place of every estimator, in the order in which they are printed.
struct EstimatorName {
  const char* name;
  double Estimates::*value;
};
inline constexpr std::array<EstimatorName, 12> estimator_names{{
    {"slope", &Estimates::slope},
    {"B_half", &Estimates::B_half},
    {"B_mean", &Estimates::B_mean},
    {"B_pure_large", &Estimates::B_pure_large},
    {"B_pure_small", &Estimates::B_pure_small},
    {"B_paper", &Estimates::B_paper},
    {"slope_linear", &Estimates::slope_linear},
    {"B_linear", &Estimates::B_linear},
    {"prefactor_power", &Estimates::prefactor_power},
    {"exponent", &Estimates::exponent},
    {"B_power", &Estimates::B_power},
    {"B_direct", &Estimates::B_direct},
}};

/// By GSL's fits of the points themselves. Points with a stress that is not positive take part in
/// B_direct only.
Estimates estimate(const std::vector<FitPoint>& points);

/// Additive sums from which every estimator follows, one row per window, and what of them is noise:
/// the part that the layers' compositions do not explain, which is what resampling varies.
struct WindowSums {
  Eigen::MatrixXd sums, noise;

  /// The sums of all windows, and of samples that count window k times(sample, k) times.
  Eigen::RowVectorXd total() const { return sums.colwise().sum(); }
  Eigen::MatrixXd totals(const Eigen::MatrixXd& times) const;
};
WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs);

/// The same estimates as from the points, from totals of those sums.
Estimates estimate_from_sums(const Eigen::RowVectorXd& total);

/// How far the windows are from independent, for the worse of the mean of ln(y/x) and, where
/// stresses add up, B_direct.
Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up);

/// The neutral contact model's B averaged with the weights of B_direct: what B_direct would be,
/// were the grains' contacts blind to their species.
double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule);

}  // namespace grseg
