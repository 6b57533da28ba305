// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "formats/core/frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace grseg {

/// True if a contact bears a force. Files also list pairs that are close without a force.
template <int D>
bool bears_force(const ContactList<D>& contacts, std::size_t contact)
{
  return (contacts.force[contact].array() != 0).any();
}

/// Normal and tangential part of a contact's force: f = f_n n + f_t t, n = branch/|branch|. f_n > 0
/// in repulsion; exchanging the two grains of a contact changes neither part. In two dimensions t
/// is n turned by +90 degrees; in three t is along the tangential force, and f_t >= 0.
template <int D>
struct ForceParts {
  Vector<D> n;      // unit normal from grain j to grain i
  double f_n, f_t;  // normal and tangential force, N
};
template <int D>
ForceParts<D> force_parts(const ContactList<D>& contacts, std::size_t contact)
{
  const Vector<D>& f = contacts.force[contact];
  const Vector<D> n = contacts.branch[contact].normalized();
  if constexpr (D == 2)
    return {n, f.dot(n), f.y() * n.x() - f.x() * n.y()};
  else
    return {n, f.dot(n), f.cross(n).norm()};
}

/// Layer or cell that contains the contact point. Above the last of `count` layers, which contains
/// the top of the highest grain of this frame, a contact belongs to the last one.
template <int D>
std::size_t layer_of_contact(const Layers& layers, const Grains& grains, const Frame<D>& frame,
                             std::size_t contact, std::size_t count)
{
  const Vector<D> point = contact_point(grains, frame, contact);
  return std::min(layers.holding<D>(point, layers.height<D>(point)), count - 1);
}

/// Zero as an angular velocity or a torque.
template <int D>
Spin<D> no_spin()
{
  if constexpr (D == 2)
    return 0;
  else
    return Vec3::Zero();
}

/// Torques of the contacts on all grains, N m, one entry per row of Grains; positive
/// counter-clockwise, in three dimensions right-handed about each axis. The force between two
/// grains acts at r_i/(r_i + r_j) of the branch, so that the lever arms add up to the distance of
/// the centres. At a straight wall the lever arm is r_i.
template <int D>
std::vector<Spin<D>> torques_of(const Grains& grains, const ContactList<D>& contacts);

/// The straight walls of a run by number. Files do not store the place of a wall, so it is found
/// from contacts: the contact point lies on the wall, and the branch is normal to it. A wall
/// without contacts is not known.
template <int D>
class Walls {
 public:
  /// A half-plane or half-space; `normal` (unit length) points to the grains.
  struct Wall {
    Vector<D> point, normal;
  };

  /// Finds the walls that have contacts in a frame, and replaces their earlier places.
  void add(const Frame<D>& frame);
  const std::map<std::int32_t, Wall>& all() const { return walls_; }

 private:
  std::map<std::int32_t, Wall> walls_;
};

}  // namespace grseg
