// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_points.hpp"
#include "analysis/statistics/dependence.hpp"

#include <Eigen/Core>
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
  double minus_ln_s = nan;  // mean of B over phi_L; for the exponent of sizes (fit_pairs.hpp)
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

/// Additive sums from which every estimator follows, one row per window, and what of them is noise:
/// the part that the layers' compositions do not explain, which is what resampling varies. With f the
/// frames of a point, w its weight, x = phi_S/phi_L, y = sigma^S/sigma^L, D = psi_L - phi_L and
/// Q = phi_L phi_S, the columns are the sums over a window's points of f D and f Q (of points whose
/// whole stress is positive), w, w ln x, w ln y, w (ln x)^2 and w ln x ln y (of those with a
/// logarithm).
struct WindowSums {
  Eigen::MatrixXd sums, noise;

  /// The sums of all windows.
  Eigen::RowVectorXd total() const { return sums.colwise().sum(); }
  /// Of each window in B, and in the mean of ln(y/x).
  Eigen::VectorXd weight() const;
  Eigen::VectorXd weight_of_logarithms() const;
  /// Of each window the sum over its layers of frames x (psi_L - phi_L), and what of it is noise.
  Eigen::VectorXd excess() const;
  Eigen::VectorXd excess_noise() const;
  /// The sums of samples that count window k times(sample, k) times, a row per sample.
  Eigen::MatrixXd totals(const Eigen::MatrixXd& times) const;
};
WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs);

/// How far the windows are from independent for B; where stresses do not add up, and so have no B,
/// for the mean of ln(y/x).
Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up);

/// The same estimates as from the points, from totals of those sums.
Estimators estimators_from_sums(const Eigen::RowVectorXd& total);

}  // namespace grseg
