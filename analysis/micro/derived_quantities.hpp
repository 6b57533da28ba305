// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/micro/sums_table.hpp"

#include <vector>

namespace grseg {

/// Estimates Pi of the partial pressures, N/m or Pa, from composition phi, contacts per grain z,
/// mean force f and nominal diameter d, in two dimensions (Staron & Phillips 2015, eqs. 8 and 9)
/// and in three:
///   Pi_L = phi_L z_L f_L/(pi d_L),   Pi_S = phi_S z_S f_S/(pi d_S),   Pi = Pi_S + Pi_L
///   Pi_L = phi_L z_L f_L/(pi d_L^2), Pi_S = phi_S z_S f_S/(pi d_S^2)
/// Eqs. 8 and 9 are printed with 2/(pi d), without the 1/2 of P = tr(sigma)/2, which gives twice
/// the pressure. In three dimensions P = tr(sigma)/3 and a grain has the volume pi/6 d^3.
///
/// Pi_S and Pi_L are exact if f is the mean normal force over contact ends, each species has one
/// size, and the sums are of the whole bed, because tr sigma^L = (1/V) sum over ends on L of r f_n.
/// They are stresses in the volume of the grains, as phi_S + phi_L = 1; the stress in the whole
/// volume is nu times as large. NaN if z or f is NaN, but 0 for an absent species.
struct PressureEstimate {
  double small = 0, large = 0;
  double total() const { return small + large; }
};
template <int D>
PressureEstimate estimate_pressure(const StructureSums<D>& sums, const ForceMeasure& measure,
                                   double small_diameter, double large_diameter);

/// Slope s of sigma^S/sigma^L = s phi_S/phi_L (Staron & Phillips 2015, eq. 2) for one point; NaN if
/// a species is absent or the large grains bear no pressure.
double partition_slope(double stress_small, double stress_large, double phi_large);
/// B of Gray & Thornton from the slope s at one composition, (1 - s)/(phi_L + s phi_S): eqs. 3 and
/// 4 of Staron & Phillips (2015) solved for B. With s = r_d z_S f_S/(z_L f_L) it is B from the
/// micro-structure, their eq. 12.
double local_b(double slope, double phi_large);

/// The choices that turn sums into coordination, forces, pressures and B.
struct DerivedSettings {
  ForceMeasure measure;
  PartitionRule rule;  // rule for P_S and P_L: size, half, drop or uniform
  double depth = 0;    // H in f/(rho g cos(theta) (H - y) d_S^(D-1)), m; 0: the bed's height
};

/// All quantities that follow from one row of sums, in the order of the table.
/// formats/cli/columns.tsv defines each column. Quantities of Staron & Phillips (2015): mean
/// forces f_S and f_L over m_S g (figure 6c) and over the pressure at their height (figure 6d), the
/// pressures P and their estimates Pi (eqs. 8 and 9, figure 5), and B from pressures (eqs. 10 and
/// 11) and from the micro-structure (eq. 12). NaN if a species, a pair type or a constant of the
/// run is missing.
template <int D>
std::vector<Cell> derived_quantities(const SumsRow<D>& row, const RunConstants& constants,
                                     const DerivedSettings& settings);

}  // namespace grseg
