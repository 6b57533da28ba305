// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/siconos/siconos_bodies.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

constexpr hsize_t most_corners = 64;

using Plane = SiconosBody::Plane;

std::vector<Plane> sides_of_box(const std::vector<double>& size)
{
  std::vector<Plane> planes;
  for (std::size_t k = 0; k < size.size(); ++k)
    for (const double side : {-1.0, 1.0})
      planes.push_back({side * Vec3::Unit(static_cast<Eigen::Index>(k)), size[k] / 2});
  return planes;
}

/// Adds the plane to `planes` if all corners lie on one side of it, unless it is already there.
void add_side(const std::vector<Vec3>& corners, Plane plane, double length,
              std::vector<Plane>& planes)
{
  double low = 0, high = 0;
  for (const auto& corner : corners) {
    low = std::min(low, plane.normal.dot(corner) - plane.distance);
    high = std::max(high, plane.normal.dot(corner) - plane.distance);
  }
  if (std::min(-low, high) > 1e-9 * length || std::max(-low, high) < 1e-9 * length) return;
  if (high > -low) plane = {-plane.normal, -plane.distance};
  for (const auto& known : planes)
    if ((known.normal - plane.normal).norm() < 1e-9) return;
  planes.push_back(plane);
}

/// The sides of the convex hull of corners: lines through two corners in a plane, planes through
/// three corners in space.
template <int D>
std::vector<Plane> sides_of_hull(const std::vector<Vec3>& corners)
{
  std::vector<Plane> planes;
  double length = 0;
  for (const auto& corner : corners) length = std::max(length, (corner - corners[0]).norm());
  const auto try_side = [&](const Vec3& at, const Vec3& normal) {
    if (!(normal.norm() > 1e-9 * std::pow(length, D - 1))) return;
    const Vec3 unit = normal.normalized();
    add_side(corners, {unit, unit.dot(at)}, length, planes);
  };
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 along = corners[j] - corners[i];
      if (D == 2) try_side(corners[i], along.cross(Vec3::UnitZ()));
      for (std::size_t k = 0; D == 3 && k < j; ++k)
        try_side(corners[i], along.cross(corners[k] - corners[i]));
    }
  return planes;
}

/// Reads the attributes of one object of the file.
class Attributes {
 public:
  Attributes(hid_t file, std::string object, const std::string& name)
      : file_(file), object_(std::move(object)), name_(name)
  {
  }
  std::vector<double> numbers(const std::string& key) const
  {
    auto values = hdf5::numbers_in_attribute(file_, object_, key, name_);
    for (const double value : values)
      if (!std::isfinite(value)) fail(fmt::format("'{}' is not finite", key));
    return values;
  }
  std::string text(const std::string& key) const
  {
    auto value = hdf5::text_in_attribute(file_, object_, key, name_);
    if (value.empty()) lacks(key);
    return value;
  }
  /// The first three numbers as a vector; z is 0 if there are two, as in a run in a plane.
  Vec3 vector(const std::string& key) const
  {
    const auto values = numbers(key);
    if (values.size() < 2) lacks(key);
    return {values[0], values[1], values.size() > 2 ? values[2] : 0};
  }
  /// A rotation: an angle about z in a run in a plane, otherwise a quaternion.
  Eigen::Quaterniond rotation(const std::string& key) const
  {
    const auto q = numbers(key);
    if (q.size() == 1) return Eigen::Quaterniond(Eigen::AngleAxisd(q[0], Vec3::UnitZ()));
    if (q.size() != 4) lacks(key);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  }
  [[noreturn]] void fail(const std::string& why) const
  {
    throw FormatError(fmt::format("{}: {} {}", name_, object_, why));
  }
  [[noreturn]] void lacks(const std::string& key) const
  {
    fail(fmt::format("lacks the attribute '{}': the file is damaged, or of another program", key));
  }

 private:
  hid_t file_;
  std::string object_;
  const std::string& name_;
};

/// Margin by which Bullet, Siconos' collision library, thickens a hull: the value passed to
/// add_convex_shape, or 2 % of the hull's smallest extent.
double margin_of(const std::vector<Vec3>& corners, hsize_t dimension, const Attributes& attributes)
{
  Vec3 low = corners[0], high = low;
  for (const auto& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double smallest = (high - low).head(static_cast<Eigen::Index>(dimension)).minCoeff();
  const auto inside = attributes.numbers("insideMargin"),
             outside = attributes.numbers("outsideMargin");
  return (inside.empty() ? 0.02 * smallest : inside[0]) + (outside.empty() ? 0 : outside[0]);
}

/// Reads a shape that is the convex hull of points (add_convex_shape).
void read_hull(hid_t file, const std::string& path, const std::string& at,
               const Attributes& attributes, SiconosBody& body)
{
  const hdf5::CheckedDataset dataset(file, at, H5T_FLOAT, 2, path);
  const auto rows = dataset.dims()[0], columns = dataset.dims()[1];
  if (body.mass > 0) attributes.fail("is a convex hull: grains are Disk or Sphere");
  if (columns < 2 || columns > 3 || rows < 1 || rows > most_corners)
    attributes.fail(
        fmt::format("is a hull of {} points with {} coordinates; at most {} points with 2 or 3 "
                    "coordinates can be imported",
                    rows, columns, most_corners));
  std::vector<double> values(rows * columns);
  dataset.read_all(H5T_NATIVE_DOUBLE, values.data());
  std::vector<Vec3> corners;
  for (hsize_t k = 0; k < rows; ++k)
    corners.emplace_back(values[k * columns], values[k * columns + 1],
                         columns == 3 ? values[k * columns + 2] : 0);
  for (const auto& corner : corners)
    if (!corner.allFinite()) attributes.fail("contains a point that is not finite");
  body.planes = columns == 3 ? sides_of_hull<3>(corners) : sides_of_hull<2>(corners);
  body.margin = margin_of(corners, columns, attributes);
  if (body.planes.size() <= columns) attributes.fail("has corners that span no area or volume");
}

void read_shape(hid_t file, const std::string& path, const std::string& shape, SiconosBody& body,
                bool& disc)
{
  const std::string at = "/data/ref/" + shape;
  const Attributes attributes(file, at, path);
  if (attributes.text("type") == "convex") return read_hull(file, path, at, attributes, body);
  const auto primitive = attributes.text("primitive");
  const hdf5::CheckedDataset dataset(file, at, H5T_FLOAT, 2, path);
  if (dataset.dims()[0] != 1 || dataset.dims()[1] < 1 || dataset.dims()[1] > 3)
    attributes.fail("does not contain the sizes of exactly one shape");
  std::vector<double> size(dataset.dims()[1]);
  dataset.read_all(H5T_NATIVE_DOUBLE, size.data());
  for (const double s : size)
    if (!std::isfinite(s) || s <= 0) attributes.fail("contains a size that is not positive");
  if (primitive == "Disk" || primitive == "Sphere") {
    body.radius = size[0];
    disc = primitive == "Disk";
  } else if (body.mass == 0 && ((primitive == "Box2d" && size.size() == 2) ||
                                (primitive == "Box" && size.size() == 3))) {
    body.planes = sides_of_box(size);
  } else {
    attributes.fail(
        fmt::format("is a '{}': grains are Disk or Sphere, static bodies may also be "
                    "Box2d, Box or a convex hull",
                    primitive));
  }
}

SiconosBody read_body(hid_t file, const std::string& path, const std::string& name, bool& disc)
{
  const std::string at = "/data/input/" + name;
  const Attributes attributes(file, at, path);
  const auto shapes = hdf5::names_in(file, at);
  if (shapes.size() != 1)
    attributes.fail(
        fmt::format("has {} shapes, but only bodies of one shape can be imported", shapes.size()));
  SiconosBody body;
  const auto id = attributes.numbers("id");
  if (id.size() != 1) attributes.lacks("id");
  body.id = std::llround(id[0]);
  const auto mass = attributes.numbers("mass");
  body.mass = mass.empty() ? 0 : mass[0];
  if (body.id == 0 || (body.id < 0) != (body.mass == 0) || body.mass < 0)
    attributes.fail(
        "has an id and a mass that contradict each other: a static body has a negative id and no "
        "mass");
  const Attributes contactor(file, at + '/' + shapes[0], path);
  read_shape(file, path, contactor.text("shape_name"), body, disc);
  const Vec3 beside = contactor.vector("translation");
  if (body.mass > 0 && !beside.isZero())
    attributes.fail("has a shape that is not centred on its centre of mass");
  const auto turned = attributes.rotation("orientation");
  body.position = attributes.vector("translation") + turned * beside;
  body.orientation = turned * contactor.rotation("orientation");
  const auto velocity = attributes.numbers("velocity");
  if (velocity.size() >= 2)
    body.velocity = {velocity[0], velocity[1], velocity.size() == 6 ? velocity[2] : 0};
  return body;
}

}  // namespace

SiconosBodies read_siconos_bodies(hid_t file, const std::string& path)
{
  SiconosBodies bodies;
  bool found_disc = false, found_sphere = false;
  for (const auto& name : hdf5::names_in(file, "/data/input")) {
    bool disc = false;
    bodies.all.push_back(read_body(file, path, name, disc));
    if (bodies.all.back().radius > 0) (disc ? found_disc : found_sphere) = true;
  }
  if (!found_disc && !found_sphere)
    throw FormatError(fmt::format(
        "{}: /data/input describes no grains; was it written by siconos.io.mechanics_run?", path));
  if (found_disc && found_sphere)
    throw FormatError(
        fmt::format("{}: /data/ref has both discs and spheres, which cannot be imported", path));
  bodies.discs = found_disc;
  std::sort(bodies.all.begin(), bodies.all.end(),
            [](const SiconosBody& a, const SiconosBody& b) { return a.id < b.id; });
  for (std::size_t k = 1; k < bodies.all.size(); ++k)
    if (bodies.all[k].id == bodies.all[k - 1].id)
      throw FormatError(
          fmt::format("{}: /data/input has two bodies with id {}", path, bodies.all[k].id));
  return bodies;
}

double distance_to_surface(const SiconosBody& body, const Vec3& point)
{
  if (body.radius > 0) return std::abs((point - body.position).norm() - body.radius);
  const Vec3 inside = body.orientation.inverse() * (point - body.position);
  double highest = -HUGE_VAL;
  for (const auto& [normal, distance] : body.planes)
    highest = std::max(highest, normal.dot(inside) - distance);
  return std::max(0.0, std::abs(highest) - body.margin);
}

std::optional<std::size_t> static_body_at(const SiconosBodies& bodies, const Vec3& point,
                                          double distance)
{
  std::optional<std::size_t> nearest;
  for (std::size_t b = 0; b < bodies.all.size() && bodies.all[b].mass == 0; ++b) {
    const double d = distance_to_surface(bodies.all[b], point);
    if (!(d < distance)) continue;
    distance = d;
    nearest = b;
  }
  return nearest;
}

}  // namespace grseg
