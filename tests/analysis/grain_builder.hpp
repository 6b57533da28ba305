// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Builds grains and one frame by hand.
template <int D>
struct PackingOf {
  Grains grains;
  Frame<D> frame;

  /// Adds a grain of density 1 kg/m^2 or kg/m^3; returns its row.
  std::int32_t grain(Species species, double radius, const Vector<D>& position,
                     const Vector<D>& velocity = Vector<D>::Zero(), const Spin<D>& spin = no_spin())
  {
    const auto row = static_cast<std::int32_t>(grains.size());
    grains.id.push_back(row);
    grains.species.push_back(species);
    grains.radius.push_back(radius);
    grains.mass.push_back(grain_volume<D>(radius));
    grains.fixed.push_back(species == Species::boundary ? 1 : 0);
    frame.position.push_back(position);
    frame.velocity.push_back(velocity);
    frame.angular_velocity.push_back(spin);
    return row;
  }

  /// Adds a contact between two grains that touch, with the force on i from j.
  void contact(std::int32_t i, std::int32_t j, const Vector<D>& force)
  {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const Vector<D> branch = frame.position[a] - frame.position[b];
    add(i, j, force, branch, branch.norm() - grains.radius[a] - grains.radius[b]);
  }

  /// Adds a contact through the periodic boundary; `branch` points from the image of j to i.
  void image_contact(std::int32_t i, std::int32_t j, const Vector<D>& force,
                     const Vector<D>& branch)
  {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    add(i, j, force, branch, branch.norm() - grains.radius[a] - grains.radius[b]);
  }

  /// Adds a contact with straight wall number `wall`.
  void wall_contact(std::int32_t i, int wall, const Vector<D>& force, const Vector<D>& branch)
  {
    add(i, -wall - 1, force, branch, branch.norm() - grains.radius[static_cast<std::size_t>(i)]);
  }

 private:
  static Spin<D> no_spin()
  {
    if constexpr (D == 2)
      return 0;
    else
      return Vec3::Zero();
  }
  void add(std::int32_t i, std::int32_t j, const Vector<D>& force, const Vector<D>& branch,
           double gap)
  {
    frame.contacts.i.push_back(i);
    frame.contacts.j.push_back(j);
    frame.contacts.force.push_back(force);
    frame.contacts.branch.push_back(branch);
    frame.contacts.gap.push_back(gap);
  }
};
using Packing = PackingOf<2>;

/// Large grains' share of the contents that Composition returns.
inline double phi_large(const std::vector<double>& contents)
{
  return contents[1] / (contents[0] + contents[1]);
}

/// True if all components are equal to round-off.
template <class Numbers, class Others>
bool same(const Eigen::MatrixBase<Numbers>& a, const Eigen::MatrixBase<Others>& b,
          double tolerance = 1e-14)
{
  return (a - b).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace grseg
