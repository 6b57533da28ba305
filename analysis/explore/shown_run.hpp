// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Frames that the player of the page shows: grains and the contacts between them. Of spheres it shows
/// those with their centres in a slice about the plane in the middle of the cell. The slice
/// is as thick as the largest species' diameter, as in pictures of grseg-render.
namespace grseg {

/// A straight wall: the points c with n c = offset; the unit normal n points into the bed.
struct ShownWall {
  float normal_x, normal_y, offset;  // offset in m
};

struct ShownFrame {
  std::int64_t step = 0;
  double time = 0;          // time of the frame, s
  Vec2 gravity{0, 0};       // gravity at `time`, m/s^2
  std::vector<float> x, y;  // m, by grain; NaN if the grain is absent or not in the slice
  std::vector<float> z;     // m, by grain, from the middle of the slice; 0 for discs, else like x
  /// Grains i and j of contacts with a force, in order of i, then j; j < 0 is wall -j-1 of `walls`.
  std::vector<std::int32_t> i, j;
  /// Components of the force on i in the plane, N: along the branch (the vector from j to i), and across
  /// it, positive to the left.
  std::vector<float> along, across;
  /// All walls touched up to this frame, in order of their first contact; numbers are NaN for walls that the
  /// plane does not cut.
  std::vector<ShownWall> walls;
};

struct ShownRun {
  /// Grains that at least one frame shows: row in the run, radius (m), and species
  /// (`boundary` if the grain is fixed). i and j of contacts are indices into these lists.
  std::vector<std::uint32_t> row;
  std::vector<float> radius;
  std::vector<Species> species;
  std::vector<ShownFrame> frames;
  /// Largest difference between the shares of a mixed contact by `contact-point` and by `size`.
  double contact_point_from_size = 0;
};

/// Largest accepted number of walls. No scene has as many: a file with more is damaged or malicious.
inline constexpr std::size_t most_walls = 1000;

/// Every n-th of the frames, from the first one on. n is chosen so that the result has between 2/3 and 3/2
/// of `count` frames, or all frames if there are fewer.
std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& frames, std::size_t count);

/// Reads these frames of a run; `grains` has the species by which grains are coloured. Throws the errors of
/// TrajectoryReader, and FormatError if there are more than most_walls walls.
template <int D>
ShownRun show_run(const TrajectoryReader& run, const Grains& grains,
                  const std::vector<std::size_t>& frames);

}  // namespace grseg
