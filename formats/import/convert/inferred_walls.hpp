// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/imported_bed.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Contacts with plane walls (--wall) that the archive does not list. A grain touches a wall if its
/// centre is nearer to the plane than its radius. The force of the wall follows from Newton's law:
///   force of the wall = force on the grain - m g - sum of its contact forces.
/// The errors of all these forces add up in it, including damping half a step late, and the grain's
/// force balance can no longer be checked. If a grain touches two walls, each wall exerts the
/// component along its normal; the rest is divided in proportion. A wall that would pull exerts no
/// force.
class InferredWalls {
 public:
  /// Works in the archive's units. Throws UsageError if a wall is parallel to the plane of a flow
  /// in two dimensions, or normal to a periodic direction.
  explicit InferredWalls(const ImportedBed& bed);

  /// Appends the inferred contacts to the frame. Walls of --wall get the first wall numbers; the
  /// numbers of the archive's own walls increase. A wall is skipped for a grain that already has a
  /// contact there. Throws UsageError if the archive has no forces on grains.
  void add_to(Frame<3>& frame);

  /// Flags by row, for the last frame: 1 if the grain's balance was used to infer a wall's force.
  const std::vector<std::uint8_t>& inferred() const { return inferred_; }
  /// Sentences about the inferred walls and the contacts with them so far.
  std::vector<std::string> remarks() const;

 private:
  struct Plane {
    Vec3 direction;   // unit vector normal to the plane
    double position;  // coordinate of the plane along `direction`, in the axes of the flow
  };
  /// Geometry of a contact of a grain with a wall.
  struct Touch {
    std::size_t wall;
    Vec3 branch;  // vector from the plane to the grain's centre
    Vec3 normal;  // unit normal of the plane, towards the grain
  };
  double largest_force(const Frame<3>& frame) const;
  std::vector<Vec3> missing_forces(const Frame<3>& frame) const;
  std::vector<Touch> touches(const Frame<3>& frame, std::size_t grain, const Vec3& missing) const;
  void add(Frame<3>& frame, std::size_t grain, std::vector<Touch> touches, const Vec3& missing);
  void append(Frame<3>& frame, std::size_t grain, const Touch& touch, const Vec3& force);

  const ImportedBed& bed_;
  std::vector<Plane> planes_;
  std::vector<std::uint8_t> inferred_;
  std::vector<std::size_t> contacts_of_;  // number of contacts by wall, in all frames so far
  std::size_t frames_ = 0, fewest_ = 0, most_ = 0, contacts_ = 0, at_two_ = 0, pulling_ = 0;
  double largest_pull_ = 0;   // largest attractive force / largest force of its frame
  double largest_force_ = 0;  // largest contact force or weight of the current frame
};

}  // namespace grseg
