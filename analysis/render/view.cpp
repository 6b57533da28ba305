// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/view.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr double most_periods = 20;

struct Axes {
  Eigen::Index right, up, depth;
  double towards;
};

Axes axes_of(Plane plane)
{
  switch (plane) {
    case Plane::zy:
      return {2, 1, 0, -1};
    case Plane::zx:
      return {2, 0, 1, 1};
    default:
      return {0, 1, 2, 1};
  }
}

double period_along(Eigen::Index axis, const Box& box)
{
  if (axis == 0 && box.periodic_x) return box.length_x;
  if (axis == 2 && box.periodic_z) return box.length_z;
  return 0;
}

/// "a:b"; either may be left out.
Range parse_span(const std::string& text, const Range& otherwise, const std::string& option,
                 LengthUnits units)
{
  const auto colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(
        fmt::format("{} '{}': write where it begins and ends, as in 0:20dS", option, text));
  const auto end = [&](const std::string& word, double other) {
    return word.empty() ? other : parse_length(word, option, units);
  };
  const Range range{end(text.substr(0, colon), otherwise.low),
                    end(text.substr(colon + 1), otherwise.high)};
  if (!(range.low < range.high))
    throw UsageError(
        fmt::format("{} '{}': it begins at {:.6g} m and ends at {:.6g} m; the first "
                    "must be the smaller one",
                    option, text, range.low, range.high));
  return range;
}

}  // namespace

View::View(Plane plane, const Box& box)
{
  const auto [right, up, depth, towards] = axes_of(plane);
  right_ = right;
  up_ = up;
  depth_ = depth;
  towards_ = towards;
  period_ = {period_along(right, box), period_along(up, box)};
  depth_period_ = box.dimension == 3 ? period_along(depth, box) : 0;
}

template <int D>
std::optional<double> View::nearness(const Vector<D>& position) const
{
  if constexpr (D == 2) return 0;
  double place = position[depth_ % D];
  if (slab) {
    if (depth_period_ > 0) {
      place -= depth_period_ * std::floor((place - slab->low) / depth_period_);
    }
    if (!(place >= slab->low && place <= slab->high)) return std::nullopt;
  }
  return towards_ * place;
}

template std::optional<double> View::nearness<2>(const Vec2&) const;
template std::optional<double> View::nearness<3>(const Vec3&) const;

Region parse_region(const std::string& text, const View& view, const Region& whole,
                    LengthUnits units)
{
  const auto comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError(fmt::format(
        "--region '{}': give both axes of the picture, as in 0:40dS,0:20dS or :,0:20dS", text));
  const std::string words[] = {text.substr(0, comma), text.substr(comma + 1)};
  Region region = whole;
  for (int axis = 0; axis < 2; ++axis) {
    const auto range =
        parse_span(words[axis], {whole.low[axis], whole.high[axis]}, "--region", units);
    if (view.period(axis) > 0 && range.length() > most_periods * view.period(axis))
      throw UsageError(fmt::format("--region '{}': that is more than {:g} periods of {:.6g} m",
                                   text, most_periods, view.period(axis)));
    region.low[axis] = range.low;
    region.high[axis] = range.high;
  }
  return region;
}

Range parse_slab(const std::string& text, LengthUnits units)
{
  const auto colon = text.find(':');
  if (colon == 0 || (colon != std::string::npos && colon + 1 == text.size()))
    throw UsageError(fmt::format("--slice '{}': give both ends, as in 0:2dL", text));
  return parse_span(text, {}, "--slice", units);
}

}  // namespace grseg
