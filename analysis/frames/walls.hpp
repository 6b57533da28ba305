// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstdint>
#include <map>

namespace grseg {

/// The straight walls of a run by number. Files do not say where they lie, but contacts do: the
/// contact point lies on the wall, and the branch is normal to it. A wall that nothing touches is
/// not known.
template <int D>
class Walls {
 public:
  /// A half-plane or half-space; `normal` (unit length) points to the grains.
  struct Wall {
    Vector<D> point, normal;
  };

  /// Learns from the contacts of a frame; what was known of a wall before is replaced.
  void add(const Frame<D>& frame);
  const std::map<std::int32_t, Wall>& all() const { return walls_; }

 private:
  std::map<std::int32_t, Wall> walls_;
};

}  // namespace grseg
