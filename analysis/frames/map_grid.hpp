// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace grseg {

/// The two coordinates of a map. Quantities are summed over the third one.
enum class MapPlane {
  xy,  ///< in three dimensions, summed over the width Lz
  xz,  ///< summed over the height of the bed
  rz,  ///< summed over the angle about an axis along z; r is the distance from the axis
};
inline constexpr Choice<MapPlane> map_planes[] = {
    {"xy", MapPlane::xy}, {"xz", MapPlane::xz}, {"rz", MapPlane::rz}};

/// Cells of equal side along one coordinate. The first cell begins at first * side. A cell includes
/// its lower edge. A coordinate beyond the last cell is wrapped if the axis is periodic; otherwise
/// it belongs to the outermost cell.
struct MapAxis {
  char name = 'x';        // coordinate: x, y, z or r
  double side = 0;        // side of a cell, m
  double first = 0;       // begin of the first cell in units of `side`, a whole number
  std::size_t cells = 1;  // number of cells
  bool periodic = false;

  // Lower edge of a cell, m: a product, not a sum, so that it is exact.
  double edge(std::size_t cell) const { return (first + static_cast<double>(cell)) * side; }
  // Number of the cell that contains a coordinate (m).
  std::size_t at(double place) const;
  // Distance of a coordinate (m) from the lower edge of its cell, m.
  double in_cell(double place) const;
  // This axis with each cell divided into equal cells no longer than `longest` (m).
  MapAxis divided(double longest) const;
};

/// Equal cells that fill the period (m), none longer than `side` (m).
MapAxis periodic_axis(char name, double side, double period);
/// Cells of this side (m), with edges at its multiples, that cover the range from `low` to `high`.
MapAxis open_axis(char name, double side, double low, double high);

/// Range of the mobile grains and mean height of the bed over the frames that were added.
template <int D>
class GrainExtent {
 public:
  /// `axis`: x and y of the axis from which distances are measured, m.
  explicit GrainExtent(const std::optional<Vec2>& axis) : axis_(axis) {}

  void add(const Grains& grains, const Frame<D>& frame);
  void merge(const GrainExtent& others);

  bool empty() const { return !(low_[0] <= high_[0]); }
  const Vector<D>& low() const { return low_; }
  const Vector<D>& high() const { return high_; }
  double distance() const { return distance_; }  // largest distance from the axis, m
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
  double depth;                   // length that is summed over, m; 1 in rz and in two dimensions
  std::optional<Vec2> axis = {};  // x and y of the axis of a map rz, m

  std::size_t cells() const { return axes[0].cells * axes[1].cells; }
  std::size_t column(std::size_t cell) const { return cell % axes[0].cells; }
  std::size_t row(std::size_t cell) const { return cell / axes[0].cells; }
  double volume(std::size_t cell) const;  // volume of a cell, m^2 or m^3

  /// Number of the cell that contains a position.
  template <int D>
  std::size_t at(const Vector<D>& position) const;

  /// Distances of a position from the lower edges of its cell along both axes, m.
  template <int D>
  Vec2 in_cell(const Vector<D>& position) const;
  /// This grid with each cell divided into equal cells with sides no longer than `longest` (m).
  MapGrid divided(double longest) const;

  /// Thickness of a cell, m: along y in the plane xy, along r in rz; in xz the height of the bed.
  double thickness() const;
  /// Lower edge of a cell in this direction, m.
  double bottom(std::size_t cell) const;

 private:
  /// Coordinates of a position along both axes, m.
  template <int D>
  Vec2 places(const Vector<D>& position) const;
};

/// The cells of a map that cover all grains of a run, of sides no longer than `side` (m). Throws
/// RunError if there is no grain, or above a million cells, which means that a grain is lost.
template <int D>
MapGrid map_grid(MapPlane plane, double side, const Box& box, const GrainExtent<D>& grains,
                 const std::optional<Vec2>& axis);

}  // namespace grseg
