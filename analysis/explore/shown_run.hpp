// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// What a player shows of a run: discs in a plane and the contacts between them. Of spheres these are
/// the discs that the plane z = half the width cuts out of them.
namespace grseg {

/// A straight wall: the points c with n c = offset, n pointing into the bed.
struct ShownWall {
  float normal_x, normal_y, offset;  // offset in m
};

struct ShownFrame {
  std::int64_t step = 0;
  double time = 0;                  // s
  Vec2 gravity{0, 0};               // m/s^2, at that time
  std::vector<float> x, y, radius;  // m, by grain; all NaN where it is absent or not cut
  /// Contacts that bear a force, in order of i, then j; j < 0 is wall -j-1 of `walls`.
  std::vector<std::int32_t> i, j;
  /// N, of the force on i in the plane: along the branch from j to i, and across it, to its left.
  std::vector<float> along, across;
  /// Those that contacts have told of so far, in order of their first contact, whatever their numbers in
  /// the file; NaN of a wall that does not cut the plane.
  std::vector<ShownWall> walls;
};

struct ShownRun {
  std::vector<std::uint32_t>
      row;                       // of each grain among those of the run: those that are ever shown
  std::vector<float> radius;     // m, of each grain itself
  std::vector<Species> species;  // of each grain; boundary of all that are fixed
  std::vector<ShownFrame> frames;  // whose i, j count grains in the order above
  /// Largest difference between the shares of a mixed contact by `contact-point` and by `size`.
  double contact_point_from_size = 0;
};

/// More than any scene has; a file that names as many is damaged, or was made to do harm.
inline constexpr std::size_t most_walls = 1000;

/// About `count` of `frames`, between two thirds of it and half as many more, in equal steps from the
/// first one on; all of fewer.
std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& frames, std::size_t count);

/// These frames of a run, `grains` having the species that are told apart. Errors as TrajectoryReader;
/// FormatError where there are more than most_walls walls.
template <int D>
ShownRun show_run(const TrajectoryReader& run, const Grains& grains,
                  const std::vector<std::size_t>& frames);

}  // namespace grseg
