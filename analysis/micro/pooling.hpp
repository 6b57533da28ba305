// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/micro/sums_table.hpp"

#include <limits>
#include <vector>

namespace grseg {

/// Which rows take part: windows in [begin, end] and layers between two heights; the rows of the
/// whole bed lie at all heights.
struct RowFilter {
  double begin = -std::numeric_limits<double>::infinity();  // s
  double end = std::numeric_limits<double>::infinity();
  std::string heights = "all";  // as on the command line (layer_key.hpp)
};
template <int D>
std::vector<SumsRow<D>> filtered(std::vector<SumsRow<D>> rows, const RowFilter& filter,
                                 LengthUnits units);

/// Which rows are merged.
enum class Pool {
  none,
  windows,      ///< each layer, and the whole bed, over all windows and tables
  composition,  ///< layers of all windows and tables by phi_L, in ten bins of equal width
};
/// Means weighted by frames. With `composition` the whole bed's rows and empty layers are left out.
template <int D>
std::vector<SumsRow<D>> pooled(const std::vector<SumsRow<D>>& rows, Pool pool);

}  // namespace grseg
