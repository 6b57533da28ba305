// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

/// Errors from the windows of runs, which are correlated in time. How often intervals contain the
/// true value: docs/studies/uncertainty.md.
namespace grseg {

/// Number of windows of each run. A series has the windows of all runs, one run after the other.
using RunLengths = std::vector<std::size_t>;
std::size_t number_of_windows(const RunLengths& runs);

/// Sums of `of_windows` over the windows of each run.
Eigen::VectorXd by_run(const Eigen::VectorXd& of_windows, const RunLengths& runs);

/// Deviation of a statistic by the noise of the windows. `influence` is the noise of each window
/// times the derivative of the statistic; `weight` is the weight of each window in the statistic.
/// Slow cosine waves are as variable as a sum over all windows, however long windows are correlated
/// within a fraction of a run; so their mean square is its variance (equally weighted cosines:
/// Lazarus, Lewis, Stock & Watson 2018). With u_k the middle of window k, as the fraction of the run's
/// weight before it, and e_k the influence without its mean over the run, in each run
///   variance = 2 sum of m_j (sum over k of e_k cos(pi j u_k))^2 / sum of m_j l_j,  j = 1, 2, ...
/// with m_j = 1 but for the last wave. l_j is the part of wave j that a fit to the compositions of the
/// layers left in the noise (`taken`: CompositionFit::taken(), a row per window; nothing without a
/// fit). The waves are the slowest ones that leave J = sum of m_j l_j = n^(2/3)/4 with
/// n = (sum W)^2/sum W^2 windows, at least 2 for one run and 1 for each of several. Degrees of freedom
/// are J^2/sum of (m_j l_j)^2; of several runs (sum W)^2/sum(W^2/degrees) with W the weight of a run.
/// The waves are a little less variable than the sum: the variance is divided by the part that they
/// would keep in an AR(1) series with the neighbours' correlation of the influence (as by prewhitening:
/// Andrews & Monahan 1992). No parts for runs of a single window.
Deviation deviation_of_windows(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight,
                               const RunLengths& runs, const Eigen::MatrixXd& taken = {});

/// Integrated autocorrelation time in windows, 1 + 2 sum of the autocorrelation function of all
/// runs, each about its own mean. It is the largest of 1 and two estimates: the sum to the first
/// lag >= 5 times the result (Madras & Sokal 1988), corrected for the subtracted mean (Wolff 2004);
/// and (1 + rho)/(1 - rho), rho being the neighbours' correlation without its bias (Kendall 1954).
double autocorrelation_time(const Eigen::VectorXd& series, const RunLengths& runs);

/// Error of a statistic that deviates from its expectation by the sum of `influence`, one entry per
/// observation of a run, to which `fitted` parameters were fitted:
///   error^2 = tau sum influence^2 / (1 - fitted tau/n),  degrees = n/tau - fitted,
/// with tau the autocorrelation time of the n influences. NaN and 0 degrees below least_degrees.
StandardError standard_error(const Eigen::VectorXd& influence, int fitted);

/// A warning if an interval over windows (deviation_of_windows) may be too narrow: if windows are
/// few, or correlated for so long that the waves are not slow. Usually empty. `noise` and `weight`
/// are of the windows.
std::string doubt_of_windows(const Eigen::VectorXd& noise, const Eigen::VectorXd& weight,
                             const RunLengths& runs);
}  // namespace grseg
