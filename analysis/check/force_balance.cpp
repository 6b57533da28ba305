// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/force_balance.hpp"

#include "analysis/frames/contacts.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// N: the largest of the frame's contact forces and of the mobile grains' weights.
template <int D>
double largest_force(const Grains& grains, const Frame<D>& frame, const Gravity<D>& gravity)
{
  double largest = 0;
  for (const auto& force : frame.contacts.force) largest = std::max(largest, force.norm());
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g)) largest = std::max(largest, grains.mass[g] * gravity.norm());
  return largest;
}

double size_of(double spin)
{
  return std::abs(spin);
}
double size_of(const Vec3& spin)
{
  return spin.norm();
}

}  // namespace

template <int D>
void ForceBalance<D>::add(const Grains& grains, const Frame<D>& frame)
{
  const double scale = largest_force(grains, frame, gravity_);
  if (!frame.force.empty()) add_forces(grains, frame, scale);

  Turning now{
      frame.step, frame.time, scale * *std::max_element(grains.radius.begin(), grains.radius.end()),
      std::vector<Spin<D>>(grains.size(), no_spin<D>()), torques_of(grains, frame.contacts)};
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (is_mobile(grains, g))
      now.inertia_times_spin[g] = grains.mass[g] * grains.radius[g] * grains.radius[g] *
                                  inertia_factor<D> * frame.angular_velocity[g];
    else
      now.torque[g] = no_spin<D>();
  }
  // A part of a step does not show what the torques of the others have done.
  const bool is_whole = step_of_force(frame, step_) > 0.99 * step_;
  if (is_whole && !last_.inertia_times_spin.empty()) add_torques(last_, now);
  last_ = std::move(now);
}

template <int D>
void ForceBalance<D>::add_forces(const Grains& grains, const Frame<D>& frame, double scale)
{
  const Vector<D> gravity = gravity_.at(frame.time);
  std::vector<Vector<D>> defect(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g)
    defect[g] = grains.mass[g] * gravity - frame.force[g];
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    defect[static_cast<std::size_t>(contacts.i[c])] += contacts.force[c];
    if (contacts.j[c] >= 0) defect[static_cast<std::size_t>(contacts.j[c])] -= contacts.force[c];
  }
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g))
      forces_.add(scale > 0 ? defect[g].norm() / scale : defect[g].norm(), frame.time, g);
}

template <int D>
void ForceBalance<D>::add_torques(const Turning& before, const Turning& after)
{
  if (after.step != before.step + 1) return;
  for (std::size_t g = 0; g < after.torque.size(); ++g) {
    const Spin<D> change = (after.inertia_times_spin[g] - before.inertia_times_spin[g]) / step_;
    const double defect = size_of(Spin<D>(after.torque[g] - change));
    if (std::isnan(defect)) continue;  // a grain that is absent before or after
    torques_.add(after.scale > 0 ? defect / after.scale : defect, after.time, g);
  }
}

template class ForceBalance<2>;
template class ForceBalance<3>;

}  // namespace grseg
