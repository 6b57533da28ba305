// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace grseg {

/// xxh3 (64 bit) of a frame as it is stored, chained with the digest of the frame before (0 for the
/// first). The bytes are, little endian and in this order: step, time, position, image, velocity,
/// angular_velocity, force, then i, j, force, branch, gap of the contacts. With `float32` the
/// floating-point arrays (not `time`) are rounded to 4 bytes first, as in the file.
std::uint64_t frame_digest(const Frame& frame, std::uint64_t before, bool float32);

/// xxh3 (64 bit) of any bytes, chained with the digest of the bytes before.
std::uint64_t chain_digest(const void* data, std::size_t bytes, std::uint64_t before);

/// 16 hexadecimal digits.
std::string format_digest(std::uint64_t digest);

}  // namespace grseg
