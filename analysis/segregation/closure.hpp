// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/closure_points.hpp"
#include "analysis/segregation/named_numbers.hpp"
#include "analysis/stress/partition_rule.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Coefficients of Gray & Thornton's closure (symbols: closure_points.hpp), by weighted regression
/// of the noisy flux q_L on the driving X and the gradient G, without a constant:
///
///   q_L = (B/c) X - (d/c) G
///
/// Least squares is biased, because the noise of the flux is correlated with the gradient. Large
/// grains that move up by chance within a window increase the gradient of this window. This makes
/// d/c too small, even negative if grains are few. Instrumental variables Z, which are X and G of
/// the window before, are free of this noise; sum w Z (q_L - (B/c) X + (d/c) G) = 0 has no bias.
///
/// The partition rule p is in neither regressor: the motion of the grains determines B/c and d/c
/// alone. A rule then gives c(p) = B(p)/(B/c), with
/// B(p) = sum frames (psi_L - phi_L)/sum frames phi_L phi_S over the same rows; this ratio lacks
/// the bias that products with phi_L have for few grains. If all mixed contacts have the same share
/// p, B and c are proportional to p - p*, so c changes its sign at p*. In tables of --assign grain
/// B(p) is no straight line; dc_dp is then the slope at p*. If c < 0, the "drag" of the closure
/// pushes grains in their direction of motion.
///
/// Kinetic terms and inertia, t = k_push + k_spread - a, change this exactly as follows. With the
/// same regression t = tau_X X - tau_G G + rest, the coefficients of the flux are (B + tau_X)/c and
/// (d + tau_G)/c. Numbers with "kept" include these terms: c = (B(p) + tau_X)/(B/c).
///
/// Numbers: B_over_c[s], d_over_c[m^2/s]; regressor_correlation (of X and G about 0, weighted),
/// condition_number of X and G, each scaled to length 1; error_factor (error of a coefficient over
/// its error if the other were known, the larger of the two), estimate_correlation;
/// D_displacements[m^2/s] of the same rows, to compare with d/c; stress_slope_over_weight, 1 if
/// the two tables agree; tau_X and tau_G[m^2/s^2] with their parts; p_zero and dc_dp[1/s]; and for
/// each rule B@RULE, c@RULE[1/s], d@RULE[m^2/s^2], also with kinetic terms kept.
///
/// Intervals are 95 %: over the windows of one run, or over several runs. All runs are one
/// population, whatever their mixtures (grseg-fit distinguishes mixtures). Errors are linear in the
/// noise of the flux at fixed regressors. A missing interval is NaN.
NamedNumbers closure_summary(const ClosureData& data, const std::vector<PartitionRule>& rules);

/// Coefficients of the flux, to predict other runs: q_L = (B/c) X - (d/c) G over all points, and the
/// means of the shear rate of the bed times d and times d^2, with d = phi_S d_S + phi_L d_L and the
/// weights of the regression. NaN without shear rates in the tables.
struct FluxCoefficients {
  double B_over_c = no_number;  // s
  double d_over_c = no_number;  // m^2/s
  double shear_d = no_number;   // mean shear rate x d, m/s
  double shear_d2 = no_number;  // mean shear rate x d^2, m^2/s
};
FluxCoefficients flux_coefficients(const ClosureData& data);

/// A number with these derivatives by B/c and d/c, and the interval due to their errors.
Estimate estimate_from_flux(const ClosureData& data, double value,
                            const std::array<double, 2>& slopes);

/// The population of the intervals for this number of runs, as a sentence without its full stop.
std::string closure_population(std::size_t runs);

}  // namespace grseg
