// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/stored_run.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace grseg {

using namespace hdf5;

namespace {

// Limits far beyond any real run: a damaged size is refused before memory is allocated.
constexpr hsize_t most_grains = 100'000'000;
constexpr hsize_t most_frames = 100'000'000;
constexpr hsize_t most_species = 65536;
constexpr hsize_t most_text = 16'000'000;
constexpr hsize_t most_numbers = 65536;  // in a parameter

/// A small cache for the index of chunks, so that memory does not grow with the number of frames,
/// which are read one after the other.
Properties small_index_cache()
{
  silence();
  Properties access(H5Pcreate(H5P_FILE_ACCESS));
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(access, &cache);
  cache.set_initial_size = true;
  cache.initial_size = cache.min_size = cache.max_size = 131072;  // bytes
  H5Pset_mdc_config(access, &cache);
  return access;
}

/// A text of fixed length, which is padded with zeros.
std::string padded(const std::string& all, std::size_t begin, std::size_t length)
{
  std::string text = all.substr(begin, length);
  text.erase(std::min(text.find('\0'), text.size()));
  return text;
}

/// "0 small, 1 large, 2 boundary"
std::string numbers_and_names(const SpeciesList& list)
{
  std::string words;
  for (std::size_t k = 0; k < list.size(); ++k)
    words += fmt::format("{} {}, ", k, printable(list[k].name));
  return words + fmt::format("{} {}", list.size(), name_of_boundary);
}

}  // namespace

StoredRun::StoredRun(const std::string& its_path)
    : path(its_path), file(open_for_reading(path, small_index_cache()))
{
  require_version("/h5md");
  minor_version = require_version("/h5md/modules/grseg")[1];
  run.grains_come_and_go = minor_version >= 2;
  read_offset();
  read_box();
  read_parameters();
  if (has_field_digests())
    read_species();
  else
    run.species = species_of(run);
  read_grains();
  read_times();
  read_digests();
  read_observables();

  position = element("position", H5T_FLOAT, 3);
  velocity = element("velocity", H5T_FLOAT, 3);
  angular_velocity = element("angular_velocity", H5T_FLOAT, dimension() == 2 ? 2 : 3);
  image = element("image", H5T_INTEGER, 3);
  run.has_force = exists(file, "/particles/grains/force/value");
  if (run.has_force) force = element("force", H5T_FLOAT, 3);
  contact_i = rows("i", H5T_INTEGER, 1);
  contact_j = rows("j", H5T_INTEGER, 1);
  contact_force = rows("force", H5T_FLOAT, 2);
  contact_branch = rows("branch", H5T_FLOAT, 2);
  contact_gap = rows("gap", H5T_FLOAT, 1);
}

void StoredRun::drop_last()
{
  offset.pop_back();
  steps.pop_back();
  times.pop_back();
  chain.pop_back();
  if (has_field_digests()) field_digests.pop_back();
}

void StoredRun::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", path, why));
}

template <class T>
std::vector<T> StoredRun::constant(const std::string& name, H5T_class_t kind, hid_t type,
                                   hsize_t count) const
{
  const auto dataset = open("/particles/grains/" + name, kind, 1);
  dataset.require(0, count);
  std::vector<T> values(count);
  dataset.read_all(type, values.data());
  return values;
}

RowReader StoredRun::element(const std::string& name, H5T_class_t kind, int rank) const
{
  auto dataset = open("/particles/grains/" + name + "/value", kind, rank);
  dataset.require(0, size(), true);
  dataset.require(1, run.grains.size());
  if (rank == 3) dataset.require(2, static_cast<hsize_t>(dimension()));
  return RowReader(std::move(dataset));
}

RowReader StoredRun::rows(const std::string& name, H5T_class_t kind, int rank) const
{
  auto dataset = open("/grseg/contacts/" + name, kind, rank);
  dataset.require(0, offset.back(), true);
  if (rank == 2) dataset.require(1, static_cast<hsize_t>(dimension()));
  return RowReader(std::move(dataset));
}

std::vector<int> StoredRun::require_version(const std::string& module) const
{
  auto version = read_integers(Group(H5Gopen2(file, module.c_str(), H5P_DEFAULT)), "version");
  if (version.size() != 2) version = {0, 0};
  if (version[0] != 1)
    fail(fmt::format("{} has version {}.{}, but this grseg reads versions 1.x", module, version[0],
                     version[1]));
  return version;
}

void StoredRun::read_offset()
{
  const auto dataset = open("/grseg/contacts/offset", H5T_INTEGER, 1);
  if (dataset.dims()[0] < 1 || dataset.dims()[0] > most_frames)
    fail("/grseg/contacts/offset has an impossible length");
  dataset.require_possible(dataset.dims()[0]);
  offset.resize(dataset.dims()[0]);
  dataset.read_all(H5T_NATIVE_UINT64, offset.data());
  for (std::size_t k = 0; k < offset.size(); ++k) {
    if (k == 0 ? offset[k] != 0 : offset[k] < offset[k - 1])
      fail(fmt::format("/grseg/contacts/offset does not increase from 0 at entry {}", k));
  }
}

void StoredRun::read_grains()
{
  auto& grains = run.grains;
  const auto radius = open("/particles/grains/radius", H5T_FLOAT, 1);
  const hsize_t count = radius.dims()[0];
  if (count < 1 || count > most_grains) fail("/particles/grains/radius has an impossible length");
  radius.require_possible(count);
  grains.radius = constant<double>("radius", H5T_FLOAT, H5T_NATIVE_DOUBLE, count);
  grains.mass = constant<double>("mass", H5T_FLOAT, H5T_NATIVE_DOUBLE, count);
  grains.id = constant<std::int32_t>("id", H5T_INTEGER, H5T_NATIVE_INT32, count);
  grains.fixed = constant<std::uint8_t>("fixed", H5T_INTEGER, H5T_NATIVE_UINT8, count);
  const auto species = constant<std::int32_t>("species", H5T_INTEGER, H5T_NATIVE_INT32, count);
  const auto list = species_of(run);
  for (std::size_t g = 0; g < count; ++g) {
    if (species[g] < 0 || static_cast<std::size_t>(species[g]) > list.size())
      fail(fmt::format("/particles/grains/species is {} for grain {}; {}", species[g], g,
                       numbers_and_names(list)));
    grains.species.push_back(species_of_number(species[g], list.size()));
    if (!(grains.radius[g] > 0) || !(grains.mass[g] > 0) || !std::isfinite(grains.radius[g]) ||
        !std::isfinite(grains.mass[g]))
      fail(fmt::format("the radius or mass of grain {} is not positive", g));
  }
}

void StoredRun::read_box()
{
  const Group group(H5Gopen2(file, "/particles/grains/box", H5P_DEFAULT));
  const auto dimension = read_integers(group, "dimension");
  const bool spatial = dimension == std::vector<int>{3};
  const std::size_t size = spatial ? 3 : 2;
  const auto edges = open("/particles/grains/box/edges", H5T_FLOAT, 1);
  edges.require(0, size);
  double values[3] = {0, 0, 0};
  edges.read_all(H5T_NATIVE_DOUBLE, values);
  const auto boundary = read_texts(group, "boundary");
  const auto known = [&](std::size_t axis) {
    return boundary[axis] == "none" || (axis != 1 && boundary[axis] == "periodic");
  };
  bool good = boundary.size() == size;
  for (std::size_t axis = 0; good && axis < size; ++axis) good = known(axis);
  if (!good)
    fail(spatial
             ? "/particles/grains/box: boundary should be \"periodic\" or \"none\" along x and z, "
               "and \"none\" along y"
             : "/particles/grains/box: boundary should be (\"periodic\",\"none\") or "
               "(\"none\",\"none\")");
  for (const std::size_t axis : {std::size_t{0}, std::size_t{2}})
    if (axis < size && (!(values[axis] > 0) || !std::isfinite(values[axis])))
      fail(fmt::format("/particles/grains/box: edges[{}] <= 0", axis));
  run.box = {values[0], values[1], boundary[0] == "periodic"};
  if (spatial) {
    run.box.dimension = 3;
    run.box.length_z = values[2];
    run.box.periodic_z = boundary[2] == "periodic";
  }
}

/// Mobile species in order of their diameters, then the boundary.
void StoredRun::read_species()
{
  const auto names = open("/grseg/species/name", H5T_STRING, 1);
  const auto diameters = open("/grseg/species/diameter", H5T_FLOAT, 1);
  const auto mobile = open("/grseg/species/mobile", H5T_INTEGER, 1);
  const auto count = names.dims()[0];
  const std::size_t length = H5Tget_size(Type(H5Dget_type(names.id())));
  if (count < 2 || count > most_species || length > 256)
    fail("/grseg/species/name has an impossible length");
  diameters.require(0, count);
  mobile.require(0, count);
  std::string text(length * count, '\0');
  std::vector<double> diameter(count);
  std::vector<std::uint8_t> moves(count);
  names.read_all(Type(H5Dget_type(names.id())), text.data());
  diameters.read_all(H5T_NATIVE_DOUBLE, diameter.data());
  mobile.read_all(H5T_NATIVE_UINT8, moves.data());
  bool good = moves.back() == 0 && diameter.back() == 0 &&
              padded(text, (count - 1) * length, length) == name_of_boundary;
  for (std::size_t k = 0; good && k + 1 < count; ++k) {
    run.species.push_back({padded(text, k * length, length), diameter[k]});
    good = moves[k] == 1 && std::isfinite(diameter[k]) &&
           diameter[k] >= (k == 0 ? 0 : diameter[k - 1]);
  }
  if (!good)
    fail(
        "/grseg/species should list mobile species in order of their diameters, and last the "
        "boundary");
  std::set<std::string> different;
  for (const auto& [name, size] : run.species) {
    if (!is_species_name(name))
      fail(fmt::format("/grseg/species/name holds '{}': {}", printable(name),
                       rule_of_species_names));
    if (!different.insert(name).second)
      fail(fmt::format("/grseg/species/name holds {} twice", printable(name)));
  }
  const auto of_parameters = two_sizes(run.parameters.find_number("small_diameter").value_or(0),
                                       run.parameters.find_number("large_diameter").value_or(0));
  if (run.species.front().diameter != of_parameters.front().diameter ||
      run.species.back().diameter != of_parameters.back().diameter)
    fail("/grseg/species disagrees with /parameters: the file is damaged");
}

void StoredRun::read_times()
{
  const auto step = open("/particles/grains/position/step", H5T_INTEGER, 1);
  const auto time = open("/particles/grains/position/time", H5T_FLOAT, 1);
  step.require(0, size(), true);
  time.require(0, size(), true);
  steps.resize(size());
  times.resize(size());
  step.read_rows(H5T_NATIVE_INT64, 0, size(), steps.data());
  time.read_rows(H5T_NATIVE_DOUBLE, 0, size(), times.data());
  for (std::size_t k = 0; k < size(); ++k) {
    check_finite(&times[k], 1, "time", k);
    if (k > 0 && (steps[k] <= steps[k - 1] || times[k] <= times[k - 1]))
      fail(fmt::format("steps and times do not increase at frame {}", k));
  }
}

void StoredRun::read_digests()
{
  const auto digests = open("/grseg/digest", H5T_INTEGER, 1);
  digests.require(0, size(), true);
  chain.resize(size());
  digests.read_rows(H5T_NATIVE_UINT64, 0, size(), chain.data());
  if (!has_field_digests()) return;
  const auto of_fields = open("/grseg/field_digest", H5T_INTEGER, 2);
  of_fields.require(0, size(), true);
  of_fields.require(1, number_of_fields);
  field_digests.resize(size());
  of_fields.read_rows(H5T_NATIVE_UINT64, 0, size(), field_digests.data());
}

void StoredRun::read_parameters()
{
  for (const auto& name : names_in(file, "/parameters")) read_parameter(name);
}

void StoredRun::read_parameter(const std::string& name)
{
  const std::string at = "/parameters/" + name;
  const Dataset dataset(H5Dopen2(file, at.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) return;  // a group of a newer version
  const Type type(H5Dget_type(dataset));
  if (H5Tget_class(type) == H5T_STRING) {
    const auto text = open(at, H5T_STRING, 0);
    if (H5Tget_size(type) > most_text) fail(at + " is too long");
    std::string content(H5Tget_size(type), '\0');
    text.read_all(type, content.data());
    content.erase(std::min(content.find('\0'), content.size()));  // padding
    run.parameters.texts[name] = content;
    return;
  }
  const int rank = H5Sget_simple_extent_ndims(Space(H5Dget_space(dataset)));
  const auto numbers = open(at, H5T_FLOAT, rank == 0 ? 0 : 1);
  const hsize_t count = rank == 0 ? 1 : numbers.dims()[0];
  if (count > most_numbers) fail(at + " is too long");
  std::vector<double> values(count);
  numbers.read_all(H5T_NATIVE_DOUBLE, values.data());
  run.parameters.numbers[name] = values;
}

void StoredRun::read_observables()
{
  for (const auto& name : names_in(file, "/observables")) {
    if (!exists(file, "/observables/" + name + "/value")) continue;
    const auto value = open("/observables/" + name + "/value", H5T_FLOAT, 1);
    const auto unit = read_texts(value.id(), "unit");
    run.observables.push_back({name, unit.empty() ? "" : unit[0]});
  }
}

std::vector<double> StoredRun::read_observable(const std::string& name) const
{
  const auto dataset = open("/observables/" + name + "/value", H5T_FLOAT, 1);
  dataset.require(0, size(), true);
  std::vector<double> values(size());
  dataset.read_rows(H5T_NATIVE_DOUBLE, 0, size(), values.data());
  return values;
}

void StoredRun::check_finite(const double* values, std::size_t count, const std::string& what,
                             std::size_t frame) const
{
  for (std::size_t k = 0; k < count; ++k)
    if (!std::isfinite(values[k]))
      fail(fmt::format("{} is not a finite number in frame {}, entry {}; the frame is damaged",
                       what, frame, k));
}

template <class T>
void StoredRun::load_row(const RowReader& rows, hsize_t row, std::vector<T>& out,
                         std::vector<PackedRows>& packed) const
{
  out.resize(run.grains.size());
  rows.load(row, 1, out.data(), packed);
}

namespace {

bool is_finite(double value)
{
  return std::isfinite(value);
}
template <int D>
bool is_finite(const Vector<D>& value)
{
  return value.allFinite();
}

bool is_nan(double value)
{
  return std::isnan(value);
}
template <int D>
bool is_nan(const Vector<D>& value)
{
  return value.array().isNaN().all();
}

}  // namespace

template <int D>
void StoredRun::check_presence(std::size_t index, const Frame<D>& frame) const
{
  const auto check_of = [&](const auto& values, const RowReader& rows) {
    for (std::size_t g = 0; g < values.size(); ++g)
      if (is_present(frame, g) ? !is_finite(values[g]) : !is_nan(values[g]))
        fail(fmt::format("{} of grain {} in frame {} is {}; the frame is damaged", rows.path(), g,
                         index,
                         is_present(frame, g)
                             ? "not finite"
                             : "not NaN throughout, though its position says that it is absent"));
  };
  check_of(frame.position, position);
  check_of(frame.velocity, velocity);
  check_of(frame.angular_velocity, angular_velocity);
  check_of(frame.force, force);
  const auto& contacts = frame.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const auto g : {contacts.i[k], contacts.j[k]})
      if (g >= 0 && !is_present(frame, static_cast<std::size_t>(g)))
        fail(fmt::format("contact {} of frame {} names grain {}, which is absent there", k, index,
                         g));
}

template <int D>
void StoredRun::load_contacts(std::size_t index, ContactList<D>& contacts,
                              std::vector<PackedRows>& packed) const
{
  const hsize_t begin = offset[index], count = offset[index + 1] - begin;
  if (count > 64 * run.grains.size() + 1024)
    fail(fmt::format("frame {} claims {} contacts for {} grains; /grseg/contacts/offset is damaged",
                     index, count, run.grains.size()));
  const auto load = [&](const RowReader& rows, auto& values) {
    values.resize(count);
    if (count > 0) rows.load(begin, count, values.data(), packed);
  };
  load(contact_i, contacts.i);
  load(contact_j, contacts.j);
  load(contact_force, contacts.force);
  load(contact_branch, contacts.branch);
  load(contact_gap, contacts.gap);
}

template <int D>
void StoredRun::check(std::size_t index, const Frame<D>& frame) const
{
  const auto finite = [&]<class T>(const std::vector<T>& values, const RowReader& rows) {
    check_finite(reinterpret_cast<const double*>(values.data()),
                 values.size() * sizeof(T) / sizeof(double), rows.path(), index);
  };
  if (!run.grains_come_and_go) {
    finite(frame.position, position);
    finite(frame.velocity, velocity);
    finite(frame.angular_velocity, angular_velocity);
    finite(frame.force, force);
  }
  finite(frame.contacts.force, contact_force);
  finite(frame.contacts.branch, contact_branch);
  finite(frame.contacts.gap, contact_gap);
  check_contacts(index, frame.contacts);
  if (run.grains_come_and_go) check_presence(index, frame);
}

template <int D>
void StoredRun::check_contacts(std::size_t index, const ContactList<D>& contacts) const
{
  const auto grain_count = static_cast<std::int64_t>(run.grains.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.i[k] < 0 || contacts.i[k] >= grain_count || contacts.j[k] >= grain_count ||
        contacts.i[k] == contacts.j[k])
      fail(fmt::format("contact {} of frame {} joins grains {} and {}, which is impossible", k,
                       index, contacts.i[k], contacts.j[k]));
  }
}

using Packed = std::vector<PackedRows>;
template void StoredRun::load_row(const RowReader&, hsize_t, std::vector<double>&, Packed&) const;
template void StoredRun::load_row(const RowReader&, hsize_t, std::vector<Vec2>&, Packed&) const;
template void StoredRun::load_row(const RowReader&, hsize_t, std::vector<Vec3>&, Packed&) const;
template void StoredRun::load_row(const RowReader&, hsize_t,
                                  std::vector<std::array<std::int32_t, 2>>&, Packed&) const;
template void StoredRun::load_row(const RowReader&, hsize_t,
                                  std::vector<std::array<std::int32_t, 3>>&, Packed&) const;
template void StoredRun::load_contacts(std::size_t, ContactList<2>&, Packed&) const;
template void StoredRun::load_contacts(std::size_t, ContactList<3>&, Packed&) const;
template void StoredRun::check(std::size_t, const Frame<2>&) const;
template void StoredRun::check(std::size_t, const Frame<3>&) const;

}  // namespace grseg
