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

/// Exponents Q of the rule power:Q at which sums are computed: Chebyshev points of [0, 4]. A page
/// interpolates between them with a polynomial, because the share r_L^Q/(r_L^Q + r_S^Q), and with it
/// every sum, is smooth in Q. The error is below 1e-7 for r_L < 3 r_S, below 1e-9 for r_L < 2.4 r_S.
std::vector<double> power_nodes();
inline constexpr double highest_power = 4;

struct PartitionSettings {
  std::vector<PartitionRule>
      rules;  // rules fitted here, with intervals of B; the page computes B under all others
  FitSettings fit;
  FitFilters filters;
  std::string pair;  // the two species compared, "A,B"; "": the first two
};

/// Data from which a page computes B for any rule, and the results of grseg-fit, with intervals, for the
/// rules of `settings`. A sample is one layer in one window. Adds to `arrays`, by sample:
///
///   phi_large, frames, window, begin, bottom, top   composition and place, from fit_points() and its key
///   none_, all_, size_, contact_point_, drop_ + small, large   stresses of the two species under
///                           uniform:0, uniform:1, size, contact-point, drop; also drop_total
///   none_, all_, size_, contact_point_ + within   stress of the large species that gradients inside
///                           the layer add (FitPoint::within times the total); linear in p, too
///   power_large             by exponent of power_nodes() and sample; only if there are sums by power:Q
///
/// Arrays of the same names with the prefix "layer_" are means over time, by layer. Stress under
/// uniform:p is linear in p. Returns everything else as JSON. Its entry `two` is true if the run
/// has two species. Only then do p*, shares and B of neutral contacts have a meaning: with more
/// species, mixed contacts with other species count, too. Throws the errors of select_fit_data and
/// fit_points.
nlohmann::ordered_json partition_data(const StressTables& input, const PartitionSettings& settings,
                                      BinaryArrays& arrays);

}  // namespace grseg
