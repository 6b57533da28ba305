// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/imported_bed.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Contacts with plane walls of which the archive has no rows: a grain touches a wall where its
/// centre is nearer to the plane than its radius, and what its other contacts and its weight leave
/// of the force on it, the wall exerts:
///   force of the wall = force on the grain - m g - sum of its contact forces.
/// Errors of all these forces add up in it, damping half a step late among them, and the grain's
/// balance is no check any more. A grain that touches two walls shares this force out: along each
/// normal it is that wall's, the rest is shared in proportion; a wall that would pull gets nothing.
class InferredWalls {
 public:
  /// In the archive's units. UsageError where a wall lies across the plane of a flow in two
  /// dimensions or across a period.
  explicit InferredWalls(const ImportedBed& bed);

  /// Appends these contacts to the frame. The walls here have the first numbers; wall numbers of
  /// contacts that the frame already has move up by as many. A wall that the grain already has a
  /// contact with is left out. UsageError where grains have no forces.
  void add_to(Frame<3>& frame);

  /// By row, of the last frame: 1 where the balance of the grain went into a wall's force.
  const std::vector<std::uint8_t>& inferred() const { return inferred_; }
  /// A sentence on the walls and their contacts, equal in every part of an archive.
  std::string remark() const;
  /// How often it was done so far, a sentence each.
  std::vector<std::string> counts() const;

 private:
  struct Plane {
    Vec3 direction;   // unit
    double position;  // of the plane along it, in the flow's axes
  };
  /// A grain at a wall.
  struct Touch {
    std::size_t wall;
    Vec3 branch;  // from the plane to the centre
    Vec3 normal;  // towards the grain
  };
  double largest_force(const Frame<3>& frame) const;
  std::vector<Vec3> missing_forces(const Frame<3>& frame) const;
  std::vector<Touch> touches(const Frame<3>& frame, std::size_t grain, const Vec3& missing) const;
  void add(Frame<3>& frame, std::size_t grain, std::vector<Touch> touches, const Vec3& missing);
  void append(Frame<3>& frame, std::size_t grain, const Touch& touch, const Vec3& force);

  const ImportedBed& bed_;
  std::vector<Plane> planes_;
  std::vector<std::uint8_t> inferred_;
  std::vector<std::size_t> contacts_of_;  // of each wall, in all frames so far
  std::size_t frames_ = 0, fewest_ = 0, most_ = 0, contacts_ = 0, at_two_ = 0, pulling_ = 0;
  double largest_pull_ = 0;   // over the largest force of its frame
  double largest_force_ = 0;  // of this frame
};

}  // namespace grseg
