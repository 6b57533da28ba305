// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/bootstrap.hpp"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace grseg {

/// The segregation strength B of Gray & Thornton (2005), psi_L = phi_L (1 + B phi_S) (Staron &
/// Phillips 2015, eqs. 3 and 4; of kinetic stress eqs. 6 and 7), from partial stresses of many
/// layers and windows: its mean over layers and frames with the weight phi_L phi_S, as a ratio of
/// sums that are linear in the large grains' share psi_L of the stress. It takes no logarithm and
/// divides nothing by the rarer species, and so does not suffer where a window holds few of its
/// grains.
///
/// Beside it stands what the paper fits, with x = phi_S/phi_L and y = sigma^S/sigma^L: the slope s
/// of y = s x (eq. 2), which means B(phi_L) = (1 - s)/(phi_L + s phi_S), and the power law y = k
/// x^a. NaN where a number is not defined.
struct Estimators {
  double B = no_number;        // sum f (psi_L - phi_L) / sum f phi_L phi_S, f: frames
  double paper_s = no_number;  // exp of the weighted mean of ln(y/x)
  double paper_B =
      no_number;  // ((1 - s) + (1 - s)/s)/2: half the sum of the ends of the range of B
  double paper_k = no_number;     // of y = k x^a, weighted least squares of the logarithms
  double paper_a = no_number;     //
  double minus_ln_s = no_number;  // mean of B over phi_L; for the exponent of sizes (fit_pairs.hpp)
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

/// The number of its column.
Eigen::Index column_of(double Estimators::*place);

/// By GSL's fits of the points themselves. Points with a stress that is not positive take part in B
/// only.
Estimators estimators_of(const std::vector<FitPoint>& points);

/// The neutral B averaged with the weights of B: what B would be if contacts ignored grain size
/// (partition_rule.hpp).
double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule);

/// Additive sums from which every estimator follows, one row per window, and what of them is noise:
/// the part that the layers' compositions do not explain, which is what resampling varies. With f
/// the frames of a point, w its weight, x = phi_S/phi_L, y = sigma^S/sigma^L, D = psi_L - phi_L and
/// Q = phi_L phi_S, the columns are the sums over a window's points of f D and f Q (of points whose
/// whole stress is positive), w, w ln x, w ln y, w (ln x)^2 and w ln x ln y (of those with a
/// logarithm).
struct WindowSums {
  /// The columns: X is ln x and Y is ln y.
  enum Sum : Eigen::Index { fD, fQ, w, wX, wY, wXX, wXY, number_of_sums };
  Eigen::MatrixXd sums, noise;

  /// The sums of all windows.
  Eigen::RowVectorXd total() const { return sums.colwise().sum(); }
  /// Weight of each window in B, and in the mean of ln(y/x).
  Eigen::VectorXd weight() const { return sums.col(fQ); }
  Eigen::VectorXd weight_of_logarithms() const { return sums.col(w); }
  /// Sum over each window's layers of frames x (psi_L - phi_L), and the part of it that is noise.
  Eigen::VectorXd excess() const { return sums.col(fD); }
  Eigen::VectorXd excess_noise() const { return noise.col(fD); }
  /// The sums of samples that count window k times(sample, k) times, a row per sample.
  Eigen::MatrixXd totals(const Eigen::MatrixXd& times) const;
  /// The estimators of these samples, a column per entry of estimator_columns.
  Eigen::MatrixXd sampled(const Eigen::MatrixXd& times) const;
};
WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs);

/// How far the windows are from independent for B; where stresses do not add up, and so have no B,
/// for the mean of ln(y/x).
Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up);

/// The estimators from WindowSums::total(), equal to estimators_of the points.
Estimators estimators_from_sums(const Eigen::RowVectorXd& total);

/// Influence of each window on a statistic: its part of the statistic's deviation.
struct Influence {
  Eigen::VectorXd sums;  // of the window's sums: differs between whole runs
  Eigen::VectorXd
      noise;  // of what composition does not explain: what windows inside a run differ by

  Influence operator-(const Influence& other) const
  {
    return {sums - other.sums, noise - other.noise};
  }
};
/// Influence on an estimator: its derivative by the sums times the window's sums. It adds up to 0
/// over all windows, since estimators are ratios.
Influence influence_on(double Estimators::*place, const WindowSums& windows);

/// Errors of statistics over whole runs of fixed flows: the sum of the flows' errors. Where a flow
/// has a single run, the scatter of its windows replaces the scatter of runs. A window's deviation
/// is then its influence less the part of the run's influence that goes with its weight.
class RunErrors {
 public:
  /// weight: of each window.
  RunErrors(const FitData& data, const Eigen::VectorXd& weight);

  /// Error of a statistic whose deviation is the sum of the windows' influences.
  StandardError within_flows(const Influence& influence) const;
  /// The chance that runs of like flows differ between flows as much as these do, by Fisher's
  /// test of the mean squares of influence over weight between and within flows; 1 where it cannot
  /// be told. `fitted`: of the differences between flows, how many degrees of freedom were taken
  /// out of the influence beforehand; at least one counts as left.
  double chance_of_likeness(const Eigen::VectorXd& influence, double fitted) const;
  /// Flows with a single run.
  std::size_t single_runs() const;

 private:
  struct Run {
    Eigen::Index first, windows;
  };
  struct Flow {
    std::vector<Run> runs;
    Eigen::VectorXd weight;  // of each run
  };
  static Eigen::VectorXd by_run(const std::vector<Run>& runs, const Eigen::VectorXd& of_windows);

  Eigen::VectorXd weight_;  // of each window
  std::vector<Flow> flows_;
};

/// The error over a population of a statistic that `sampled` makes of how often samples count the
/// windows, and whose deviation is the sum of the windows' influences.
template <class Sampled>
StandardError error_over(Population over, const Bootstrap& bootstrap, const Dependence& dependence,
                         const Sampled& sampled, const RunErrors& runs, const Influence& influence)
{
  if (over == Population::windows)
    return bootstrap.window_error(sampled(bootstrap.blocks(dependence.block)), dependence);
  if (over == Population::compositions)
    return bootstrap.run_error(sampled(bootstrap.whole_runs()), dependence);
  return runs.within_flows(influence);
}

}  // namespace grseg
