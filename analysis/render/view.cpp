// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/view.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr double most_periods = 20;

double period_along(Eigen::Index axis, const Box& box)
{
  if (axis == 0 && box.periodic_x) return box.length_x;
  if (axis == 2 && box.periodic_z) return box.length_z;
  return 0;
}

/// Reads two lengths, "a:b"; a length that is left out is taken from `otherwise`, m.
Range parse_span(const std::string& text, const Range& otherwise, const std::string& option,
                 LengthUnits units)
{
  const auto colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(fmt::format("{} '{}': write its begin and end, as in 0:20dS", option, text));
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
    : right_(plane == Plane::xy ? 0 : 2),
      up_(plane == Plane::zx ? 0 : 1),
      depth_(3 - right_ - up_),
      towards_(plane == Plane::zy ? -1 : 1),
      period_{period_along(right_, box), period_along(up_, box)},
      depth_period_(period_along(depth_, box))
{
}

template <int D>
std::optional<double> View::nearness(const Vector<D>& position) const
{
  if constexpr (D == 2) return 0;
  double place = position[depth_ % D];
  if (slab) {
    if (depth_period_ > 0) place -= depth_period_ * std::floor((place - slab->low) / depth_period_);
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
      throw UsageError(fmt::format("--region '{}': it spans more than {:g} periods of {:.6g} m",
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
