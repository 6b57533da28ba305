// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/walls.hpp"

namespace grseg {

template <int D>
void Walls<D>::add(const Frame<D>& frame)
{
  const auto& list = frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list.j[k] >= 0 || !(list.branch[k].norm() > 0)) continue;
    const auto& centre = frame.position[static_cast<std::size_t>(list.i[k])];
    walls_[-1 - list.j[k]] = {centre - list.branch[k], list.branch[k].normalized()};
  }
}

template class Walls<2>;
template class Walls<3>;

}  // namespace grseg
