// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Content of a player: discs in a plane and the contacts between them. In three dimensions, the plane
/// z = half the width of the cell cuts the discs out of spheres.
namespace grseg {

/// A straight wall: the points c with n c = offset, n pointing into the bed.
struct ShownWall {
  float normal_x, normal_y, offset;  // offset in m
};

struct ShownFrame {
  std::int64_t step = 0;
  double time = 0;                  // s
  Vec2 gravity{0, 0};               // m/s^2, at that time
  std::vector<float> x, y, radius;  // m, by grain; all NaN if it is absent or not cut
  /// Contacts that bear a force, in order of i, then j; j < 0 is wall -j-1 of `walls`.
  std::vector<std::int32_t> i, j;
  /// Force on i in the plane, N: along the branch from j to i, and across it, positive to its left.
  std::vector<float> along, across;
  /// Walls that had a contact up to now, in order of their first one; NaN if a wall does not cut the plane.
  std::vector<ShownWall> walls;
};

struct ShownRun {
  /// Grains that are shown in at least one frame: their numbers in the run, their radii themselves (m), and
  /// their species (boundary if they are fixed). Contacts number grains in this order.
  std::vector<std::uint32_t> row;
  std::vector<float> radius;
  std::vector<Species> species;
  std::vector<ShownFrame> frames;
  /// Largest difference between the shares of a mixed contact by `contact-point` and by `size`.
  double contact_point_from_size = 0;
};

/// Largest number of walls, more than any scene has: a file with more is damaged or malicious.
inline constexpr std::size_t most_walls = 1000;

/// About `count` of the frames, in equal steps from the first one on: between 2/3 and 3/2 of `count`, or
/// all frames if there are fewer.
std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& frames, std::size_t count);

/// Reads these frames of a run; `grains` has the species by which grains are coloured. Errors as
/// TrajectoryReader; FormatError where there are more than most_walls walls.
template <int D>
ShownRun show_run(const TrajectoryReader& run, const Grains& grains,
                  const std::vector<std::size_t>& frames);

}  // namespace grseg
