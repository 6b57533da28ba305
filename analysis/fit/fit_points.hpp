// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/population.hpp"
#include "analysis/stress/partial_stress.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// A point of the fit under one partition rule; stresses in N/m, in three dimensions Pa, the
/// chosen component.
struct FitPoint {
  std::size_t window = 0;
  double phi_large = 0;
  double weight = 0;
  double frames = 1;
  double size_ratio = 0;  // nominal d_L/d_S
  double small = 0, large = 0, total = 0;

  double ratio() const { return (1 - phi_large) / phi_large; }  // x
  bool has_logarithm() const { return small > 0 && large > 0; }
  /// psi_L - phi_L, whose slope over product() is B (Staron & Phillips 2015, eq. 3).
  double excess() const { return large / total - phi_large; }
  double product() const { return phi_large * (1 - phi_large); }  // phi_L phi_S
};

struct FitSettings {
  Component component = Component::yy;
  BasePart base = BasePart::contact_point;
  Over over = Over::automatic;  // what intervals are over
};

/// FormatError, naming the table, where a stress is not finite because a sum was not kept.
std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings);

}  // namespace grseg
