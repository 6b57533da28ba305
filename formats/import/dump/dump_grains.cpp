// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

using Triple = std::array<int, 3>;

bool any(const Triple& columns)
{
  return std::any_of(columns.begin(), columns.end(), [](int column) { return column >= 0; });
}

template <class Integer>
Integer whole_number(double value, const char* name, const std::string& place)
{
  // Beyond 2^53 a double cannot represent every whole number.
  constexpr double most = std::min(9e15, static_cast<double>(std::numeric_limits<Integer>::max()));
  if (!(std::abs(value) <= most) || std::trunc(value) != value)
    throw FormatError(
        fmt::format("{}: {} {:g} is not a whole number, or is too large", place, name, value));
  return static_cast<Integer>(value);
}

}  // namespace

int DumpGrains::want(const DumpHeader& header, std::string_view name)
{
  const auto column = header.find(name);
  if (!column) return -1;
  wanted_.push_back(*column);
  return static_cast<int>(wanted_.size()) - 1;
}

Triple DumpGrains::want(const DumpHeader& header, const std::array<const char*, 3>& names)
{
  const Triple columns{want(header, names[0]), want(header, names[1]), want(header, names[2])};
  add_missing({columns[0] >= 0, columns[1] >= 0, columns[2] >= 0}, names, missing_);
  return columns;
}

/// Where a dump has several, the plain ones are taken.
void DumpGrains::want_positions(const DumpHeader& header)
{
  image_ = {-1, -1, -1};
  positions_ = Positions::plain;
  unwrapped_ = false;
  if (header.find("x") || header.find("xs")) {
    const bool plain = header.find("x").has_value();
    positions_ = plain ? Positions::plain : Positions::scaled;
    position_ = plain ? want(header, {"x", "y", "z"}) : want(header, {"xs", "ys", "zs"});
    want_images(header);
  } else if (header.find("xu")) {
    unwrapped_ = true;
    position_ = want(header, {"xu", "yu", "zu"});
  } else if (header.find("xsu")) {
    unwrapped_ = true;
    positions_ = Positions::scaled;
    position_ = want(header, {"xsu", "ysu", "zsu"});
  } else {
    throw FormatError(
        fmt::format("{}: the grains have no positions; one of the columns x, xu, xs, xsu is needed",
                    header.place));
  }
}

/// Needed along periods alone.
void DumpGrains::want_images(const DumpHeader& header)
{
  const std::array<const char*, 3> names{"ix", "iy", "iz"};
  std::array<bool, 3> has{};
  for (std::size_t k = 0; k < 3; ++k) {
    image_[k] = want(header, names[k]);
    has[k] = image_[k] >= 0;
  }
  if (any(image_))
    for (std::size_t k = 0; k < 3; ++k) has[k] = has[k] || !header.periodic[k];
  add_missing(has, names, missing_);
}

void DumpGrains::look_up(const DumpHeader& header)
{
  if (header.columns == names_) return;
  wanted_.clear();
  missing_.clear();
  id_ = want(header, "id");
  if (id_ < 0)
    throw FormatError(fmt::format(
        "{}: the grains have no column id, by which contacts name them{}", header.place,
        header.label == "ENTRIES" ? "; these are contacts (ITEM: ENTRIES), --contacts" : ""));
  type_ = want(header, header.find("type") ? "type" : "typelabel");
  mass_ = want(header, "mass");
  radius_ = want(header, "radius");
  diameter_ = radius_ < 0 ? want(header, "diameter") : -1;
  want_positions(header);
  velocity_ = want(header, {"vx", "vy", "vz"});
  spin_ = want(header, {"omegax", "omegay", "omegaz"});
  force_ = want(header, {"fx", "fy", "fz"});
  names_ = header.columns;
}

void DumpGrains::take(const Triple& columns, std::vector<Vec3>& out) const
{
  out.assign(any(columns) ? values_.at(0).size() : 0, Vec3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const int column = columns[static_cast<std::size_t>(axis)];
    if (column < 0) continue;
    const auto& values = values_[static_cast<std::size_t>(column)];
    for (std::size_t g = 0; g < out.size(); ++g) out[g][axis] = values[g];
  }
}

void DumpGrains::read(JoinedDumps& dump, ArchiveGrains& grains,
                      const std::vector<std::size_t>& more)
{
  const auto header = dump.header();
  look_up(header);
  auto all = wanted_;
  all.insert(all.end(), more.begin(), more.end());
  auto sorted = all;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    throw UsageError(fmt::format("--wall-columns: column {} ({}) of {} would be two things at once",
                                 *twice + 1, header.columns[*twice], header.place));
  dump.read_rows(all, values_, {type_, &types_});
  const auto column = [&](int k) -> const std::vector<double>& {
    static const std::vector<double> none;
    return k < 0 ? none : values_[static_cast<std::size_t>(k)];
  };
  grains.id.clear();
  for (const double id : column(id_))
    grains.id.push_back(whole_number<std::int64_t>(id, "id", header.place));
  types_.fill(column(type_), header.place, grains);
  grains.mass = column(mass_);
  grains.radius = column(radius_ >= 0 ? radius_ : diameter_);
  if (diameter_ >= 0)
    for (auto& radius : grains.radius) radius /= 2;

  take(position_, grains.position);
  if (positions_ == Positions::scaled)
    for (auto& x : grains.position) x = header.low + x.cwiseProduct(header.high - header.low);
  grains.image.assign(any(image_) ? grains.id.size() : 0, {});
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t g = 0; image_[axis] >= 0 && g < grains.image.size(); ++g)
      grains.image[g][axis] =
          whole_number<std::int32_t>(column(image_[axis])[g], "image", header.place);
  take(velocity_, grains.velocity);
  take(spin_, grains.angular_velocity);
  take(force_, grains.force);
  grains.missing = missing_;
  grains.unwrapped = unwrapped_;
}

}  // namespace grseg
