// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

namespace grseg {

/// The force of a contact along and across n = branch/|branch|, t = (-n_y, n_x).
struct ContactParts {
  Vec2 n;
  double normal, tangential;  // N, on i; normal > 0 pushes i away from j
};

inline ContactParts contact_parts(const ContactList<2>& contacts, std::size_t contact)
{
  const Vec2 n = contacts.branch[contact].normalized(), &force = contacts.force[contact];
  return {n, n.dot(force), n.x() * force.y() - n.y() * force.x()};
}

}  // namespace grseg
