// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/view_cell.hpp"

#include <algorithm>

namespace grseg {

ViewCell view_cell(const TrajectoryReader& run, std::size_t frame)
{
  Frame first;
  run.read(frame, first, {.velocity = false, .contacts = false, .force = false});
  const auto& radius = run.grains().radius;
  const double largest = *std::max_element(radius.begin(), radius.end());
  const auto& box = run.box();
  ViewCell cell{{0, 0, -largest}, {box.length_x, box.length_y, largest}, box.periodic_x};
  for (std::size_t g = 0; g < radius.size(); ++g)
    for (const int axis : {0, 1}) {
      if (axis == 0 && box.periodic_x) continue;
      const auto a = static_cast<std::size_t>(axis);
      cell.low[a] = std::min(cell.low[a], first.position[g][axis] - radius[g]);
      cell.high[a] = std::max(cell.high[a], first.position[g][axis] + radius[g]);
    }
  return cell;
}

}  // namespace grseg
