// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cmath>

namespace grseg {

/// The shortest of the vectors that differ from this one by periods of the cell.
template <int D>
Vector<D> minimum_image(const Box& box, Vector<D> between)
{
  if (box.periodic_x) between.x() -= box.length_x * std::round(between.x() / box.length_x);
  if constexpr (D == 3)
    if (box.periodic_z) between.z() -= box.length_z * std::round(between.z() / box.length_z);
  return between;
}

}  // namespace grseg
