// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"

#include <cassert>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace grseg {

/// How the area or volume of a grain is divided among layers: cut at the layers' edges, whole in
/// the layer of the grain's centre, or spread about the centre by a kernel (coarse_graining.hpp).
enum class GrainArea { clipped, centre, kernel };
inline constexpr Choice<GrainArea> grain_areas[] = {
    {"clipped", GrainArea::clipped}, {"centre", GrainArea::centre}, {"kernel", GrainArea::kernel}};

/// Sums over the mobile grains of a layer, weighted by area (m^2) or volume (m^3), as a mean over
/// frames. Divided by the area or volume of the grains they are means.
struct MotionSums {
  double u = 0;       // of the velocity along the layer (x; in annuli round), m^D m/s
  double square = 0;  // of the square of the velocity, m^D m^2/s^2

  static constexpr auto members = std::tuple(&MotionSums::u, &MotionSums::square);
};
/// Names of the two columns, "area_u[m^3/s]" and "area_v2[m^4/s^2]".
std::vector<std::string> motion_columns(int dimension);

/// Area (m^2) or volume (m^3) of the mobile grains of each species in each layer, as a mean over
/// the frames. The local composition phi of a species is its part of the sum over all species. The
/// solid fraction nu is this sum over the volume V of the layer.
template <int D>
class Composition {
 public:
  using Contents = std::vector<double>;  // area or volume of grains, by species, m^2 or m^3

  /// `kernel` is required for GrainArea::kernel and unused otherwise. Throws UsageError for spheres
  /// that would be clipped at annuli.
  Composition(const Layers& layers, GrainArea rule, std::optional<Kernel> kernel = std::nullopt,
              std::size_t species = 2)
      : layers_(layers), rule_(rule), kernel_(kernel), species_(species)
  {
    assert(kernel_ || rule_ != GrainArea::kernel);
    if (D == 3 && layers.axis() && !layers.map() && rule == GrainArea::clipped)
      throw UsageError(
          "--bins radius: spheres are not clipped at annuli; use --composition centre");
  }

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const Composition& others);
  std::size_t layers() const { return sums_.size(); }
  Contents mean(std::size_t layer) const;
  /// Sum over all layers of the mean contents.
  Contents mean() const;
  /// Motion in a layer; 0 if frames were read without velocities.
  MotionSums motion(std::size_t layer) const;
  /// Numbers of a layer in a table of grseg-stress: contents, then motion.
  std::vector<double> row(std::size_t layer) const;

 private:
  struct Sums {
    Contents contents;
    MotionSums motion;
    static constexpr auto members = std::tuple(&Sums::contents, &Sums::motion);
  };
  Layers layers_;
  GrainArea rule_;
  std::optional<Kernel> kernel_;
  std::size_t species_;
  std::size_t frames_ = 0;
  std::vector<Sums> sums_;
};

/// Heights of the bed, m; NaN if they are not known.
struct BedHeights {
  // Centres of mass y_L, y_S of large and small grains, for runs of two species.
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
