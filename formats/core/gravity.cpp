// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/gravity.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {

template <int D>
Vector<D> Gravity<D>::at(double time) const
{
  if (!turns()) return start;
  const double angle = slope_rate * std::max(time, 0.0);
  const double c = std::cos(angle), s = std::sin(angle);
  // A slope that becomes steeper turns gravity from -y towards +x.
  Vector<D> turned = start;
  turned.x() = c * start.x() - s * start.y();
  turned.y() = s * start.x() + c * start.y();
  return turned;
}

template <int D>
Vector<D> Gravity<D>::mean(double last, std::int64_t steps, double step) const
{
  if (!turns()) return start;
  // Mean of vectors of one length, each turned by `angle` against the last (Dirichlet's kernel).
  const double angle = slope_rate * step, half = angle / 2;
  const auto count = static_cast<double>(steps);
  return std::sin(count * half) / (count * std::sin(half)) * at(last - (count - 1) * step / 2);
}

template struct Gravity<2>;
template struct Gravity<3>;

}  // namespace grseg
