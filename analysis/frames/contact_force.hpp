// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <Eigen/Geometry>
#include <cstddef>

namespace grseg {

/// Whether a contact bears a force at all. Files also list pairs that are only close.
template <int D>
bool bears_force(const ContactList<D>& contacts, std::size_t contact)
{
  return (contacts.force[contact].array() != 0).any();
}

/// Normal and tangential part of a contact's force: f = f_n n + f_t t, n = branch/|branch|. f_n > 0
/// in repulsion; exchanging the two grains of a contact changes neither part. In two dimensions t is
/// n turned by +90 degrees; in three t is along the tangential force, and f_t >= 0.
template <int D>
struct ForceParts {
  Vector<D> n;      // from j to i
  double f_n, f_t;  // N
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

}  // namespace grseg
