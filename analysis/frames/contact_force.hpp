// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>

namespace grseg {

/// Whether a contact bears a force at all. Files also list pairs that are only close.
inline bool bears_force(const ContactList<2>& contacts, std::size_t contact)
{
  const Vec2& f = contacts.force[contact];
  return f.x() != 0 || f.y() != 0;
}

/// Normal and tangential part of a contact's force: f = f_n n + f_t t, n = branch/|branch| and t is
/// n turned by +90 degrees. f_n > 0 in repulsion; exchanging the two grains changes neither part.
struct ForceParts {
  Vec2 n;           // from j to i
  double f_n, f_t;  // N
};
inline ForceParts force_parts(const ContactList<2>& contacts, std::size_t contact)
{
  const Vec2& f = contacts.force[contact];
  const Vec2 n = contacts.branch[contact].normalized();
  return {n, f.dot(n), f.y() * n.x() - f.x() * n.y()};
}

}  // namespace grseg
