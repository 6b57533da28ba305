// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace grseg {

/// The standard normal distribution Phi(u), and its primitive, the integral of Phi from minus
/// infinity to u: u Phi(u) + phi(u) without the digits that this sum loses. Relative error at most
/// 1e-15 down to u = -10; beyond, where 1e-23 is left, at most 1e-19 u^4.
///
/// Coarse graining by a Gaussian asks for them at every edge of every layer. Half its time went to
/// std::erfc and std::exp, so down to -10 they are Taylor series about points 1/64 apart, whose
/// coefficients contain Hermite polynomials (Abramowitz & Stegun 1964, 26.2.31).
double normal_below(double u);
double normal_below_primitive(double u);

}  // namespace grseg
