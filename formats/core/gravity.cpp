// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/gravity.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {

Vec2 Gravity::at(double time) const
{
  if (!turns()) return start;
  const double angle = slope_rate * std::max(time, 0.0);
  const double c = std::cos(angle), s = std::sin(angle);
  // A slope that becomes steeper turns gravity from -y towards +x.
  return {c * start.x() - s * start.y(), s * start.x() + c * start.y()};
}

Vec2 Gravity::mean(double last, std::int64_t steps, double step) const
{
  if (!turns()) return start;
  // Mean of vectors of one length, each turned by `angle` against the last (Dirichlet's kernel).
  const double angle = slope_rate * step, half = angle / 2;
  const auto count = static_cast<double>(steps);
  return std::sin(count * half) / (count * std::sin(half)) * at(last - (count - 1) * step / 2);
}

}  // namespace grseg
