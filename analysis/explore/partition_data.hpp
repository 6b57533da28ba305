// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/binary_arrays.hpp"
#include "analysis/explore/stress_tables.hpp"
#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_pairs.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// The exponents Q of power:Q between which a page interpolates: Chebyshev's points of [0, 4]. The
/// share r_L^Q/(r_L^Q + r_S^Q) is a smooth function of Q, and with it every sum: for radii r_L < 3 r_S
/// the polynomial through these points differs from it by less than 1e-7, for r_L < 2.4 r_S by 1e-9.
std::vector<double> power_nodes();
inline constexpr double highest_power = 4;

struct PartitionSettings {
  std::vector<PartitionRule> rules;  // that are fitted here; a page fits any other by itself
  FitSettings fit;
  FitFilters filters;
  std::string pair;  // "": the first two species
  Resampling resampling{1000, 1};
};

/// What a page needs to find B for any rule, and what grseg-fit says of some, with its intervals.
/// Adds to `arrays`
///
///   phi_large, weight, frames, window, begin, bottom, top   by sample: what fit_points() has of it
///   none_, all_, size_, contact_point_, drop_ + small, large   by sample: stresses of the pair under
///                           uniform:0, uniform:1, size, contact-point, drop; drop_total
///   power_large             by node and sample, where there are nodes
///
/// and the same of the means over time of all layers, "layer_" before the name. Stress under uniform:p
/// is linear in p. Of more than two species mixed contacts with the others enter, too: p*, the shares and
/// what neutral contacts would make of B belong to two alone, `two`. Returns the rest; errors as
/// select_fit_data and fit_points.
nlohmann::ordered_json partition_data(const StressTables& input, const PartitionSettings& settings,
                                      BinaryArrays& arrays);

}  // namespace grseg
