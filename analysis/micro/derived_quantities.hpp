// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/micro/sums_table.hpp"

#include <vector>

namespace grseg {

/// Estimates of the partial pressures, N/m or Pa, from phi, z, f and nominal diameters d, in two
/// dimensions (Staron & Phillips 2015, eqs. 8 and 9) and in three:
///   Pi_L = phi_L z_L f_L/(pi d_L),   Pi_S = phi_S z_S f_S/(pi d_S),   Pi = Pi_S + Pi_L
///   Pi_L = phi_L z_L f_L/(pi d_L^2), Pi_S = phi_S z_S f_S/(pi d_S^2)
/// The paper prints 2/(pi d), which lacks the 1/2 of P = tr(sigma)/2 and gives twice the
/// pressure. In three P = tr(sigma)/3 and a grain has the volume pi/6 d^3.
/// With f the mean normal force over contact ends, grains of one size per species and the whole
/// bed, Pi_S and Pi_L are the partial pressures exactly, since tr sigma^L = (1/V) sum over ends on
/// L of r f_n. Since phi_S + phi_L = 1 they are stresses in the volume of the grains; the stress in
/// the whole volume is nu times as large. NaN where z or f is, unless the species is absent.
struct PressureEstimate {
  double small = 0, large = 0;
  double total() const { return small + large; }
};
template <int D>
PressureEstimate estimate_pressure(const StructureSums<D>& sums, const ForceMeasure& measure,
                                   double small_diameter, double large_diameter);

/// s with sigma^S/sigma^L = s phi_S/phi_L (eq. 2 of the paper, for one point); NaN where a species
/// is absent or the large grains bear no pressure.
double partition_slope(double stress_small, double stress_large, double phi_large);
/// Gray & Thornton's B of a slope at one composition, B = (1 - s)/(phi_L + s phi_S): eqs. 3 and 4
/// of the paper solved for B, and with s = r_d z_S f_S/(z_L f_L) its B from the micro-structure,
/// eq. 12.
double local_b(double slope, double phi_large);

/// The choices that turn sums into coordination, forces, pressures and B.
struct DerivedSettings {
  ForceMeasure measure;
  PartitionRule rule;  // of P_S and P_L: size, half, drop or uniform
  double depth = 0;    // m, H in f/(rho g cos(theta) (H - y) d_S^(D-1)); 0: the bed's height
};

/// Everything that follows from one row of sums, in the order of the table;
/// docs/studies/microstructure.md defines each column. From Staron & Phillips (2015): mean forces
/// f_S and f_L over m_S g (figure 6c) and over the pressure at their height (figure 6d), the
/// estimates Pi of the pressures beside the pressures themselves (eqs. 8 and 9, figure 5), and B of
/// pressures (eqs. 10 and 11) and of the micro-structure (eq. 12). NaN where a species, a pair type
/// or a constant of the run is missing.
template <int D>
std::vector<Cell> derived_quantities(const SumsRow<D>& row, const RunConstants& constants,
                                     const DerivedSettings& settings);

}  // namespace grseg
