// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/cells.hpp"
#include "analysis/micro/sums_table.hpp"

#include <vector>

namespace grseg {

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
