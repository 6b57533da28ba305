// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace grseg {

/// A grain or static body of a Siconos run, from /data/input (mechanics_hdf5.py, add_object).
struct SiconosBody {
  /// A side of the body, whose points x fulfil normal . x <= distance.
  struct Plane {
    Vec3 normal;
    double distance = 0;
  };
  std::int64_t id = 0;        // id; negative for a static body
  double mass = 0;            // mass, kg; 0 for a static body
  double radius = 0;          // radius, m; 0 for a box or a convex hull
  std::vector<Plane> planes;  // sides of a box or hull, in the body's own axes
  double margin = 0;          // thickness, m, that Siconos may add to a hull
  Vec3 position{0, 0, 0};     // initial position of the shape's centre
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 velocity{0, 0, 0};  // initial velocity
};

struct SiconosBodies {
  std::vector<SiconosBody> all;  // bodies in order of id: static bodies first
  bool discs = false;            // true: grains are discs, false: spheres
};

/// Reads the bodies. A grain is a Disk or a Sphere; a static body may also be a Box2d, a Box or a
/// convex hull of points. Throws FormatError naming the body if it has another shape or several
/// shapes, or lacks an attribute.
SiconosBodies read_siconos_bodies(hid_t file, const std::string& path);

/// Distance of `point` from the surface of `body`; 0 if it is within the margin of the surface.
double distance_to_surface(const SiconosBody& body, const Vec3& point);

/// Index in `bodies.all` of the static body whose surface is nearest to `point`; empty if none is
/// nearer than `distance`.
std::optional<std::size_t> static_body_at(const SiconosBodies& bodies, const Vec3& point,
                                          double distance);

}  // namespace grseg
