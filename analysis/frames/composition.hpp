// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/layers.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <cassert>
#include <optional>
#include <vector>

namespace grseg {

/// How the area of a grain is given to layers: cut at their edges, whole where its centre is, or
/// spread about its centre by a coarse-graining kernel (coarse_graining.hpp).
enum class GrainArea { clipped, centre, kernel };
inline constexpr Choice<GrainArea> grain_areas[] = {
    {"clipped", GrainArea::clipped}, {"centre", GrainArea::centre}, {"kernel", GrainArea::kernel}};

/// Area of small and of large mobile grains in each layer: phi_L = large/(small + large), and the
/// solid fraction nu = (small + large)/V. Means per frame.
class Composition {
 public:
  struct Areas {
    double small = 0, large = 0;  // m^2

    /// NaN where there are no grains.
    double phi_large() const { return large / (small + large); }
  };

  /// `kernel` belongs to GrainArea::kernel.
  Composition(const Layers& layers, GrainArea rule, std::optional<Kernel> kernel = std::nullopt)
      : layers_(layers), rule_(rule), kernel_(kernel)
  {
    assert(kernel_ || rule_ != GrainArea::kernel);
  }

  void add(const Grains& grains, const Frame<2>& frame);
  void merge(const Composition& others);
  std::size_t layers() const { return sums_.size(); }
  Areas mean(std::size_t layer) const;
  /// All layers together.
  Areas mean() const;

 private:
  Layers layers_;
  GrainArea rule_;
  std::optional<Kernel> kernel_;
  std::size_t frames_ = 0;
  std::vector<std::array<double, 2>> sums_;  // by species
};

}  // namespace grseg
