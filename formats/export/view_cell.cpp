// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/view_cell.hpp"

#include "formats/core/frame.hpp"

#include <algorithm>

namespace grseg {

ViewCell view_cell(const TrajectoryReader& run, std::size_t frame)
{
  const auto& radius = run.grains().radius;
  const double largest = *std::max_element(radius.begin(), radius.end());
  const auto& box = run.box();
  ViewCell cell{{box.low_x, 0, -largest},
                {box.low_x + box.length_x, box.length_y, largest},
                box.periodic_x,
                box.periodic_z};
  if (run.dimension() == 3) {
    cell.low[2] = box.low_z;
    cell.high[2] = box.low_z + box.length_z;
  }
  with_dimension(run.dimension(), [&](auto d) {
    Frame<d> first;
    run.read(frame, first, {.velocity = false, .contacts = false, .force = false});
    for (std::size_t g = 0; g < radius.size(); ++g) {
      if (!is_present(first, g)) continue;
      cell.low[1] = std::min(cell.low[1], first.position[g].y() - radius[g]);
      cell.high[1] = std::max(cell.high[1], first.position[g].y() + radius[g]);
    }
  });
  return cell;
}

}  // namespace grseg
