// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <vector>

namespace grseg {

/// The angular velocity, or the torque, that is zero.
template <int D>
Spin<D> no_spin()
{
  if constexpr (D == 2)
    return 0;
  else
    return Vec3::Zero();
}

/// Torques of the contacts on all grains, one entry per row of Grains, N m; counter-clockwise, in
/// three dimensions right-handed about each axis. The force between two grains acts at
/// r_i/(r_i + r_j) of the branch, so that the lever arms add up to the distance of the centres; at a
/// straight wall the arm is r_i.
template <int D>
std::vector<Spin<D>> torques_of(const Grains& grains, const ContactList<D>& contacts);

}  // namespace grseg
