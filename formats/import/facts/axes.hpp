// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/archive.hpp"

#include <array>
#include <optional>
#include <string>

namespace grseg {

/// The axes of a flow within the axes of an archive: down the slope (x), normal to the base, upward
/// (y), and across (z = x cross y). They are always right-handed and only ever turned, never
/// mirrored, so that spins and oblique contacts keep their sense.
class Axes {
 public:
  /// Two of the letters x, y, z, e.g. "xz": along the base and away from it. UsageError otherwise.
  explicit Axes(const std::string& letters = "xy");

  /// Turned about z such that gravity, as far as it lies across z, has the direction
  /// (sin slope, -cos slope); in degrees.
  void turn_to_slope(const Vec3& gravity, double slope);
  /// Turned half about y: x and z the other way, y as it was.
  void look_from_behind();

  /// The components of a vector of the archive.
  Vec3 components(const Vec3& vector) const;
  /// Counter-clockwise as it is seen with x to the right and y up: in x-z that is -omega_y, for
  /// right-handed axes x, z, -y.
  double spin_in_plane(const Vec3& angular_velocity) const;

  /// The archive's axis that x, y or z (0, 1, 2) lies along, if any; and whether in its direction.
  std::optional<int> axis_of(int direction) const;
  bool is_forward(int direction) const;

 private:
  std::array<Vec3, 3> direction_;
};

/// UsageError where the cell of `moment` is periodic along `normal`, an axis of the archive.
void require_open_normal(const ArchiveMoment& moment, int normal);

/// "9.8" or "3.8,-9.0,0". UsageError otherwise.
struct GravityText {
  std::optional<double> magnitude;
  std::optional<Vec3> vector;
};
GravityText parse_gravity(const std::string& text);

/// Axes adjusted to gravity, and gravity in them. If x points uphill, the flow is looked at from
/// behind; with a slope the axes are turned until gravity has this slope; a magnitude needs a slope
/// and turns nothing. UsageError where the slope is missing, or where gravity is not in the plane
/// of a flow in two dimensions; in three it may have a component across.
struct Orientation {
  Axes axes;
  Vec3 gravity = Vec3::Zero();
};
Orientation orientation_of(const std::string& letters, const GravityText& gravity,
                           std::optional<double> slope, int dimension);

/// UsageError unless gravity, as given in the archive's axes, has a part along the normal.
/// `letters` are the value of --axes.
void require_towards_the_base(const Vec3& gravity, const Orientation& orientation,
                              const std::string& letters);

/// Dimension of the flow, by the grains of the first moment: 2 where their centres lie in the plane
/// of `axes` (two letters), to a tenth of the largest radius, 3 where they do not and are spheres.
/// `asked` takes spheres that lie in a plane for a flow in space. UsageError where it contradicts
/// the grains, where discs lie apart, or where spheres lie in another plane of the archive's axes,
/// which may be the one that was meant.
int dimension_of(const ArchiveMoment& first, const std::string& axes, bool discs,
                 std::optional<int> asked);

/// The plane of two axes in which grains lie, to a tenth of the largest radius, as --axes would name
/// it; "" where they lie in none.
std::string plane_of(const ArchiveGrains& grains);

}  // namespace grseg
