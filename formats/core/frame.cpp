// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/frame.hpp"

namespace grseg {

template <int D>
void ContactList<D>::clear()
{
  i.clear();
  j.clear();
  force.clear();
  branch.clear();
  gap.clear();
}

template <int D>
void ContactList<D>::reserve(std::size_t contacts)
{
  i.reserve(contacts);
  j.reserve(contacts);
  force.reserve(contacts);
  branch.reserve(contacts);
  gap.reserve(contacts);
}

template struct ContactList<2>;
template struct ContactList<3>;

template <int D>
double share_of_first(const Grains& grains, const ContactList<D>& contacts, std::size_t contact)
{
  const auto j = contacts.j[contact];
  if (j < 0) return 1;
  const double radius_i = grains.radius[static_cast<std::size_t>(contacts.i[contact])];
  const double radius_j = grains.radius[static_cast<std::size_t>(j)];
  const double gap = contacts.gap[contact];
  return (radius_i + gap / 2) / (radius_i + radius_j + gap);
}

template <int D>
Vector<D> contact_point(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(frame.contacts.i[contact]);
  return frame.position[i] -
         share_of_first(grains, frame.contacts, contact) * frame.contacts.branch[contact];
}

template double share_of_first(const Grains&, const ContactList<2>&, std::size_t);
template double share_of_first(const Grains&, const ContactList<3>&, std::size_t);
template Vec2 contact_point(const Grains&, const Frame<2>&, std::size_t);
template Vec3 contact_point(const Grains&, const Frame<3>&, std::size_t);

}  // namespace grseg
