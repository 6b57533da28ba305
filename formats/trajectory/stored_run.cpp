// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/file_kind.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace grseg {
namespace {

using namespace hdf5;

// Limits far beyond any real run, by which damaged sizes are refused before memory is allocated.
constexpr hsize_t most_grains = 100'000'000;
constexpr hsize_t most_frames = 100'000'000;
constexpr hsize_t most_species = 65536;
constexpr hsize_t most_text = 16'000'000;  // bytes of a text parameter
constexpr hsize_t most_numbers = 65536;    // numbers of one parameter

/// A text of fixed length without its padding of zeros.
std::string padded(const std::string& all, std::size_t begin, std::size_t length)
{
  std::string text = all.substr(begin, length);
  text.erase(std::min(text.find('\0'), text.size()));
  return text;
}

/// Numbers and names of all species for messages: "0 small, 1 large, 2 boundary".
std::string numbers_and_names(const SpeciesList& list)
{
  std::string words;
  for (std::size_t k = 0; k < list.size(); ++k)
    words += fmt::format("{} {}, ", k, printable(list[k].name));
  return words + fmt::format("{} {}", list.size(), name_of_boundary);
}

/// Reads the content of a file outside frames.
class HeadReader {
 public:
  HeadReader(hid_t file, const std::string& path) : file_(file) { run_.path = path; }

  StoredRun run() &&
  {
    require_versions();
    read_offset();
    read_box();
    for (const auto& name : names_in(file_, "/parameters")) read_parameter(name);
    read_ends_of_cell();
    read_species();
    read_grains();
    read_times();
    read_digests();
    read_observables();
    auto& description = run_.description;
    description.has_force = exists(file_, "/particles/grains/force/value");
    description.grains_come_and_go = !attribute("/particles/grains", "come_and_go").empty();
    return std::move(run_);
  }

 private:
  CheckedDataset open(const std::string& at, H5T_class_t kind, int rank) const
  {
    return {file_, at, kind, rank, run_.path};
  }

  void read_ends_of_cell()
  {
    const auto& numbers = run_.description.parameters.numbers;
    const auto low = numbers.find("import_low");
    if (low == numbers.end()) return;
    auto& box = run_.description.box;
    if (low->second.size() != 2) run_.fail("/parameters/import_low has not two numbers");
    box.low_x = low->second[0];
    box.low_z = low->second[1];
  }

  std::vector<double> attribute(const char* path, const char* name) const
  {
    return numbers_in_attribute(file_, path, name, run_.path);
  }

  std::vector<double> version_of(const char* module) const
  {
    auto version = attribute(module, "version");
    if (version.size() != 2)
      run_.fail(kind_of_file(run_.path).instead_of(
          "a run", fmt::format("{} has no version: not a run of grseg, or damaged", module)));
    return version;
  }

  void require_versions() const
  {
    const auto h5md = version_of("/h5md"), file = version_of("/h5md/modules/grseg");
    if (h5md[0] != 1)
      run_.fail(fmt::format("/h5md has version {}, but this grseg reads versions 1.x",
                            fmt::join(h5md, ".")));
    if (file != std::vector{1.0, 0.0})
      run_.fail(
          fmt::format("/h5md/modules/grseg has version {}, but this grseg reads version 1.0: read "
                      "the file with the grseg that wrote it",
                      fmt::join(file, ".")));
  }

  /// First `count` entries of a dataset that must have `count` entries (with `at_least`: or more).
  template <class T>
  std::vector<T> column(const std::string& at, hsize_t count, bool at_least = false) const
  {
    const auto& row = row_at(at);
    const auto kind = H5Tget_class(type_of(row.type));
    const auto dataset = open(at, kind, static_cast<int>(row.shape.size()));
    dataset.require(0, count, at_least);
    if (row.shape == "FD") dataset.require(1, number_of_fields);
    std::vector<T> values(count);
    dataset.read_rows(type_of(row.type), 0, count, values.data());
    return values;
  }

  void read_offset()
  {
    const auto entries = open("/grseg/contacts/offset", H5T_INTEGER, 1).dims()[0];
    // A run that was killed before it committed anything has not even the first entry.
    if (entries == 0 && open("/grseg/digest", H5T_INTEGER, 1).dims()[0] == 0) {
      run_.offset = {0};
      return;
    }
    if (entries < 1 || entries > most_frames)
      run_.fail(fmt::format("/grseg/contacts/offset has {} entries; 1 to {} are possible", entries,
                            most_frames));
    run_.offset = column<std::uint64_t>("/grseg/contacts/offset", entries);
    for (std::size_t k = 0; k < run_.offset.size(); ++k) {
      if (k == 0 ? run_.offset[k] != 0 : run_.offset[k] < run_.offset[k - 1])
        run_.fail(fmt::format("/grseg/contacts/offset does not increase from 0 at entry {}", k));
    }
  }

  void read_box()
  {
    const char* box = "/particles/grains/box";
    const bool spatial = attribute(box, "dimension") == std::vector{3.0};
    const std::size_t size = spatial ? 3 : 2;
    const auto edges = column<double>("/particles/grains/box/edges", size);
    const auto boundary = read_texts(Group(H5Gopen2(file_, box, H5P_DEFAULT)), "boundary");
    bool good = boundary.size() == size;
    for (std::size_t axis = 0; good && axis < size; ++axis)
      good = boundary[axis] == "none" || (axis != 1 && boundary[axis] == "periodic");
    if (!good)
      run_.fail(
          spatial
              ? "/particles/grains/box: boundary should be \"periodic\" or \"none\" along x and z, "
                "and \"none\" along y"
              : "/particles/grains/box: boundary should be (\"periodic\",\"none\") or "
                "(\"none\",\"none\")");
    for (const std::size_t axis : {std::size_t{0}, std::size_t{2}})
      if (axis < size && (!(edges[axis] > 0) || !std::isfinite(edges[axis])))
        run_.fail(fmt::format("/particles/grains/box: edges[{}] <= 0", axis));
    run_.description.box = {edges[0], edges[1], boundary[0] == "periodic"};
    if (spatial)
      run_.description.box = {edges[0], edges[1], boundary[0] == "periodic",
                              3,        edges[2], boundary[2] == "periodic"};
  }

  /// Reads the species: mobile ones in order of their diameters, then the boundary.
  void read_species()
  {
    const auto names = open("/grseg/species/name", H5T_STRING, 1);
    const auto count = names.dims()[0];
    const std::size_t length = H5Tget_size(Type(H5Dget_type(names.id())));
    if (count < 2 || count > most_species || length > 256)
      run_.fail(
          fmt::format("/grseg/species/name has {} entries of {} bytes; 2 to {} of at most 256 are "
                      "possible",
                      count, length, most_species));
    std::string text(length * count, '\0');
    names.read_all(Type(H5Dget_type(names.id())), text.data());
    const auto diameter = column<double>("/grseg/species/diameter", count);
    const auto moves = column<std::uint8_t>("/grseg/species/mobile", count);
    bool good = moves.back() == 0 && diameter.back() == 0 &&
                padded(text, (count - 1) * length, length) == name_of_boundary;
    for (std::size_t k = 0; good && k + 1 < count; ++k) {
      run_.description.species.push_back({padded(text, k * length, length), diameter[k]});
      good = moves[k] == 1 && std::isfinite(diameter[k]) &&
             diameter[k] >= (k == 0 ? 0 : diameter[k - 1]);
    }
    if (!good)
      run_.fail(
          "/grseg/species should list mobile species in order of their diameters, and last the "
          "boundary");
    std::set<std::string> different;
    for (const auto& [name, size] : run_.description.species) {
      if (!is_species_name(name))
        run_.fail(fmt::format("/grseg/species/name contains '{}': {}", printable(name),
                              rule_of_species_names));
      if (!different.insert(name).second)
        run_.fail(fmt::format("/grseg/species/name contains {} twice", printable(name)));
    }
    const auto of_parameters =
        two_sizes(run_.description.parameters.find_number("small_diameter").value_or(0),
                  run_.description.parameters.find_number("large_diameter").value_or(0));
    if (run_.description.species.front().diameter != of_parameters.front().diameter ||
        run_.description.species.back().diameter != of_parameters.back().diameter)
      run_.fail("/grseg/species disagrees with /parameters: the file is damaged");
  }

  void read_grains()
  {
    auto& grains = run_.description.grains;
    const hsize_t count = open("/particles/grains/radius", H5T_FLOAT, 1).dims()[0];
    if (count < 1 || count > most_grains)
      run_.fail(fmt::format("/particles/grains/radius has {} entries; 1 to {} are possible", count,
                            most_grains));
    grains.radius = column<double>("/particles/grains/radius", count);
    grains.mass = column<double>("/particles/grains/mass", count);
    grains.id = column<std::int32_t>("/particles/grains/id", count);
    grains.fixed = column<std::uint8_t>("/particles/grains/fixed", count);
    const auto species = column<std::int32_t>("/particles/grains/species", count);
    const auto& list = run_.description.species;
    for (std::size_t g = 0; g < count; ++g) {
      if (species[g] < 0 || static_cast<std::size_t>(species[g]) > list.size())
        run_.fail(fmt::format("/particles/grains/species is {} for grain {}; {}", species[g], g,
                              numbers_and_names(list)));
      grains.species.push_back(species_of_number(species[g], list.size()));
      if (!(grains.radius[g] > 0) || !(grains.mass[g] > 0) || !std::isfinite(grains.radius[g]) ||
          !std::isfinite(grains.mass[g]))
        run_.fail(fmt::format("the radius or mass of grain {} is not positive", g));
    }
  }

  void read_times()
  {
    run_.steps = column<std::int64_t>("/particles/grains/position/step", run_.size(), true);
    run_.times = column<double>("/particles/grains/position/time", run_.size(), true);
    for (std::size_t k = 0; k < run_.size(); ++k) {
      if (!std::isfinite(run_.times[k]))
        run_.fail(fmt::format("time of frame {} is not a finite number; the frame is damaged", k));
      if (k > 0 && (run_.steps[k] <= run_.steps[k - 1] || run_.times[k] <= run_.times[k - 1]))
        run_.fail(fmt::format("steps and times do not increase at frame {}", k));
    }
  }

  void read_digests()
  {
    run_.chain = column<std::uint64_t>("/grseg/digest", run_.size(), true);
    run_.field_digests = column<FieldDigests>("/grseg/field_digest", run_.size(), true);
    open("/grseg/static_digest", H5T_INTEGER, 0).read_all(H5T_NATIVE_UINT64, &run_.static_digest);
    const auto seal = column<std::uint64_t>("/grseg/seal", run_.seal.size());
    std::copy(seal.begin(), seal.end(), run_.seal.begin());
  }

  void read_parameter(const std::string& name)
  {
    const std::string at = "/parameters/" + name;
    const Dataset dataset(H5Dopen2(file_, at.c_str(), H5P_DEFAULT));
    if (!dataset.valid()) return;  // a group, which a newer version of the format may have
    const Type type(H5Dget_type(dataset));
    if (H5Tget_class(type) == H5T_STRING) {
      const auto text = open(at, H5T_STRING, 0);
      if (H5Tget_size(type) > most_text) run_.fail(at + " is too long");
      std::string content(H5Tget_size(type), '\0');
      text.read_all(type, content.data());
      run_.description.parameters.texts[name] = padded(content, 0, content.size());
      return;
    }
    const int rank = H5Sget_simple_extent_ndims(Space(H5Dget_space(dataset)));
    const auto numbers = open(at, H5T_FLOAT, rank == 0 ? 0 : 1);
    const hsize_t count = rank == 0 ? 1 : numbers.dims()[0];
    if (count > most_numbers) run_.fail(at + " is too long");
    std::vector<double> values(count);
    numbers.read_all(H5T_NATIVE_DOUBLE, values.data());
    run_.description.parameters.numbers[name] = values;
  }

  void read_observables()
  {
    for (const auto& name : names_in(file_, "/observables")) {
      if (!exists(file_, "/observables/" + name + "/value")) continue;
      const auto value = open("/observables/" + name + "/value", H5T_FLOAT, 1);
      const auto unit = read_texts(value.id(), "unit");
      run_.description.observables.push_back({name, unit.empty() ? "" : unit[0]});
    }
  }

  hid_t file_;
  StoredRun run_;
};

}  // namespace

void StoredRun::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", path, why));
}

StoredRun read_stored_run(hid_t file, const std::string& path)
{
  return HeadReader(file, path).run();
}

}  // namespace grseg
