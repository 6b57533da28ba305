// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <cassert>
#include <optional>
#include <tuple>
#include <vector>

namespace grseg {

/// How the area or volume of a grain is given to layers: cut at their edges, whole where its centre
/// is, or spread about its centre by a coarse-graining kernel (coarse_graining.hpp).
enum class GrainArea { clipped, centre, kernel };
inline constexpr Choice<GrainArea> grain_areas[] = {
    {"clipped", GrainArea::clipped}, {"centre", GrainArea::centre}, {"kernel", GrainArea::kernel}};

/// Area (m^2) or volume (m^3) of the mobile grains of each species in each layer. The local
/// composition phi is a species' part of their sum, the solid fraction nu their sum over V. Means
/// per frame.
template <int D>
class Composition {
 public:
  using Contents = std::vector<double>;  // by species, m^2 or m^3

  /// `kernel` belongs to GrainArea::kernel.
  Composition(const Layers& layers, GrainArea rule, std::optional<Kernel> kernel = std::nullopt,
              std::size_t species = 2)
      : layers_(layers), rule_(rule), kernel_(kernel), species_(species)
  {
    assert(kernel_ || rule_ != GrainArea::kernel);
  }

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const Composition& others);
  std::size_t layers() const { return sums_.size(); }
  Contents mean(std::size_t layer) const;
  /// All layers together.
  Contents mean() const;

 private:
  Layers layers_;
  GrainArea rule_;
  std::optional<Kernel> kernel_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::vector<Contents> sums_;
};

/// Heights of the bed, m; NaN where they are not known.
struct BedHeights {
  // y_L, y_S: centres of mass of the species, where there are two.
  double large = no_number, small = no_number;
  double bed = no_number;  // twice the mean height of the mobile grains' area or volume

  static constexpr auto members =
      std::tuple(&BedHeights::large, &BedHeights::small, &BedHeights::bed);
};

/// Heights in one frame; NaN for a species without mobile grains.
template <int D>
BedHeights bed_heights(const Grains& grains, const Frame<D>& frame);

/// The columns yL, yS and height.
std::vector<Cell> cells(const BedHeights& heights);

}  // namespace grseg
