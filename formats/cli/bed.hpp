// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace grseg {

/// The line "bed" of a table. It tells one run from another, whichever frames their files hold:
///
///   grains 205, sizes 203, crc32 0a1b2c3d, seed 1, flow 9f8e7d6c
///
/// A run, its continuation and a run from a checkpoint of it have one bed.
struct Bed {
  /// "grains 205, sizes 203, crc32 0a1b2c3d": the rows of the file, how many radii differ, and the
  /// crc32 of the radii (8 bytes each, little endian) and, after them, the ids (4 bytes).
  std::string grains;
  /// True where more than half of the radii differ, so that no other seed has them.
  bool varied = false;
  /// True where other parts of the run may list other grains.
  bool come_and_go = false;
  std::string seed;  ///< of the scene; "" where the run states none
  /// crc32 of the keys of the scene, and options of its restarts, that act on the motion from the
  /// deposition on; "" where the run does not state its scene.
  std::string flow;

  std::string text() const;
};

/// True of keys of a scene, and options of grseg-sim, that act on how grains move.
bool acts_on_motion(std::string_view key);

Bed bed_of(const TrajectoryReader& run);
/// The bed that a line describes; nothing if the line cannot be read.
std::optional<Bed> parse_bed(const std::string& text);

}  // namespace grseg
