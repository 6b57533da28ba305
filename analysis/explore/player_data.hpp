// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/binary_arrays.hpp"
#include "analysis/explore/shown_run.hpp"

#include <nlohmann/json.hpp>

namespace grseg {

/// The same for a page, positions, radii in the plane and forces in 16 bits. Adds to `arrays`
///
///   species (255: base), radius (m), row       by grain
///   x, y, and of spheres cut_radius            by frame and grain: Quantisation "x", "y", "cut"
///   contact_offset                             by frame and once more: where its contacts begin
///   i, j, along, across                        by contact: i less that of the contact before in its
///                                              frame; wall w has j = 2^16 - 1 - w, of more than 2^15
///                                              grains 2^32 - 1 - w; Quantisation "along", "across"
///   walls                                      by frame and wall: normal x, y, offset (m)
///
/// and returns what is needed to read them: bounds, numbers, times and gravity (m/s^2, by frame).
nlohmann::ordered_json player_data(const ShownRun& run, const Box& box, BinaryArrays& arrays);

/// Bytes of these arrays at most, where `frames` frames are shown; for spheres about as many.
double player_bytes(const TrajectoryReader& run, std::size_t frames);

}  // namespace grseg
