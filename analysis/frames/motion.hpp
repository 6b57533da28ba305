// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <tuple>

namespace grseg {

/// Components of a velocity, m/s, followed by components of the spin, rad/s: 3 or 6 numbers.
template <int D>
using Motion = Vector<D == 2 ? 3 : 6>;
template <int D>
Motion<D> motion_of(const Vector<D>& velocity, const Spin<D>& spin)
{
  if constexpr (D == 2) return {velocity.x(), velocity.y(), spin};
  Motion<D> motion;
  motion << velocity, spin;
  return motion;
}

/// A product of two motions: the tensor of the velocities, m^2/s^2, and the scalar product of the
/// spins, 1/s^2.
template <int D>
struct MotionProduct {
  Tensor<D> velocities = Tensor<D>::Zero();
  double spins = 0;

  static constexpr auto members = std::tuple(&MotionProduct::velocities, &MotionProduct::spins);
};
/// The symmetric part of a (x) b, times a weight.
template <int D>
MotionProduct<D> symmetric_product(double weight, const Motion<D>& a, const Motion<D>& b)
{
  const Vector<D> u = a.template head<D>(), v = b.template head<D>();
  const auto spins = a.size() - D;
  return {weight / 2 * (u * v.transpose() + v * u.transpose()),
          weight * a.tail(spins).dot(b.tail(spins))};
}

}  // namespace grseg
