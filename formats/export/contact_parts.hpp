// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <Eigen/Geometry>

namespace grseg {

/// The force of a contact along and across n = branch/|branch|: in two dimensions along
/// t = (-n_y, n_x), in three the modulus.
template <int D>
struct ContactParts {
  Vector<D> n;
  double normal, tangential;  // N, on i; normal > 0 pushes i away from j
};

template <int D>
ContactParts<D> contact_parts(const ContactList<D>& contacts, std::size_t contact)
{
  const Vector<D> n = contacts.branch[contact].normalized();
  const Vector<D>& force = contacts.force[contact];
  if constexpr (D == 2)
    return {n, n.dot(force), n.x() * force.y() - n.y() * force.x()};
  else
    return {n, n.dot(force), n.cross(force).norm()};
}

}  // namespace grseg
