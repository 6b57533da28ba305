// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace grseg {

/// A body of a Siconos run as /data/input describes it (mechanics_hdf5.py, add_object): a grain,
/// or something that never moves.
struct SiconosBody {
  /// The body lies where normal . x <= distance.
  struct Plane {
    Vec3 normal;
    double distance = 0;
  };
  std::int64_t id = 0;        // negative: static
  double mass = 0;            // kg; 0: static
  double radius = 0;          // m; 0: a box or a convex hull
  std::vector<Plane> planes;  // of its sides, in its own axes
  double margin = 0;          // by which the program may make a hull thicker
  Vec3 position{0, 0, 0};     // of the shape's centre, at the beginning
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 velocity{0, 0, 0};  // at the beginning
};

struct SiconosBodies {
  std::vector<SiconosBody> all;  // in order of id: the static ones first
  bool discs = false;            // false: spheres
};

/// Grains are a Disk or a Sphere each, static bodies also a Box2d, a Box or a convex hull of points. FormatError naming the
/// body where it is anything else, lacks an attribute or carries several shapes.
SiconosBodies read_siconos_bodies(hid_t file, const std::string& path);

/// How far `point` is from the surface of `body`, which may be a margin thicker.
double distance_to_surface(const SiconosBody& body, const Vec3& point);

/// Entry in `bodies.all` of the static body whose surface is nearest to `point`, if it is nearer
/// than `distance`.
std::optional<std::size_t> static_body_at(const SiconosBodies& bodies, const Vec3& point,
                                          double distance);

}  // namespace grseg
