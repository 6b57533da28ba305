// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/force_balance.hpp"

#include "analysis/frames/contact_force.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// N: the largest of the frame's contact forces and of the mobile grains' weights.
double largest_force(const Grains& grains, const Frame<2>& frame, const Gravity<2>& gravity)
{
  double largest = 0;
  for (const auto& force : frame.contacts.force) largest = std::max(largest, force.norm());
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) largest = std::max(largest, grains.mass[g] * gravity.norm());
  return largest;
}

/// Torques of the contacts on all grains, N m, counter-clockwise.
std::vector<double> torques_of(const Grains& grains, const ContactList<2>& contacts)
{
  std::vector<double> torque(grains.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const double tangential = force_parts(contacts, c).f_t;
    if (contacts.j[c] < 0) {
      torque[i] -= grains.radius[i] * tangential;
      continue;
    }
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    const double r_i = grains.radius[i], r_j = grains.radius[j];
    const double kappa = contacts.branch[c].norm() / (r_i + r_j);
    torque[i] -= kappa * r_i * tangential;
    torque[j] -= kappa * r_j * tangential;
  }
  return torque;
}

}  // namespace

void ForceBalance::add(const Grains& grains, const Frame<2>& frame)
{
  const double scale = largest_force(grains, frame, gravity_);
  if (!frame.force.empty()) add_forces(grains, frame, scale);

  Spin now{frame.step, frame.time,
           scale * *std::max_element(grains.radius.begin(), grains.radius.end()),
           std::vector<double>(grains.size()), torques_of(grains, frame.contacts)};
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (is_mobile(grains, g))
      now.inertia_times_spin[g] =
          grains.mass[g] * grains.radius[g] * grains.radius[g] / 2 * frame.angular_velocity[g];
    else
      now.torque[g] = 0;
  }
  if (!last_.inertia_times_spin.empty()) add_torques(last_, now);
  last_ = std::move(now);
}

void ForceBalance::add_forces(const Grains& grains, const Frame<2>& frame, double scale)
{
  const Vec2 gravity = gravity_.at(frame.time);
  std::vector<Vec2> defect(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g)
    defect[g] = grains.mass[g] * gravity - frame.force[g];
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    defect[static_cast<std::size_t>(contacts.i[c])] += contacts.force[c];
    if (contacts.j[c] >= 0) defect[static_cast<std::size_t>(contacts.j[c])] -= contacts.force[c];
  }
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g))
      forces_.add(scale > 0 ? defect[g].norm() / scale : defect[g].norm(), frame.time, g);
}

void ForceBalance::add_torques(const Spin& before, const Spin& after)
{
  if (after.step != before.step + 1) return;
  for (std::size_t g = 0; g < after.torque.size(); ++g) {
    const double change = (after.inertia_times_spin[g] - before.inertia_times_spin[g]) / step_;
    const double defect = std::abs(after.torque[g] - change);
    torques_.add(after.scale > 0 ? defect / after.scale : defect, after.time, g);
  }
}

}  // namespace grseg
