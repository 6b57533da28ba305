// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_points.hpp"

#include <array>
#include <limits>
#include <vector>

namespace grseg {

/// The segregation strength B of Gray & Thornton (2005), psi_L = phi_L (1 + B phi_S) (Staron & Phillips
/// 2015, eqs. 3 and 4; of kinetic stress eqs. 6 and 7), from partial stresses of many layers and
/// windows: its mean over layers and frames with the weight phi_L phi_S, as a ratio of sums that are
/// linear in the large grains' share psi_L of the stress. It takes no logarithm and divides nothing by
/// the rarer species, and so does not suffer where a window holds few of its grains.
///
/// Beside it stands what the paper fits, with x = phi_S/phi_L and y = sigma^S/sigma^L: the slope s of
/// y = s x (eq. 2), which means B(phi_L) = (1 - s)/(phi_L + s phi_S), and the power law y = k x^a. NaN
/// where a number is not defined.
struct Estimators {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  double B = nan;           // sum f (psi_L - phi_L) / sum f phi_L phi_S, f: frames
  double paper_s = nan;     // exp of the weighted mean of ln(y/x)
  double paper_B = nan;     // ((1 - s) + (1 - s)/s)/2: half the sum of the ends of the range of B
  double paper_k = nan;     // of y = k x^a, weighted least squares of the logarithms
  double paper_a = nan;     //
  double minus_ln_s = nan;  // mean of B over phi_L; for the exponent of sizes (size_exponent.hpp)
};

/// Name and place of every estimator, in the order in which they are printed.
struct EstimatorColumn {
  const char* name;
  double Estimators::*value;
};
inline constexpr std::array<EstimatorColumn, 6> estimator_columns{{
    {"B", &Estimators::B},
    {"paper_s", &Estimators::paper_s},
    {"paper_B", &Estimators::paper_B},
    {"paper_k", &Estimators::paper_k},
    {"paper_a", &Estimators::paper_a},
    {"minus_ln_s", &Estimators::minus_ln_s},
}};

/// All estimators, from the four numbers that they follow from.
Estimators estimators_from(double b, double ln_s, double k, double a);

/// By GSL's fits of the points themselves. Points with a stress that is not positive take part in B
/// only.
Estimators estimators_of(const std::vector<FitPoint>& points);

/// The neutral B averaged with the weights of B: what B would be if contacts ignored grain size
/// (partition_rule.hpp).
double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule);

}  // namespace grseg
