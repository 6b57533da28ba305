// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/unbiased_fluctuations.hpp"

namespace grseg {
template <int D>
UnbiasedFluctuations<D>::UnbiasedFluctuations(const Layers& layers, const Grains& grains,
                                              const Frame<D>& frame)
    : cells_(layers.count(grains, frame))
{
  const auto each = [&](const auto& book) {
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (is_mobile(grains, frame, g)) {
        const auto& position = frame.position[g];
        book(cells_[layers.template holding<D>(position, layers.template height<D>(position))],
             grains.mass[g], motion_of<D>(layers, frame, g));
      }
  };
  each([](CellSums& cell, double mass, const Motion<D>& motion) {
    ++cell.grains;
    cell.mass += mass;
    cell.squares += mass * mass;
    cell.mean += mass * motion;
  });
  for (auto& cell : cells_)
    if (cell.grains > 0) cell.mean /= cell.mass;
  each([](CellSums& cell, double mass, const Motion<D>& motion) {
    const Motion<D> excess = motion - cell.mean;
    cell.weighted += mass * mass * excess;
    cell.product += symmetric_product<D>(mass * mass, excess, excess);
  });
}

template <int D>
typename UnbiasedFluctuations<D>::Product UnbiasedFluctuations<D>::of(std::size_t layer,
                                                                      double mass,
                                                                      const Motion<D>& motion) const
{
  const CellSums& cell = cells_[layer];
  const Motion<D> excess = motion - cell.mean;
  const double pairs =
      (cell.mass - mass) * (cell.mass - mass) - cell.squares + mass * mass;  // sum of m_j m_k
  auto product =
      symmetric_product<D>((cell.mass * cell.mass - cell.squares) / pairs, excess, excess);
  product += symmetric_product<D>(2 / pairs, excess, cell.weighted);
  product += {-1 / pairs * cell.product.velocities, -1 / pairs * cell.product.spins};
  return product;
}

template class UnbiasedFluctuations<2>;
template class UnbiasedFluctuations<3>;

}  // namespace grseg
