// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/closure_points.hpp"
#include "analysis/segregation/named_numbers.hpp"
#include "analysis/stress/partition_rule.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// How intervals are made (bootstrap.hpp).
struct ClosureResampling {
  std::size_t samples = 1000;  // 0: no intervals
  unsigned long seed = 1;
};

/// Gray & Thornton's closure (closure_points.hpp) from the flux: weighted regression of q_L, the
/// noisy one, on driving X and gradient G,
///
///   q_L = (B/c) X - (d/c) G
///
/// without a constant. In least squares the noise of the flux is correlated with the gradient: what
/// moves up by chance within a window makes the gradient of this window larger, and d/c smaller,
/// below 0 where grains are few. With X and G of the window before as instruments Z, on which that
/// noise does not act, sum w Z (q_L - (B/c) X + (d/c) G) = 0 is free of this.
///
/// The rule p of the partition is in neither regressor: what the motion of the grains fixes is B/c
/// and d/c, and c(p) = B(p)/(B/c) is what a rule makes of it, with
/// B(p) = sum frames (psi_L - phi_L)/sum frames phi_L phi_S over the same rows, free of the bias of
/// few grains that products with phi_L have. Where all contacts have the same share p, B and c go
/// with p - p*: c changes its sign there, and where it is negative the closure's "drag" pushes
/// grains the way they move.
///
/// What the kinetic terms and inertia, t = k_push + k_spread - a, do to this is exact: with the
/// same regression t = tau_X X - tau_G G + rest, the coefficients of the flux are (B + tau_X)/c and
/// (d + tau_G)/c. Numbers with "kept" take them into account: c = (B(p) + tau_X)/(B/c).
///
/// Numbers: B_over_c[s], d_over_c[m^2/s]; regressor_correlation (of X and G about 0, weighted),
/// condition_number of the two in units of their lengths, error_factor (a coefficient's error over
/// its error if the other were known; the larger of the two), estimate_correlation;
/// D_displacements[m^2/s] of the same rows, to compare with d/c; stress_slope_over_weight, 1 where
/// the two tables agree; tau_X and tau_G[m^2/s^2] with their parts; p_zero and dc_dp[1/s], and for
/// each rule B@RULE, c@RULE[1/s], d@RULE[m^2/s^2], also with kinetic terms kept. Intervals of 95 %:
/// of one run moving blocks of windows are drawn, of several whole runs, all from one population,
/// whatever their mixtures, unlike grseg-fit. They are linear in the noise of the flux at fixed
/// regressors. NaN where there is no interval.
NamedNumbers closure_summary(const ClosureData& data, const std::vector<PartitionRule>& rules,
                             const ClosureResampling& resampling);

/// The population of the intervals for so many runs, as a sentence without its full stop.
std::string closure_population(std::size_t runs);

}  // namespace grseg
