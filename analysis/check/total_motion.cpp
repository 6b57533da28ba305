// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/total_motion.hpp"

#include "analysis/frames/layers.hpp"

#include <algorithm>

namespace grseg {

template <int D>
TotalMotion<D> total_motion(const Grains& grains, const Frame<D>& frame, const Box& box)
{
  TotalMotion<D> total;
  total.step = frame.step;
  total.time = frame.time;
  total.grains = which_are_absent(frame);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    total.mass += grains.mass[g];
    total.momentum += grains.mass[g] * frame.velocity[g];
    total.energy += grains.mass[g] * frame.velocity[g].squaredNorm() / 2;
    Vector<D> place = frame.position[g];
    place.x() += frame.image[g][0] * box.length_x;
    if constexpr (D == 3) place.z() += frame.image[g][2] * box.length_z;
    total.centre += grains.mass[g] * place;
  }
  if (total.mass > 0) total.centre /= total.mass;
  return total;
}

template <int D>
void MotionBalance<D>::add(const TotalMotion<D>& now, const std::optional<Vector<D>>& base_force)
{
  ++frames_;
  if (!first_) {
    first_ = last_ = now;
    return;
  }
  if (now.grains != last_.grains) {
    same_grains_ = false;
    by_velocity_ += now.centre - last_.centre;
    last_ = now;
    return;
  }
  if (base_force) {
    const auto steps = now.step - last_.step;
    const double between = static_cast<double>(steps) * step_;
    const Vector<D> weight = now.mass * gravity_.mean(now.time, steps, step_);
    const double scale = between * std::max(weight.norm(), base_force->norm());
    const double defect = (now.momentum - last_.momentum - between * (weight + *base_force)).norm();
    momentum_.add(scale > 0 ? defect / scale : defect, now.time, 0);
  }
  if (now.mass > 0)
    by_velocity_ += (now.momentum + last_.momentum) / 2 / now.mass * (now.time - last_.time);
  last_ = now;
}

template TotalMotion<2> total_motion(const Grains&, const Frame<2>&, const Box&);
template TotalMotion<3> total_motion(const Grains&, const Frame<3>&, const Box&);
template class MotionBalance<2>;
template class MotionBalance<3>;

}  // namespace grseg
