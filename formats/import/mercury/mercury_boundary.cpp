// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/mercury/mercury_boundary.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

struct Refused {
  std::string_view part;  // of the kind's name
  const char* why;
};

constexpr Refused refused[] = {
    {"TimeDependentPeriodic", "moves and shifts grains with time"},
    {"LeesEdwards", "shears the cell: grains that leave it above come back below at another place"},
    {"AngledPeriodic", "turns grains that leave the cell"},
    {"CircularPeriodic", "turns grains that leave the cell"},
    {"StressStrainControl", "changes the size of the cell"},
    {"Maser", "is periodic in a part of the cell only, and puts copies of grains into the rest"},
};

/// The two places of a periodic boundary along its normal, in whatever version.
std::array<double, 2> places_of(const MercuryLines& lines)
{
  for (const auto& [left, right] : {std::pair{"distanceLeft", "distanceRight"},
                                    {"position_left", "position_right"},
                                    {"pos_left", "pos_right"}})
    if (lines.has(left)) return {lines.value(left), lines.value(right)};
  lines.fail("'distanceLeft' of the periodic boundary is missing");
}

}  // namespace

void read_mercury_boundary(const MercuryLines& lines, MercuryRestart& restart)
{
  const auto kind = lines.kind();
  for (const auto& [part, why] : refused)
    if (kind.find(part) != std::string_view::npos)
      lines.fail(fmt::format("the {} {}; such a cell is not imported", kind, why));
  restart.removes_grains |= kind.find("Deletion") != std::string_view::npos;
  if (kind != "PeriodicBoundary" && kind != "normal") return;
  const Vec3 normal = lines.has("normal") ? lines.vector("normal") : Vec3(NAN, NAN, NAN);
  const auto [left, right] = places_of(lines);
  const Vec3 shift = lines.has("shift") ? lines.vector("shift") : Vec3((right - left) * normal);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(normal[axis]) > 1 - 1e-12)) continue;
    if (!((shift - (right - left) * normal).norm() < 1e-6 * std::abs(right - left)))
      lines.fail("the periodic boundary shifts grains obliquely, which is not imported");
    restart.periodic[static_cast<std::size_t>(axis)] = true;
    restart.low[axis] = std::min(normal[axis] * left, normal[axis] * right);
    restart.high[axis] = std::max(normal[axis] * left, normal[axis] * right);
    return;
  }
  lines.fail("the cell is periodic along none of the axes, which is not imported");
}

}  // namespace grseg
