// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/micro/micro_table.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The choices that turn sums into coordination, forces, pressures and B.
struct ViewSettings {
  ForceMeasure measure;
  PartitionRule rule;  // of P_S and P_L: size, half, drop or uniform
  double depth = 0;    // m, H in f/(rho g cos(theta) (H - y) d_S); 0: the bed's height
};

struct Cell {
  std::string name;  // as printed, "f_S[N]"
  double value;
};

/// Everything that follows from one row of sums: docs/studies/microstructure.md defines each column. NaN
/// where a species, a pair type or a number of the run that is needed is absent.
std::vector<Cell> derived(const MicroRow& row, const MicroScale& scale,
                          const ViewSettings& settings);

}  // namespace grseg
