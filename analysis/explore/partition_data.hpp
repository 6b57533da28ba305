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

/// Exponents Q of power:Q between which a page interpolates: Chebyshev's points of [0, 4]. The share
/// r_L^Q/(r_L^Q + r_S^Q), and with it every sum, is a smooth function of Q. The polynomial through these
/// points is off by less than 1e-7 for radii r_L < 3 r_S, by less than 1e-9 for r_L < 2.4 r_S.
std::vector<double> power_nodes();
inline constexpr double highest_power = 4;

struct PartitionSettings {
  std::vector<PartitionRule>
      rules;  // fitted here, with intervals; the page fits all others by itself
  FitSettings fit;
  FitFilters filters;
  std::string pair;  // "": the first two species
  Resampling resampling{1000, 1};
};

/// The data from which a page finds B for any rule, and the results of grseg-fit, with intervals, for the
/// rules of the settings. Adds to `arrays`
///
///   phi_large, weight, frames, window, begin, bottom, top   by sample, from fit_points() and its key
///   none_, all_, size_, contact_point_, drop_ + small, large   by sample: stresses of the pair under
///                           uniform:0, uniform:1, size, contact-point, drop; drop_total
///   power_large             by node and sample, where there are nodes
///
/// and, with "layer_" before the name, the same arrays for the means over time of all layers. Stress under
/// uniform:p is linear in p. Returns everything else as JSON. Its `two` is true if there are two species;
/// only then do p*, the shares and B of neutral contacts have a meaning, since otherwise mixed contacts with
/// other species count, too. Errors as select_fit_data and fit_points.
nlohmann::ordered_json partition_data(const StressTables& input, const PartitionSettings& settings,
                                      BinaryArrays& arrays);

}  // namespace grseg
