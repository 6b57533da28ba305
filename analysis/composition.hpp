// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/layers.hpp"
#include "formats/frame.hpp"

#include <array>
#include <vector>

namespace grseg {

/// How the area of a grain is given to layers: cut at their edges, or whole where its centre is.
enum class GrainArea { clipped, centre };

/// Area of small and of large mobile grains in each layer: phi_L = large/(small + large), and the
/// solid fraction nu = (small + large)/V. Means per frame.
class Composition {
 public:
  struct Areas {
    double small = 0, large = 0;  // m^2

    /// NaN where there are no grains.
    double phi_large() const { return large / (small + large); }
  };

  Composition(const Layers& layers, GrainArea rule) : layers_(layers), rule_(rule) {}

  void add(const Grains& grains, const Frame& frame);
  void merge(const Composition& others);
  std::size_t layers() const { return sums_.size(); }
  Areas mean(std::size_t layer) const;
  /// All layers together.
  Areas mean() const;

 private:
  Layers layers_;
  GrainArea rule_;
  std::size_t frames_ = 0;
  std::vector<std::array<double, 2>> sums_;  // by species
};

}  // namespace grseg
