// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/round_numbers.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/length.hpp"

#include <array>
#include <cmath>
#include <optional>

/// Part of the cell that a picture shows, and the direction of view.
namespace grseg {

/// Plane of a picture, named by its axes: the first one points to the right, the second one up the page.
enum class Plane { xy, zy, zx };
inline constexpr Choice<Plane> planes[] = {{"xy", Plane::xy, "from the side"},
                                           {"zy", Plane::zy, "down the slope"},
                                           {"zx", Plane::zx, "from above"}};

/// A rectangle in the plane of the picture, m.
struct Region {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  Vec2 size() const { return high - low; }
};

/// Parallel projection of the cell along the axis that is perpendicular to the picture, the depth axis.
class View {
 public:
  View(Plane plane, const Box& box);

  /// Components of a vector along the two axes of the plane, in the unit of the vector.
  template <int D>
  Vec2 flat(const Vector<D>& vector) const
  {
    return {vector[right_], vector[up_]};
  }
  /// Coordinate towards the viewer, m; larger means nearer. Nothing if `position` lies outside of the slab.
  template <int D>
  std::optional<double> nearness(const Vector<D>& position) const;

  /// Depth axis: its number (0 to 2) and its name (x, y or z).
  Eigen::Index depth_axis() const { return depth_; }
  char depth() const { return "xyz"[depth_]; }
  /// Period along an axis of the plane (`axis` 0 or 1), m; 0 if the axis is not periodic.
  double period(int axis) const { return period_[static_cast<std::size_t>(axis)]; }
  double depth_period() const { return depth_period_; }

  /// Part of the plane that the picture shows. Beyond a period the cell is repeated.
  Region region;
  /// Range of the depth axis in which grains are shown, m; nothing: grains at any depth are shown.
  std::optional<Range> slab;

  /// Calls place(shift) for each shift by whole periods (m) that moves a part of the rectangle from `low`
  /// to `high` (m, in the plane) into the region.
  template <class Place>
  void for_images(const Vec2& low, const Vec2& high, const Place& place) const;

 private:
  Eigen::Index right_, up_, depth_;
  double towards_;  // 1 if the depth axis points to the viewer, else -1
  std::array<double, 2> period_;
  double depth_period_;
};

template <class Place>
void View::for_images(const Vec2& low, const Vec2& high, const Place& place) const
{
  // First and last multiple of the period; both are 0 if the axis is not periodic.
  std::array<double, 2> first{}, last{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    if (period_[axis] > 0) {
      first[axis] = std::ceil((region.low[k] - high[k]) / period_[axis]);
      last[axis] = std::floor((region.high[k] - low[k]) / period_[axis]);
    } else if (high[k] < region.low[k] || low[k] > region.high[k]) {
      return;
    }
  }
  for (long a = std::lround(first[0]); a <= std::lround(last[0]); ++a)
    for (long b = std::lround(first[1]); b <= std::lround(last[1]); ++b)
      place(Vec2(static_cast<double>(a) * period_[0], static_cast<double>(b) * period_[1]));
}

/// Reads a region, "x0:x1,y0:y1"; an end that is left out is taken from `whole`. Throws UsageError if the
/// text is no region, or if the region spans more than 20 periods of the view.
Region parse_region(const std::string& text, const View& view, const Region& whole,
                    LengthUnits units);

/// Reads a slab, "z0:z1". Throws UsageError if the text is no slab.
Range parse_slab(const std::string& text, LengthUnits units);

}  // namespace grseg
