// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/siconos/siconos_bodies.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// The attributes of one object of the file.
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
    if (value.empty()) fail(fmt::format("lacks the attribute '{}'", key));
    return value;
  }
  /// Two components in a plane run, three otherwise; what lies behind them is left out.
  Vec3 vector(const std::string& key) const
  {
    const auto values = numbers(key);
    if (values.size() < 2) fail(fmt::format("lacks the attribute '{}'", key));
    return {values[0], values[1], values.size() > 2 ? values[2] : 0};
  }
  /// An angle about z in a plane run, a quaternion otherwise.
  Eigen::Quaterniond rotation(const std::string& key) const
  {
    const auto q = numbers(key);
    if (q.size() == 1) return Eigen::Quaterniond(Eigen::AngleAxisd(q[0], Vec3::UnitZ()));
    if (q.size() != 4) fail(fmt::format("lacks the attribute '{}'", key));
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  }
  [[noreturn]] void fail(const std::string& why) const
  {
    throw FormatError(fmt::format("{}: {} {}", name_, object_, why));
  }

 private:
  hid_t file_;
  std::string object_;
  const std::string& name_;
};

void read_shape(hid_t file, const std::string& path, const std::string& shape, SiconosBody& body,
                bool& disc)
{
  const std::string at = "/data/ref/" + shape;
  const Attributes attributes(file, at, path);
  const auto primitive = attributes.text("primitive");
  const hdf5::CheckedDataset dataset(file, at, H5T_FLOAT, 2, path);
  if (dataset.dims()[0] != 1 || dataset.dims()[1] < 1 || dataset.dims()[1] > 3)
    attributes.fail("does not hold the sides of one shape");
  std::vector<double> size(dataset.dims()[1]);
  dataset.read_all(H5T_NATIVE_DOUBLE, size.data());
  for (const double s : size)
    if (!std::isfinite(s) || s <= 0) attributes.fail("holds a size that is not positive");
  if (primitive == "Disk" || primitive == "Sphere") {
    body.radius = size[0];
    disc = primitive == "Disk";
  } else if (body.mass == 0 && primitive == "Box2d" && size.size() == 2) {
    body.half_sides = {size[0] / 2, size[1] / 2, HUGE_VAL};
  } else if (body.mass == 0 && primitive == "Box" && size.size() == 3) {
    body.half_sides = Vec3(size[0], size[1], size[2]) / 2;
  } else {
    attributes.fail(
        fmt::format("is a '{}': grains are Disk or Sphere, static bodies may also be "
                    "Box2d or Box",
                    primitive));
  }
}

SiconosBody read_body(hid_t file, const std::string& path, const std::string& name, bool& disc)
{
  const std::string at = "/data/input/" + name;
  const Attributes attributes(file, at, path);
  const auto shapes = hdf5::names_in(file, at);
  if (shapes.size() != 1)
    attributes.fail(fmt::format("has {} shapes, but only one is read", shapes.size()));
  SiconosBody body;
  const auto id = attributes.numbers("id");
  if (id.size() != 1) attributes.fail("lacks the attribute 'id'");
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
        fmt::format("{}: /data/ref has both discs and spheres, which is not read", path));
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
  return std::abs((inside.cwiseAbs() - body.half_sides).maxCoeff());
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
