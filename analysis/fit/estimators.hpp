// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_points.hpp"

#include <array>
#include <limits>
#include <vector>

/// The segregation strength B of Gray & Thornton (2005), psi_L = phi_L (1 + B phi_S) (Staron &
/// Phillips 2015, eqs. 3 and 4; of kinetic stress eqs. 6 and 7), from partial stresses of many
/// layers and windows. With x = phi_S/phi_L and y = sigma^S/sigma^L a slope s = y/x (eq. 2) means
/// B(phi_L) = (1 - s)/(phi_L + s phi_S): 1 - s in pure large grains, (1 - s)/s in pure small ones,
/// 2 (1 - s)/(1 + s) at phi_L = 1/2 and -ln s on average over phi_L.
namespace grseg {

/// B_sums is the mean of B over layers and frames with the weight phi_L phi_S, as a ratio of sums
/// that are linear in the large grains' share psi_L of the stress: it takes no logarithm and divides
/// nothing by the rarer species, and so does not suffer where a window holds few of its grains, as
/// means of ln(y/x) do.
///
/// The estimators side by side; NaN where one is not defined. The first three describe the same
/// slope, that of the weighted mean of ln(y/x); it is what the printed B stands for.
struct Estimators {
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
  double B_sums = nan;           // sum f (psi_L - phi_L) / sum f phi_L phi_S, f: frames
};

/// Name and place of every estimator, in the order in which they are printed.
struct EstimatorColumn {
  const char* name;
  double Estimators::*value;
};
inline constexpr std::array<EstimatorColumn, 13> estimator_columns{{
    {"slope", &Estimators::slope},
    {"B_half", &Estimators::B_half},
    {"B_mean", &Estimators::B_mean},
    {"B_pure_large", &Estimators::B_pure_large},
    {"B_pure_small", &Estimators::B_pure_small},
    {"B_paper", &Estimators::B_paper},
    {"slope_linear", &Estimators::slope_linear},
    {"B_linear", &Estimators::B_linear},
    {"prefactor_power", &Estimators::prefactor_power},
    {"exponent", &Estimators::exponent},
    {"B_power", &Estimators::B_power},
    {"B_direct", &Estimators::B_direct},
    {"B_sums", &Estimators::B_sums},
}};

/// All estimators, from the six numbers that they follow from.
Estimators estimators_from_slopes(double log_slope, double slope_linear, double prefactor,
                                  double exponent, double direct, double sums);

/// By GSL's fits of the points themselves. Points with a stress that is not positive take part in
/// B_direct and B_sums only.
Estimators estimators_of(const std::vector<FitPoint>& points);

/// The neutral B averaged with the weights of B_direct: what B_direct would be if contacts ignored
/// grain size (neutral_contacts.hpp).
double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule);

}  // namespace grseg
