// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/stress/partition_rule.hpp"

/// The neutral model: contacts that ignore grain size. Contact ends are in proportion to the grains'
/// perimeter, they pair at random, and the mean force is the same for all pairs. Whatever it gives
/// is geometry; a measured departure from it is not. Grains have their nominal sizes, r = d_L/d_S.
namespace grseg {

/// Share of the contact ends that large grains have: x_L = phi_L/(phi_L + r phi_S).
double neutral_ends_of_large(double phi_large, double size_ratio);

/// Share of mixed contacts: 2 x_L x_S. For r = 2 it is 4 phi_L phi_S/(1 + phi_S)^2, at most 1/2, at
/// phi_L = 2/3 (beside Staron & Phillips 2015, figure 2c).
double neutral_mixed_share(double phi_large, double size_ratio);

/// The share that goes to the larger of two grains of nominal sizes; NaN for `drop`.
double nominal_share(const PartitionRule& rule, double size_ratio);

/// p* of neutral contacts, the share at which B = 0: r/(1 + r), 2/3 for r = 2.
double neutral_zero_share(double size_ratio);

/// B of Staron & Phillips (2015), eqs. (3) and (4), for neutral contacts under a rule that gives
/// all mixed contacts of nominal sizes the share P; NaN for `drop`:
///   B(phi_L) = (P - r/(1+r)) (1+r)/(phi_L + r phi_S).
double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large);

}  // namespace grseg
