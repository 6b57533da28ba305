// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <optional>

namespace grseg {

/// A circle in the plane of x and y, m.
struct Ring {
  Vec2 centre;
  double radius;
};

/// The ring, such as a drum, on which contacts with straight walls lie, or else boundary grains.
/// Empty if they lie on no circle, to a hundredth of its radius. The circle is the algebraic fit of
/// Kasa (1976) to at most ten frames.
std::optional<Ring> find_ring(const TrajectoryReader& run);

}  // namespace grseg
