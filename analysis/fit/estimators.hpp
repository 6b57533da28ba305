// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/correlated_windows.hpp"

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace grseg {

/// The segregation strength B of Gray & Thornton (2005), psi_L = phi_L (1 + B phi_S) (Staron &
/// Phillips 2015, eqs. 3 and 4; of kinetic stress eqs. 6 and 7), from partial stresses of many
/// layers and windows. B is the mean over layers and frames with the weight phi_L phi_S: a ratio of
/// sums that are linear in the large grains' share psi_L of the stress. No logarithm is needed, and
/// no division by the rarer species, so B stays accurate in windows with few grains of a species.
///
/// The other members are the fits of Staron & Phillips (2015), with x = phi_S/phi_L and y =
/// sigma^S/sigma^L: the slope s of y = s x (eq. 2), which means B(phi_L) = (1 - s)/(phi_L + s
/// phi_S), and the power law y = k x^a. A number that is not defined is NaN.
struct Estimators {
  double B = no_number;        // sum f (psi_L - phi_L) / sum f phi_L phi_S, f: number of frames
  double paper_s = no_number;  // exp of the weighted mean of ln(y/x)
  double paper_B =
      no_number;  // ((1 - s) + (1 - s)/s)/2: mean of B(phi_L) at phi_L = 1 and at phi_L = 0
  double paper_k = no_number;     // factor of y = k x^a, by weighted least squares of logarithms
  double paper_a = no_number;     // exponent of y = k x^a
  double minus_ln_s = no_number;  // mean of B over phi_L; for the size exponent (fit_pairs.hpp)
};

/// Name and member of every estimator, in the order of printing.
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

/// Index of an estimator in estimator_columns.
Eigen::Index column_of(double Estimators::*place);

/// Estimators from the points themselves, by fits of GSL. Points with a partial stress that is not
/// positive are used for B only.
Estimators estimators_of(const std::vector<FitPoint>& points);

/// Least and largest B of these points if no partial stress is negative, so that 0 <= psi_L <= 1: the
/// means of -1/phi_S and of 1/phi_L, with the weights of B.
std::pair<double, double> bounds_of_b(const std::vector<FitPoint>& points);

/// Mean of the neutral B over the points, with the weights of B: the B of contacts that ignore
/// grain size (partition_rule.hpp).
double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule);

/// Additive sums from which every estimator follows, one row per window, and their noise. The noise
/// is the part of a sum that the layers' compositions do not explain.
///
/// Columns are sums over a window's points. With f the number of frames of a point, w its weight, x
/// = phi_S/phi_L, y = sigma^S/sigma^L, D = psi_L - phi_L and Q = phi_L phi_S they are: f D and f Q
/// (points with positive total stress); w, w ln x, w ln y, w (ln x)^2 and w ln x ln y (points whose
/// partial stresses are both positive).
struct WindowSums {
  /// Numbers of the columns; X stands for ln x and Y for ln y.
  enum Sum : Eigen::Index { fD, fQ, w, wX, wY, wXX, wXY, number_of_sums };
  Eigen::MatrixXd sums, noise;
  /// Parts that the fit to composition takes (CompositionFit::taken) from points that count in B, and from
  /// points that have a logarithm.
  Eigen::MatrixXd taken, taken_of_logarithms;

  /// Sums over all windows, one per column.
  Eigen::RowVectorXd total() const { return sums.colwise().sum(); }
  /// Weight of each window in B and, next function, in the mean of ln(y/x).
  Eigen::VectorXd weight() const { return sums.col(fQ); }
  Eigen::VectorXd weight_of_logarithms() const { return sums.col(w); }
  /// Sum of frames x (psi_L - phi_L) over each window's layers and, next function, its noise.
  Eigen::VectorXd excess() const { return sums.col(fD); }
  Eigen::VectorXd excess_noise() const { return noise.col(fD); }
};
WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs);

/// Estimators from WindowSums::total(); they equal estimators_of(points).
Estimators estimators_from_sums(const Eigen::RowVectorXd& total);

/// Influence of each window on a statistic: its contribution to the statistic's deviation.
struct Influence {
  Eigen::VectorXd sums;  // influence of the window's sums, for errors from whole runs
  Eigen::VectorXd
      noise;  // influence of the noise of these sums, for errors from windows inside a run

  Influence operator-(const Influence& other) const
  {
    return {sums - other.sums, noise - other.noise};
  }
};
/// Influence on an estimator: the derivative of the estimator with respect to the sums, times the
/// window's sums. The influences of all windows add up to 0, since estimators are ratios.
Influence influence_on(double Estimators::*place, const WindowSums& windows);

/// Errors of statistics whose deviation is the sum of the windows' influences.
class Errors {
 public:
  /// `weight`: weight of each window in the statistic; `taken`: WindowSums.
  Errors(const FitData& data, const Eigen::VectorXd& weight, const Eigen::MatrixXd& taken = {});
  /// Errors of an estimator, or of another ratio with its weights.
  Errors(const FitData& data, const WindowSums& windows,
         double Estimators::*place = &Estimators::B);

  /// Error over a population. Over windows it follows from their noise; otherwise it is the
  /// sum of the errors of the flows, each from its whole runs. The windows of a flow with a single run replace its runs.
  StandardError over(Population population, const Influence& influence) const;
  /// Number of flows with a single run.
  std::size_t single_runs() const;

 private:
  struct Run {
    Eigen::Index first, windows;
  };
  struct Flow {
    std::vector<Run> runs;
    Eigen::VectorXd weight;  // weight of each run
  };
  static Eigen::VectorXd of_runs(const std::vector<Run>& runs, const Eigen::VectorXd& of_windows);
  StandardError of_flow(const Flow& flow, const Influence& influence) const;

  RunLengths runs_;
  Eigen::VectorXd weight_;  // weight of each window
  Eigen::MatrixXd taken_;
  std::vector<Flow> flows_;
};

}  // namespace grseg
