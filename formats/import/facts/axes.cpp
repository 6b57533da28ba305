// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/axes.hpp"

#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// Component of a vector along a unit vector. Exact, including the sign of a zero, if the unit
/// vector is one of the axes.
double component(const Vec3& vector, const Vec3& direction)
{
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) == 1) return direction[axis] * vector[axis];
  return vector.dot(direction);
}

/// Smallest difference of two angles that counts, rad. Gravity vectors are written with few digits.
constexpr double smallest_turn = 1e-3;

Vec3 down_a_slope(double gravity, double slope)
{
  const double angle = slope * std::numbers::pi / 180;
  return {gravity * std::sin(angle), -gravity * std::cos(angle), 0};
}

/// Extent of the grains' centres along each of the archive's axes.
Vec3 extent_of(const ArchiveGrains& grains)
{
  Eigen::AlignedBox3d box;
  for (const auto& x : grains.position) box.extend(x);
  return box.sizes();
}

double thickness_of_a_plane(const ArchiveGrains& grains)
{
  return *std::max_element(grains.radius.begin(), grains.radius.end()) / 10;
}

}  // namespace

Axes::Axes(const std::string& letters)
{
  const auto axis = [&](char letter) {
    const auto number = std::string("xyz").find(letter);
    if (letters.size() != 2 || letters[0] == letters[1] || number == std::string::npos)
      throw UsageError(
          fmt::format("--axes '{}' is not two different letters of x, y, z: the "
                      "axis along the base and the axis away from it",
                      letters));
    return Vec3(Vec3::Unit(static_cast<Eigen::Index>(number)));
  };
  const Vec3 x = axis(letters.empty() ? ' ' : letters[0]), y = axis(letters.back());
  direction_ = {x, y, x.cross(y)};
}

void Axes::turn_to_slope(const Vec3& gravity, double slope)
{
  const Vec2 now = components(gravity).head<2>(), wanted = down_a_slope(1, slope).head<2>();
  // Angle from the wanted direction of gravity to its present direction in these axes.
  const double turn = std::atan2(wanted.x() * now.y() - wanted.y() * now.x(), wanted.dot(now));
  if (std::abs(turn) < smallest_turn) return;
  auto& [x, y, z] = direction_;
  const Vec3 before = x;
  x = std::cos(turn) * before + std::sin(turn) * y;
  y = std::cos(turn) * y - std::sin(turn) * before;
}

void Axes::look_from_behind()
{
  direction_[0] = -direction_[0];
  direction_[2] = -direction_[2];
}

Vec3 Axes::components(const Vec3& vector) const
{
  return {component(vector, direction_[0]), component(vector, direction_[1]),
          component(vector, direction_[2])};
}

double Axes::spin_in_plane(const Vec3& angular_velocity) const
{
  return component(angular_velocity, direction_[0].cross(direction_[1]));
}

std::optional<int> Axes::axis_of(int direction) const
{
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction_[static_cast<std::size_t>(direction)][axis]) == 1) return axis;
  return std::nullopt;
}

bool Axes::is_forward(int direction) const
{
  return direction_[static_cast<std::size_t>(direction)].sum() > 0;
}

void require_towards_the_base(const Vec3& gravity, const Orientation& orientation,
                              const std::string& letters)
{
  const Vec3& g = orientation.gravity;
  constexpr double along = 1e-3;
  if (g.isZero(0) || std::abs(g.y()) > along * g.norm()) return;
  throw UsageError(fmt::format(
      "gravity ({:g}, {:g}, {:g}) has no component towards the base: the second letter of --axes "
      "{} must be the axis away from the base; name the axes of the flow (xy, xz)",
      gravity.x(), gravity.y(), gravity.z(), letters));
}

void require_open_normal(const ArchiveFrame& frame, int normal)
{
  if (!frame.periodic[static_cast<std::size_t>(normal)]) return;
  throw UsageError(fmt::format(
      "{}: the cell is periodic along {}, the normal of the base, but a bed ends at the base "
      "and at the surface; name the axes with --axes (along the base, away from it), or write "
      "the archive with an open boundary there",
      frame.place, "xyz"[normal]));
}

GravityText parse_gravity(const std::string& text)
{
  const auto numbers = finite_numbers(text, ',');
  if (numbers.size() == 1 && numbers[0] >= 0) return {numbers[0], std::nullopt};
  if (numbers.size() == 3) return {std::nullopt, Vec3(numbers[0], numbers[1], numbers[2])};
  throw UsageError(fmt::format(
      "--gravity '{}' is neither a magnitude nor three components, such as 9.8 or 3.8,-9.0,0",
      text));
}

Orientation orientation_of(const std::string& letters, const GravityText& gravity,
                           std::optional<double> slope, int dimension)
{
  Axes axes(letters);
  if (gravity.magnitude) {
    if (!slope)
      throw UsageError(
          "--gravity is a magnitude: add the inclination of the base with --slope, or pass the "
          "vector, as in 3.8,-9.0,0");
    return {axes, down_a_slope(*gravity.magnitude, *slope)};
  }
  const Vec3 g = *gravity.vector;
  if (dimension == 2 && std::abs(axes.components(g).z()) > 1e-6 * g.norm())
    throw UsageError(fmt::format(
        "gravity ({:g}, {:g}, {:g}) is not in the plane of --axes {}; name the plane of the flow",
        g.x(), g.y(), g.z(), letters));
  if (axes.components(g).x() < 0 && slope.value_or(1) > 0) axes.look_from_behind();
  if (slope) axes.turn_to_slope(g, *slope);
  return {axes, axes.components(g) + Vec3::Zero()};  // not -0
}

std::string plane_of(const ArchiveGrains& grains)
{
  if (grains.size() == 0) return "xy";
  const Vec3 extent = extent_of(grains);
  const double thickness = thickness_of_a_plane(grains);
  if (extent.z() <= thickness) return "xy";
  if (extent.y() <= thickness) return "xz";
  return extent.x() <= thickness ? "yz" : "";
}

int dimension_of(const ArchiveFrame& first, const std::string& axes, bool discs,
                 std::optional<int> asked)
{
  if (asked && *asked != 2 && *asked != 3)
    throw UsageError(fmt::format("--dimension {} is neither 2 nor 3", *asked));
  if (discs && asked == 3)
    throw UsageError(
        "--dimension 3, but the grains are discs, which move in a plane; leave the option out, or "
        "pass --grains-are spheres if the grains are spheres");
  const auto& grains = first.grains;
  if (asked == 3 || grains.size() == 0) return asked.value_or(2);
  const auto across = *Axes(axes).axis_of(2);
  const Vec3 extent = extent_of(grains);
  if (!(extent[across] > thickness_of_a_plane(grains))) return 2;
  const auto apart =
      fmt::format("{}: grains are up to {:g} apart across the plane of the flow, --axes {}",
                  first.place, extent[across], axes);
  if (const auto plane = plane_of(grains); !plane.empty())
    throw UsageError(fmt::format("{}, but they lie in another plane: pass --axes {}{}", apart,
                                 plane, discs ? "" : " for a flow in it, or --dimension 3"));
  if (discs)
    throw UsageError(fmt::format(
        "{}, but discs move in a plane: name it with --axes (xy, xz), or pass --grains-are spheres "
        "if the grains are spheres",
        apart));
  if (asked == 2)
    throw UsageError(
        fmt::format("{}, so this is not a flow in two dimensions; leave "
                    "--dimension 2 out, or name the plane with --axes",
                    apart));
  return 3;
}

}  // namespace grseg
