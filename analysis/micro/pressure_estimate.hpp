// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/micro/micro_sums.hpp"

namespace grseg {

/// The paper's estimates of the pressure, N/m, from phi, z, f and nominal diameters d:
///   Pi_S = phi_S z_S f_S/(pi d_S), Pi_L likewise, Pi = Pi_S + Pi_L
/// (Staron & Phillips 2015, eqs. pL and pS). The paper prints 2/(pi d), which lacks the 1/2 of
/// P = tr(sigma)/2 and gives twice the pressure. With f the mean normal force over contact ends,
/// grains of one size per species and the whole bed, Pi_S and Pi_L are the partial pressures
/// exactly, since tr sigma^L = (1/V) sum over ends on L of r f_n. Since phi_S + phi_L = 1 these are
/// stresses in the volume of the grains; the stress in the whole volume is nu times as large. NaN
/// where z or f is, unless the species is absent.
struct PressureEstimate {
  double small = 0, large = 0;
  double total() const { return small + large; }
};
PressureEstimate estimate_pressure(const MicroSums& sums, const ForceMeasure& measure,
                                   double small_diameter, double large_diameter);

/// s with sigma^S/sigma^L = s phi_S/phi_L; NaN where a species is absent or bears no pressure.
double partition_slope(double stress_small, double stress_large, double phi_large);
/// Gray & Thornton's B of a slope at one composition, B = (1 - s)/(phi_L + s phi_S): with
/// s = r_d z_S f_S/(z_L f_L) the paper's B from the micro-structure.
double local_b(double slope, double phi_large);

}  // namespace grseg
