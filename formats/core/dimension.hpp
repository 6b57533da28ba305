// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

namespace grseg {

/// Calls `work` with the number of dimensions, 2 or 3, as a constant, which chooses the templates
/// that it uses: with_dimension(run.dimension(), [&](auto d) { Frame<d> frame; ... }).
template <class Work>
decltype(auto) with_dimension(int dimension, const Work& work)
{
  if (dimension == 3) return work(std::integral_constant<int, 3>{});
  return work(std::integral_constant<int, 2>{});
}

}  // namespace grseg
