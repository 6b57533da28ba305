// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/map_grid.hpp"

#include "analysis/frames/composition.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

constexpr double most_cells = 1e6;

/// Number of the cell that contains `place` (m), with cells of this side (m) that begin at 0.
double cell_of(double place, double side)
{
  double cell = std::floor(place / side);
  // Rounding may move the quotient across an edge.
  if (place < cell * side) --cell;
  if (place >= (cell + 1) * side) ++cell;
  return cell;
}

std::size_t whole(double number)
{
  return static_cast<std::size_t>(std::clamp(number, 1.0, 2 * most_cells));
}

}  // namespace

std::size_t MapAxis::at(double place) const
{
  const double cell = cell_of(place, side) - first, count = static_cast<double>(cells);
  const double within =
      periodic ? cell - count * std::floor(cell / count) : std::clamp(cell, 0.0, count - 1);
  return static_cast<std::size_t>(within);
}

double MapAxis::in_cell(double place) const
{
  return periodic ? place - cell_of(place, side) * side : place - edge(at(place));
}

MapAxis MapAxis::divided(double longest) const
{
  const double parts = std::max(std::ceil(side / longest - 1e-9), 1.0);
  return {name, side / parts, first * parts, cells * whole(parts), periodic};
}

MapAxis periodic_axis(char name, double side, double period)
{
  const std::size_t cells = whole(std::ceil(period / side - 1e-9));
  return {name, period / static_cast<double>(cells), 0, cells, true};
}

MapAxis open_axis(char name, double side, double low, double high)
{
  const double first = cell_of(low, side), last = cell_of(high, side);
  // A grain that ends at the edge of a cell does not reach into the next cell.
  const double cells = last - first + (high > last * side ? 1 : 0);
  return {name, side, first, whole(cells), false};
}

template <int D>
void GrainExtent<D>::add(const Grains& grains, const Frame<D>& frame)
{
  if (const double height = bed_heights(grains, frame).bed; !std::isnan(height)) {
    ++frames_;
    heights_ += height;
  }
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto& position = frame.position[g];
    const double radius = grains.radius[g];
    low_ = low_.cwiseMin((position.array() - radius).matrix());
    high_ = high_.cwiseMax((position.array() + radius).matrix());
    if (axis_)
      distance_ = std::max(distance_, Vec2(position.template head<2>() - *axis_).norm() + radius);
  }
}

template <int D>
void GrainExtent<D>::merge(const GrainExtent& others)
{
  frames_ += others.frames_;
  heights_ += others.heights_;
  low_ = low_.cwiseMin(others.low_);
  high_ = high_.cwiseMax(others.high_);
  distance_ = std::max(distance_, others.distance_);
}

template class GrainExtent<2>;
template class GrainExtent<3>;

double MapGrid::volume(std::size_t cell) const
{
  const auto& [first, second] = axes;
  if (plane != MapPlane::rz) return first.side * second.side * depth;
  const double rings = 2 * (first.first + static_cast<double>(column(cell))) + 1;
  return std::numbers::pi * first.side * first.side * rings * second.side;
}

template <int D>
Vec2 MapGrid::places(const Vector<D>& position) const
{
  return {plane == MapPlane::rz ? Vec2(position.template head<2>() - *axis).norm() : position.x(),
          plane == MapPlane::xy ? position.y() : position[D - 1]};
}

template <int D>
std::size_t MapGrid::at(const Vector<D>& position) const
{
  const Vec2 place = places<D>(position);
  return axes[1].at(place.y()) * axes[0].cells + axes[0].at(place.x());
}

template <int D>
Vec2 MapGrid::in_cell(const Vector<D>& position) const
{
  const Vec2 place = places<D>(position);
  return {axes[0].in_cell(place.x()), axes[1].in_cell(place.y())};
}

MapGrid MapGrid::divided(double longest) const
{
  auto fine = *this;
  for (auto& each : fine.axes) each = each.divided(longest);
  return fine;
}

template std::size_t MapGrid::at(const Vec2&) const;
template std::size_t MapGrid::at(const Vec3&) const;
template Vec2 MapGrid::in_cell(const Vec2&) const;
template Vec2 MapGrid::in_cell(const Vec3&) const;

double MapGrid::thickness() const
{
  if (plane == MapPlane::xz) return depth;
  return axes[plane == MapPlane::xy ? 1 : 0].side;
}

double MapGrid::bottom(std::size_t cell) const
{
  if (plane == MapPlane::xz) return 0;
  return plane == MapPlane::xy ? axes[1].edge(row(cell)) : axes[0].edge(column(cell));
}

template <int D>
MapGrid map_grid(MapPlane plane, double side, const Box& box, const GrainExtent<D>& grains,
                 const std::optional<Vec2>& axis)
{
  if (grains.empty()) throw RunError("the run has no mobile grains, so there is nothing to map");
  const auto along = [&](char name, int k, bool periodic, double period) {
    return periodic ? periodic_axis(name, side, period)
                    : open_axis(name, side, grains.low()[k], grains.high()[k]);
  };
  const MapAxis first = plane == MapPlane::rz ? open_axis('r', side, 0, grains.distance())
                                              : along('x', 0, box.periodic_x, box.length_x);
  const MapAxis second = plane == MapPlane::xy ? along('y', 1, false, 0)
                                               : along('z', D - 1, box.periodic_z, box.length_z);
  const double cells = static_cast<double>(first.cells) * static_cast<double>(second.cells);
  if (!(cells <= most_cells))
    throw RunError(
        fmt::format("the grains need {} by {} cells of {:.3g} m, more than {:g} in all; either a "
                    "grain is lost, or the cells are too small: choose a larger --layer",
                    first.cells, second.cells, side, most_cells));
  double depth = D == 3 && plane == MapPlane::xy ? box.length_z : 1;
  if (plane == MapPlane::xz) depth = grains.bed_height();
  if (!(depth > 0))
    throw RunError(
        "--bins xz sums over the height of the bed, but the grains' mean height is below y = 0; "
        "use xy or rz");
  return {plane, {first, second}, depth, axis};
}

template MapGrid map_grid(MapPlane, double, const Box&, const GrainExtent<2>&,
                          const std::optional<Vec2>&);
template MapGrid map_grid(MapPlane, double, const Box&, const GrainExtent<3>&,
                          const std::optional<Vec2>&);

}  // namespace grseg
