// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/rigid_pairs.hpp"

#include "formats/import/common/frame_tools.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace grseg {
namespace {

/// Relative difference up to which two motions count as equal. Velocities have six digits, and the
/// rotation may be a hundredth of them.
constexpr double same_motion = 1e-4;
/// Largest part of the acceleration by contacts that may be missing where no inner force acts.
constexpr double same_acceleration = 0.1;

/// Accelerations of the grains by the forces of a frame.
struct Accelerations {
  std::vector<Vec3> linear, angular;  // m/s^2, 1/s^2; 0 for grains that do not move
  std::vector<double> by_contacts;    // sum of |contact force| over the mass, m/s^2

  Accelerations(const Grains& grains, const Frame<3>& frame, double inertia)
      : linear(grains.size(), Vec3::Zero()), angular(linear), by_contacts(grains.size(), 0)
  {
    const auto add = [&](std::int32_t grain, const Vec3& force, const Vec3& arm) {
      if (grain < 0 || !is_mobile(grains, frame, row(grain))) return;
      const double mass = grains.mass[row(grain)], radius = grains.radius[row(grain)];
      by_contacts[row(grain)] += force.norm() / mass;
      angular[row(grain)] += arm.cross(force) / (inertia * mass * radius * radius);
    };
    const auto& contacts = frame.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const double share = share_of_first(grains, contacts, c);
      add(contacts.i[c], contacts.force[c], -share * contacts.branch[c]);
      add(contacts.j[c], -contacts.force[c], (1 - share) * contacts.branch[c]);
    }
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (is_mobile(grains, frame, g)) linear[g] = frame.force[g] / grains.mass[g];
  }

  bool keep_together(const Box& box, const Frame<3>& frame, const NearPair& pair) const
  {
    const auto i = row(pair.i), j = row(pair.j);
    const Vec3 branch = minimum_image(box, frame.position[i] - frame.position[j]);
    const Vec3& spin = frame.angular_velocity[i];
    const Vec3 of_body = spin.cross(spin.cross(branch)) + angular[i].cross(branch);
    const double apart = (linear[i] - linear[j] - of_body).norm();
    const double turned = (angular[i] - angular[j]).norm() * branch.norm();
    return std::max(apart, turned) <= same_acceleration * std::max(by_contacts[i], by_contacts[j]);
  }
};

}  // namespace

bool moves_as_one(const Box& box, const Frame<3>& frame, const NearPair& pair, bool joined)
{
  const auto i = row(pair.i), j = row(pair.j);
  const double spin = frame.angular_velocity[i].norm();
  const Vec3 other = frame.angular_velocity[i] - frame.angular_velocity[j];
  if (other.norm() > same_motion * spin) return false;
  const Vec3 branch = minimum_image(box, frame.position[i] - frame.position[j]);
  const Vec3 relative = frame.velocity[i] - frame.velocity[j];
  if (spin == 0)
    return joined && std::abs(relative.dot(branch)) < same_motion * relative.norm() * branch.norm();
  const Vec3 turning = frame.angular_velocity[i].cross(branch);
  return (relative - turning).norm() <= same_motion * spin * branch.norm();
}

double part_of_mobile(const Grains& grains, const std::vector<NearPair>& pairs)
{
  if (pairs.empty()) return 0;
  std::set<std::int32_t> members;
  for (const auto& pair : pairs) members.insert({pair.i, pair.j});
  double mobile = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) mobile += is_mobile(grains, g);
  return mobile > 0 ? static_cast<double>(members.size()) / mobile : 0;
}

void remove_plugs(const Grains& grains, const Box& box, const Frame<3>& frame, double inertia,
                  std::vector<NearPair>& pairs)
{
  if (pairs.empty()) return;
  const Accelerations by_forces(grains, frame, inertia);
  std::erase_if(pairs,
                [&](const NearPair& pair) { return by_forces.keep_together(box, frame, pair); });
}

}  // namespace grseg
