// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/unbiased_fluctuations.hpp"

namespace grseg {
namespace {

template <int D>
using Product = typename UnbiasedFluctuations<D>::Product;

/// (a (x) b + b (x) a)/2 of velocities, a . b of spins, times a weight.
template <int D>
Product<D> symmetric(double weight, const Motion<D>& a, const Motion<D>& b)
{
  const Vector<D> u = a.template head<D>(), v = b.template head<D>();
  const auto spins = a.size() - D;
  return {weight / 2 * (u * v.transpose() + v * u.transpose()),
          weight * a.tail(spins).dot(b.tail(spins))};
}

template <int D>
void add(Product<D>& sum, double weight, const Product<D>& other)
{
  sum.velocities += weight * other.velocities;
  sum.spins += weight * other.spins;
}

}  // namespace

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
    add<D>(cell.product, mass * mass, symmetric<D>(1, excess, excess));
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
  Product product = symmetric<D>((cell.mass * cell.mass - cell.squares) / pairs, excess, excess);
  add<D>(product, 2 / pairs, symmetric<D>(1, excess, cell.weighted));
  add<D>(product, -1 / pairs, cell.product);
  return product;
}

template class UnbiasedFluctuations<2>;
template class UnbiasedFluctuations<3>;

}  // namespace grseg
