// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/map_grid.hpp"
#include "analysis/frames/motion.hpp"
#include "formats/core/frame.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace grseg {

/// Sums over the grains of a cell from which a plane through their motions follows. Places are
/// measured along the two axes of the map, m from the cell's lower edges.
template <int D>
struct PlaneSums {
  double mass = 0;                         // sum of m, kg
  Vec2 moment = Vec2::Zero();              // of m x, kg m
  Tensor2 second = Tensor2::Zero();        // of m x (x) x, kg m^2
  Motion<D> momentum = Motion<D>::Zero();  // of m v
  Eigen::Matrix<double, Motion<D>::RowsAtCompileTime, 2> product =
      decltype(product)::Zero();  // of m v (x) x

  void add(const Vec2& place, double grain_mass, const Motion<D>& motion);
  static constexpr auto members =
      std::tuple(&PlaneSums::mass, &PlaneSums::moment, &PlaneSums::second, &PlaneSums::momentum,
                 &PlaneSums::product);
};

/// Least-squares plane v(x) = mean + gradient (x - centre), weighted by mass. Where the grains lie
/// at one place or on one line, up to a thousandth of the cell's side, there is no gradient across.
template <int D>
struct MotionPlane {
  double mass;
  Vec2 centre;
  Motion<D> mean;
  Tensor2 inverse;  // of the sum of m (x - centre) (x) (x - centre)
  Eigen::Matrix<double, Motion<D>::RowsAtCompileTime, 2> gradient;  // 1/s

  MotionPlane(const PlaneSums<D>& sums, double side);
  Motion<D> at(const Vec2& place) const { return mean + gradient * (place - centre); }
  /// Share of a grain in the plane at its own place: m (1/M + d . inverse d), d = x - centre.
  double own_part(const Vec2& place, double grain_mass) const;
};

/// Mass-weighted mean motion over the plane of a map, over the frames that were added: in patches,
/// which divide each cell, a plane through the motions of the grains, so that the shear inside a
/// patch is part of the mean.
template <int D>
class MapFlow {
 public:
  /// The patches have sides no longer than `patch` (m), with a whole number of patches per cell.
  MapFlow(const MapGrid& cells, double patch);

  void add(const Vector<D>& position, double mass, const Motion<D>& motion);
  void merge(const MapFlow& others);
  /// Computes the planes; no grain can be added afterwards.
  void finish();

  /// Mean motion at a place where a grain was added.
  Motion<D> at(const Vector<D>& position) const;
  /// Share of a grain that was added in the mean at its place, by which the mean underestimates its
  /// fluctuation.
  double own_part(const Vector<D>& position, double mass) const;
  /// Product of fluctuations dv (x) dv' of a grain that was added, with dv about the plane and dv'
  /// about the plane through all other grains of its patch. dv' = dv/(1 - own_part), and the mean
  /// of the product is the variance of the grain's motion if m times the variance is the same for
  /// all grains; else its relative error is of the order of own_part. Nothing if the plane needs
  /// the grain.
  std::optional<MotionProduct<D>> about_others(const Vector<D>& position, double mass,
                                               const Motion<D>& motion) const;
  /// Rate of shear sqrt(2 D:D) of the plane through the motions in a cell, 1/s, with D the symmetric
  /// part of the velocity gradient; NaN without grains.
  double shear_rate(std::size_t cell) const;

 private:
  struct Planes {
    MapGrid grid;
    std::unordered_map<std::size_t, PlaneSums<D>> sums = {};
    std::unordered_map<std::size_t, MotionPlane<D>> planes = {};

    void add(const Vector<D>& position, double mass, const Motion<D>& motion);
    void finish();
  };
  const MotionPlane<D>& patch_at(const Vector<D>& position) const;

  Planes patches_, cells_;
};

}  // namespace grseg
