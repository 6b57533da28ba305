// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/view_cell.hpp"

#include <algorithm>

namespace grseg {

ViewCell view_cell(const TrajectoryReader& run, std::size_t frame)
{
  Frame<2> first;
  run.read(frame, first, {.velocity = false, .contacts = false, .force = false});
  const auto& radius = run.grains().radius;
  const double largest = *std::max_element(radius.begin(), radius.end());
  const auto& box = run.box();
  ViewCell cell{{0, 0, -largest}, {box.length_x, box.length_y, largest}, box.periodic_x};
  for (std::size_t g = 0; g < radius.size(); ++g) {
    cell.low[1] = std::min(cell.low[1], first.position[g].y() - radius[g]);
    cell.high[1] = std::max(cell.high[1], first.position[g].y() + radius[g]);
  }
  return cell;
}

}  // namespace grseg
