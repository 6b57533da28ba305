// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>

namespace grseg {

/// The plane of a two-dimensional flow within the three axes of an archive: which way is down the
/// slope (x) and which way is normal to the base, upward (y).
class Axes {
 public:
  /// Two of the letters x, y, z, e.g. "xz": along the base and away from it. UsageError otherwise.
  explicit Axes(const std::string& letters = "xy");

  /// Turned such that gravity, which lies in the plane, is |g| (sin slope, -cos slope); in degrees.
  void turn_to_slope(const Vec3& gravity, double slope);
  /// Looked at from behind: x the other way, y as it was.
  void look_from_behind();

  Vec2 in_plane(const Vec3& vector) const;
  /// Counter-clockwise rate as it is seen with x to the right and y up. In x-z that is -omega_y,
  /// for right-handed axes x, z, -y.
  double counter_clockwise(const Vec3& angular_velocity) const;
  double out_of_plane(const Vec3& vector) const;

  /// The archive's axis that x lies along, if any: 0, 1, 2; and whether in its direction.
  std::optional<int> axis_of_x() const;
  bool x_is_forward() const { return x_.sum() > 0; }

 private:
  Vec3 x_, y_;
};

/// "9.8" or "3.8,-9.0,0". UsageError otherwise.
struct GravityText {
  std::optional<double> magnitude;
  std::optional<Vec3> vector;
};
GravityText parse_gravity(const std::string& text);

/// Axes adjusted to gravity, and gravity in them. If x points uphill, the plane is looked at from
/// behind; with a slope the axes are turned until gravity has this slope; a magnitude needs a slope
/// and turns nothing. UsageError where the slope is missing or gravity is not in the plane.
struct Plane {
  Axes axes;
  Vec2 gravity = Vec2::Zero();
};
Plane plane_of(const std::string& letters, const GravityText& gravity, std::optional<double> slope);

}  // namespace grseg
