// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/contacts.hpp"

namespace grseg {
namespace {

/// Cross product n x f, N; in two dimensions its component along z.
template <int D>
Spin<D> moment(const Vector<D>& n, const Vector<D>& f)
{
  if constexpr (D == 2)
    return f.y() * n.x() - f.x() * n.y();
  else
    return n.cross(f);
}

}  // namespace

template <int D>
std::vector<Spin<D>> torques_of(const Grains& grains, const ContactList<D>& contacts)
{
  std::vector<Spin<D>> torque(grains.size(), no_spin<D>());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Spin<D> turning = moment<D>(contacts.branch[c].normalized(), contacts.force[c]);
    if (contacts.j[c] < 0) {
      torque[i] -= grains.radius[i] * turning;
      continue;
    }
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    const double r_i = grains.radius[i], r_j = grains.radius[j];
    const double kappa = contacts.branch[c].norm() / (r_i + r_j);
    torque[i] -= kappa * r_i * turning;
    torque[j] -= kappa * r_j * turning;
  }
  return torque;
}

template std::vector<Spin<2>> torques_of(const Grains&, const ContactList<2>&);
template std::vector<Spin<3>> torques_of(const Grains&, const ContactList<3>&);

template <int D>
void Walls<D>::add(const Frame<D>& frame)
{
  const auto& list = frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list.j[k] >= 0 || !(list.branch[k].norm() > 0)) continue;
    const auto& centre = frame.position[static_cast<std::size_t>(list.i[k])];
    walls_[-1 - list.j[k]] = {centre - list.branch[k], list.branch[k].normalized()};
  }
}

template class Walls<2>;
template class Walls<3>;

}  // namespace grseg
