// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace grseg {

/// Which two coordinates a map lies in. What is not among them is summed over.
enum class MapPlane {
  xy,  ///< in three dimensions over the width Lz
  xz,  ///< over the height of the bed
  rz,  ///< all round an axis along z, r being the distance from it
};
inline constexpr Choice<MapPlane> map_planes[] = {
    {"xy", MapPlane::xy}, {"xz", MapPlane::xz}, {"rz", MapPlane::rz}};

/// Cells of equal side along one coordinate. The first begins at first * side; a cell holds its
/// lower edge. Along a period what lies beyond an end comes in at the other; elsewhere it counts to
/// the outermost cell.
struct MapAxis {
  char name = 'x';
  double side = 0;   // m
  double first = 0;  // a whole number
  std::size_t cells = 1;
  bool periodic = false;

  // Multiplying, not adding up: edges stay exact.
  double edge(std::size_t cell) const { return (first + static_cast<double>(cell)) * side; }
  std::size_t at(double place) const;
};

/// As many cells as fill the period, none longer than `side`.
MapAxis periodic_axis(char name, double side, double period);
/// Cells of this side, with edges at its multiples, from the one that holds `low` to the one that
/// holds `high`.
MapAxis open_axis(char name, double side, double low, double high);

/// How far the mobile grains reach, and how high the bed is, over the frames that were added.
template <int D>
class GrainExtent {
 public:
  /// `axis`: x and y of the one that distances are measured from.
  explicit GrainExtent(const std::optional<Vec2>& axis) : axis_(axis) {}

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const GrainExtent& others);

  bool empty() const { return !(low_[0] <= high_[0]); }
  const Vector<D>& low() const { return low_; }
  const Vector<D>& high() const { return high_; }
  double distance() const { return distance_; }  // from the axis
  /// Twice the mean height of the grains' area or volume above y = 0.
  double bed_height() const { return heights_ / static_cast<double>(frames_); }

 private:
  std::optional<Vec2> axis_;
  Vector<D> low_ = Vector<D>::Constant(1e300), high_ = Vector<D>::Constant(-1e300);
  double distance_ = 0, heights_ = 0;
  std::size_t frames_ = 0;
};

/// The cells of a map, numbered along the first of its two axes, then along the second.
struct MapGrid {
  MapPlane plane;
  std::array<MapAxis, 2> axes;
  double depth;                   // m, the length that is summed over; in the plane rz none
  std::optional<Vec2> axis = {};  // x and y of the axis of rz

  std::size_t cells() const { return axes[0].cells * axes[1].cells; }
  std::size_t column(std::size_t cell) const { return cell % axes[0].cells; }
  std::size_t row(std::size_t cell) const { return cell / axes[0].cells; }
  double volume(std::size_t cell) const;  // m^2 or m^3

  /// The cell that holds a position.
  template <int D>
  std::size_t at(const Vector<D>& position) const;

  /// Thickness of a cell across its layer: along y, in rz along r, in xz all of the height.
  double thickness() const;
  /// Where it begins there.
  double bottom(std::size_t cell) const;
};

/// The cells of a map that hold all grains of a run, of sides no longer than `side` (m). RunError
/// where there is no grain, or more cells than a map can have, which means that a grain is lost.
template <int D>
MapGrid map_grid(MapPlane plane, double side, const Box& box, const GrainExtent<D>& grains,
                 const std::optional<Vec2>& axis);

}  // namespace grseg
