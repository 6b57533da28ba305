// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace grseg {
namespace {

using Components = std::array<const char*, 3>;
using Triple = std::array<int, 3>;  // indices of three columns; -1: the column is missing

bool any(const Triple& columns)
{
  return std::any_of(columns.begin(), columns.end(), [](int column) { return column >= 0; });
}

struct Positions {
  Components names;
  bool scaled, unwrapped;
};

/// Columns of positions; if a dump has several kinds, the first one of this list is read.
constexpr Positions all_positions[] = {{{"x", "y", "z"}, false, false},
                                       {{"xs", "ys", "zs"}, true, false},
                                       {{"xu", "yu", "zu"}, false, true},
                                       {{"xsu", "ysu", "zsu"}, true, true}};

const Positions& positions_in(const DumpHeader& header)
{
  for (const auto& positions : all_positions)
    if (header.find(positions.names[0])) return positions;
  throw FormatError(
      fmt::format("{}: the grains have no positions; the dump needs "
                  "one of the columns x, xu, xs, xsu",
                  header.place));
}

/// Collects the columns to read from a block.
struct Wanted {
  const DumpHeader& header;
  std::vector<std::size_t> columns;
  std::vector<std::string> missing;  // names of missing components of vectors

  /// Adds the column of this name; returns its index in `columns`, -1 if it is missing.
  int add(std::string_view name)
  {
    const auto column = header.find(name);
    if (!column) return -1;
    columns.push_back(*column);
    return static_cast<int>(columns.size()) - 1;
  }
  /// Adds the three columns of a vector. Lists missing ones in `missing` if they are `needed` and
  /// another component is present.
  Triple add(const Components& names, const std::array<bool, 3>& needed = {true, true, true})
  {
    const Triple found{add(names[0]), add(names[1]), add(names[2])};
    for (std::size_t k = 0; k < 3; ++k)
      if (any(found) && found[k] < 0 && needed[k]) missing.emplace_back(names[k]);
    return found;
  }
};

void require_different(std::vector<std::size_t> columns, const DumpHeader& header)
{
  std::sort(columns.begin(), columns.end());
  const auto twice = std::adjacent_find(columns.begin(), columns.end());
  if (twice != columns.end())
    throw UsageError(
        fmt::format("--wall-columns: column {} ({}) of {} has two meanings; check the "
                    "first columns of the walls",
                    *twice + 1, header.columns[*twice], header.place));
}

template <class Integer>
Integer whole_number(double value, const char* name, const std::string& place)
{
  constexpr double most = std::min(9e15, static_cast<double>(std::numeric_limits<Integer>::max()));
  if (!is_whole(value, most))
    throw FormatError(
        fmt::format("{}: {} {:g} is not a whole number, or is too large", place, name, value));
  return static_cast<Integer>(value);
}

/// Attributes of LAMMPS's `dump custom` and of LIGGGHTS that are read, or have no effect here.
constexpr const char* known_columns[] = {
    "id",      "mol",       "proc",    "procp1",   "type",    "typelabel", "element",     "mass",
    "x",       "y",         "z",       "xs",       "ys",      "zs",        "xu",          "yu",
    "zu",      "xsu",       "ysu",     "zsu",      "ix",      "iy",        "iz",          "vx",
    "vy",      "vz",        "fx",      "fy",       "fz",      "q",         "mux",         "muy",
    "muz",     "mu",        "radius",  "diameter", "tqx",     "tqy",       "tqz",         "omegax",
    "omegay",  "omegaz",    "angmomx", "angmomy",  "angmomz", "heatflow",  "temperature", "density",
    "inertia", "thermostat"};

}  // namespace

std::vector<std::string> unknown_columns(const DumpHeader& grains)
{
  std::vector<std::string> unknown;
  for (const auto& name : grains.columns) {
    const bool is_computed =
        std::ranges::any_of(std::array{"c_", "f_", "v_", "i_", "d_", "i2_", "d2_"},
                            [&](const char* prefix) { return name.starts_with(prefix); });
    if (!is_computed && std::ranges::find(known_columns, name) == std::end(known_columns))
      unknown.push_back(name);
  }
  return unknown;
}

void DumpGrains::read(JoinedDumps& dump, ArchiveGrains& grains,
                      const std::vector<std::size_t>& more)
{
  const auto header = dump.header();
  Wanted wanted{header, {}, {}};
  const int id = wanted.add("id");
  if (id < 0)
    throw FormatError(fmt::format("{}: the grains have no column id, which contacts refer to{}",
                                  header.place,
                                  header.label == "ENTRIES" ? "; these are contacts (ITEM: "
                                                              "ENTRIES), name them with --contacts"
                                                            : ""));
  const int type = wanted.add(header.find("type") ? "type" : "typelabel");
  const int mass = wanted.add("mass"), radius = wanted.add("radius");
  const int diameter = radius < 0 ? wanted.add("diameter") : -1;
  const auto& positions = positions_in(header);
  const auto position = wanted.add(positions.names);
  Triple image{-1, -1, -1};
  if (!positions.unwrapped) image = wanted.add({"ix", "iy", "iz"}, header.periodic);
  const auto velocity = wanted.add({"vx", "vy", "vz"});
  const auto spin = wanted.add({"omegax", "omegay", "omegaz"});
  const auto force = wanted.add({"fx", "fy", "fz"});
  own_ = wanted.columns.size();
  wanted.columns.insert(wanted.columns.end(), more.begin(), more.end());
  require_different(wanted.columns, header);
  dump.read_rows(wanted.columns, values_, {type, &types_});

  const auto column = [&](int k) -> const std::vector<double>& {
    static const std::vector<double> none;
    return k < 0 ? none : values_[static_cast<std::size_t>(k)];
  };
  const auto take = [&](const Triple& columns, std::vector<Vec3>& out) {
    out.assign(any(columns) ? column(id).size() : 0, Vec3::Zero());
    for (int axis = 0; axis < 3; ++axis) {
      const auto& values = column(columns[static_cast<std::size_t>(axis)]);
      for (std::size_t g = 0; g < values.size(); ++g) out[g][axis] = values[g];
    }
  };
  grains.id.clear();
  for (const double number : column(id))
    grains.id.push_back(whole_number<std::int64_t>(number, "id", header.place));
  types_.fill(column(type), header.place, grains);
  grains.mass = column(mass);
  grains.radius = column(radius >= 0 ? radius : diameter);
  if (diameter >= 0)
    for (auto& r : grains.radius) r /= 2;
  take(position, grains.position);
  if (positions.scaled)
    for (auto& x : grains.position) x = header.low + x.cwiseProduct(header.high - header.low);
  grains.image.assign(any(image) ? grains.id.size() : 0, {});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& periods = column(image[axis]);
    for (std::size_t g = 0; g < periods.size(); ++g)
      grains.image[g][axis] = whole_number<std::int32_t>(periods[g], "image", header.place);
  }
  take(velocity, grains.velocity);
  take(spin, grains.angular_velocity);
  take(force, grains.force);
  grains.missing = std::move(wanted.missing);
  grains.unwrapped = positions.unwrapped;
}

}  // namespace grseg
