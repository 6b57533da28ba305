// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/dimension.hpp"

#include "formats/import/facts/axes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

/// How far apart the centres of the grains lie along each of the archive's axes.
Vec3 extent_of(const ArchiveGrains& grains)
{
  Vec3 low = grains.position.front(), high = low;
  for (const auto& x : grains.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return high - low;
}

double thickness_of_a_plane(const ArchiveGrains& grains)
{
  return *std::max_element(grains.radius.begin(), grains.radius.end()) / 10;
}

}  // namespace

std::string plane_of(const ArchiveGrains& grains)
{
  if (grains.size() == 0) return "xy";
  const Vec3 extent = extent_of(grains);
  const double thickness = thickness_of_a_plane(grains);
  if (extent.z() <= thickness) return "xy";
  if (extent.y() <= thickness) return "xz";
  return extent.x() <= thickness ? "yz" : "";
}

int dimension_of(const ArchiveMoment& first, const std::string& axes, bool discs,
                 std::optional<int> asked)
{
  if (asked && *asked != 2 && *asked != 3)
    throw UsageError(fmt::format("--dimension {} is neither 2 nor 3", *asked));
  if (discs && asked == 3)
    throw UsageError(
        "--dimension 3, but the grains are discs, which move in a plane; leave the option out, or "
        "pass --grains-are spheres if that is what they are");
  const auto& grains = first.grains;
  if (asked == 3 || grains.size() == 0) return asked.value_or(2);
  const auto across = *Axes(axes).axis_of(2);
  const Vec3 extent = extent_of(grains);
  if (!(extent[across] > thickness_of_a_plane(grains))) return 2;
  const auto apart =
      fmt::format("{}: grains lie up to {:g} apart across the plane of the flow, --axes {}",
                  first.place, extent[across], axes);
  if (const auto plane = plane_of(grains); !plane.empty())
    throw UsageError(fmt::format("{}, but in a plane of the axes: pass --axes {}{}", apart, plane,
                                 discs ? "" : " for a flow in it, or --dimension 3"));
  if (discs)
    throw UsageError(fmt::format(
        "{}, but discs move in a plane: name it with --axes (xy, xz), or pass --grains-are spheres "
        "if that is what they are",
        apart));
  if (asked == 2)
    throw UsageError(fmt::format(
        "{}, so this is not a flow in two dimensions; leave --dimension 2 out, or name the plane",
        apart));
  return 3;
}

}  // namespace grseg
