// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace grseg {

/// The header line "bed" of a table, which identifies a run independently of the stored frames:
///
///   grains 205, sizes 203, crc32 0a1b2c3d, seed 1, flow 9f8e7d6c
///
/// A run, its continuation and any run from one of its checkpoints have the same bed.
struct Bed {
  /// "grains 205, sizes 203, crc32 0a1b2c3d": number of grains in the file, number of different
  /// radii, and crc32 of all radii (8 bytes each, little endian) and then all ids (4 bytes each).
  std::string grains;
  /// True if more than half of the radii differ; no other seed then has the same radii.
  bool varied = false;
  /// True if grains enter and leave: files of other parts of the run may list other grains.
  bool come_and_go = false;
  std::string seed;  ///< seed of the scene; "" if the run does not state it
  /// crc32 of the scene keys and restart options that affect the motion of grains, from the
  /// deposition on; "" if the run does not state its scene.
  std::string flow;

  std::string text() const;
};

/// True for scene keys and options of grseg-sim that affect how grains move.
bool acts_on_motion(std::string_view key);

Bed bed_of(const TrajectoryReader& run);
/// The bed from the value of a header line "bed"; empty if the text cannot be read.
std::optional<Bed> parse_bed(const std::string& text);

}  // namespace grseg
