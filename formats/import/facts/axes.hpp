// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/archive.hpp"

#include <array>
#include <optional>
#include <string>

namespace grseg {

/// The axes of a flow, as directions in the axes of an archive: x down the slope, y normal to the
/// base and upward, z = x cross y across the flow. They are right-handed: rotated, never mirrored,
/// so that the sense of rotations and of oblique contacts does not change.
class Axes {
 public:
  /// `letters` are two of x, y, z, e.g. "xz": the archive's axes along the base and away from it.
  /// Throws UsageError for other text.
  explicit Axes(const std::string& letters = "xy");

  /// Rotates the axes about z, so that the components of gravity normal to z have the direction
  /// (sin slope, -cos slope). `slope` in degrees.
  void turn_to_slope(const Vec3& gravity, double slope);
  /// Rotates the axes by 180 degrees about y: reverses x and z.
  void look_from_behind();

  /// Components, in these axes, of a vector of the archive.
  Vec3 components(const Vec3& vector) const;
  /// Angular velocity about x cross y: positive if counter-clockwise with x to the right and y up.
  /// For --axes xz it is -omega_y, because x, z, -y are right-handed.
  double spin_in_plane(const Vec3& angular_velocity) const;

  /// The archive's axis that is parallel to x, y or z (0, 1, 2), if any; is_forward() is true if
  /// both point the same way.
  std::optional<int> axis_of(int direction) const;
  bool is_forward(int direction) const;

 private:
  std::array<Vec3, 3> direction_;
};

/// Throws UsageError if the cell of `frame` is periodic along `normal`, an axis of the archive.
void require_open_normal(const ArchiveFrame& frame, int normal);

/// Gravity, a magnitude ("9.8") or a vector ("3.8,-9.0,0"). Other text: UsageError.
struct GravityText {
  std::optional<double> magnitude;
  std::optional<Vec3> vector;
};
GravityText parse_gravity(const std::string& text);

/// The axes of the flow and gravity in these axes. orientation_of() reverses x and z if x points
/// uphill. If gravity is a vector and a slope is given, it rotates the axes until gravity has this
/// slope. If gravity is a magnitude, a slope is required and the axes are not rotated. Throws
/// UsageError if this slope is missing, or if gravity is not in the plane of a flow in two
/// dimensions; in three dimensions it may have a component across the flow.
struct Orientation {
  Axes axes;
  Vec3 gravity = Vec3::Zero();
};
Orientation orientation_of(const std::string& letters, const GravityText& gravity,
                           std::optional<double> slope, int dimension);

/// Throws UsageError unless gravity has a component along the normal of the base. `gravity` in the
/// archive's axes, for the message; `letters` is the value of --axes.
void require_towards_the_base(const Vec3& gravity, const Orientation& orientation,
                              const std::string& letters);

/// Dimension of the flow, from the grains of the first frame: 2 if their centres lie in the plane
/// of `axes` (two letters), to a tenth of the largest radius; 3 if they do not and are spheres.
/// `asked` is the value of --dimension; 3 treats spheres in a plane as a flow in space. Throws
/// UsageError if `asked` contradicts the grains, if discs do not lie in the plane, or if spheres
/// lie in another plane of the archive's axes, which may be the intended one.
int dimension_of(const ArchiveFrame& first, const std::string& axes, bool discs,
                 std::optional<int> asked);

/// The plane of two of the archive's axes in which all grains lie, to a tenth of the largest
/// radius, as a value of --axes; "" if there is none.
std::string plane_of(const ArchiveGrains& grains);

}  // namespace grseg
