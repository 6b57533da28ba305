// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/trajectory/h5md.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/layout.hpp"
#include "formats/trajectory/run_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace grseg {
namespace {

using namespace hdf5;

/// Sets that everything added to a file from now on begins at a multiple of `bytes`.
void align(hid_t access, hsize_t bytes)
{
  H5Pset_meta_block_size(access, 0);
  H5Pset_alignment(access, 1, bytes);
}

/// Rows of a chunk of a growing dataset.
hsize_t chunk_rows(const LayoutRow& row, const StorageSettings& storage)
{
  if (row.shape[0] == 'C') return storage.contact_chunk;
  if (row.shape.starts_with("FN")) return 1;
  return row.shape == "FD" ? std::max<hsize_t>(storage.scalar_chunk / 8, 1) : storage.scalar_chunk;
}

constexpr hsize_t page = 4096;  // bytes

class NewFile {
 public:
  NewFile(const std::string& path, const RunDescription& run, const StorageSettings& storage)
      : path_(path), run_(run), storage_(storage)
  {
    const Properties create = without_time();
    // Space that the library frees during a run is not reused, because a kill may come before the
    // index on disk is updated.
    if (storage.live) H5Pset_file_space_strategy(create, H5F_FSPACE_STRATEGY_NONE, 0, 1);
    const Properties access = newest_format();
    // Bytes; no object header is longer, so that no two of them share a slot.
    if (storage.live) align(access, 512);
    file_ = File(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create, access));
    if (!file_.valid())
      throw RunError(fmt::format("cannot create {}: {}", path, reason_of_failure()));
  }

  void write()
  {
    write_metadata();
    write_grains();
    write_species();
    create_series("/particles/");
    for (const auto& [name, unit] : run_.observables) {
      create_series("/observables/" + name + "/value", {"", Number::f64, "F", unit.c_str()});
      h5md::link_times(file_, position, "/observables/" + name);
    }
    create_series("/grseg/contacts/");
    write_parameters();
    create_series("/grseg/digest");
    create_series("/grseg/field_digest");
    const auto digest = static_digest(run_);
    write_fixed(file_, "/grseg/static_digest", H5T_STD_U64LE, H5T_NATIVE_UINT64, {}, &digest);
    const auto seal = Seal{}.numbers();
    write_numbers("/grseg/seal", seal);
    if (close_file(file_.release()) < 0)
      throw RunError(fmt::format("cannot write {}: {}", path_, reason_of_failure()));
  }

 private:
  /// Writes the dataset `at`, which does not grow.
  template <class Numbers>
  void write_numbers(const char* at, const Numbers& numbers) const
  {
    const auto type = type_of(row_at(at).type);
    write_fixed(file_, at, type, type, {numbers.size()}, numbers.data());
  }

  void write_metadata() const
  {
    h5md::write_root(file_);
    write_attribute(make_group(file_, "/h5md/modules/grseg"), "version", std::vector<int>{1, 0});
    const auto& box = run_.box;
    const auto word = [](bool periodic) { return periodic ? "periodic" : "none"; };
    std::vector<std::string> boundary{word(box.periodic_x), word(false)};
    std::vector<double> edges{box.length_x, box.length_y};
    if (box.dimension == 3) {
      boundary.emplace_back(word(box.periodic_z));
      edges.push_back(box.length_z);
    }
    h5md::write_box(file_, "grains", boundary);
    if (run_.grains_come_and_go)
      write_attribute(Group(H5Gopen2(file_, "/particles/grains", H5P_DEFAULT)), "come_and_go",
                      std::vector<int>{1});
    write_numbers("/particles/grains/box/edges", edges);
    make_group(file_, "/parameters");
    make_group(file_, "/observables");
  }

  void write_grains() const
  {
    const auto& all = run_.grains;
    write_numbers("/particles/grains/id", all.id);
    write_numbers("/particles/grains/species",
                  species_numbers(all.species, species_of(run_).size()));
    write_numbers("/particles/grains/radius", all.radius);
    write_numbers("/particles/grains/mass", all.mass);
    write_numbers("/particles/grains/fixed", all.fixed);
  }

  void write_species() const
  {
    auto list = species_of(run_);
    std::vector<std::uint8_t> mobile(list.size(), 1);
    list.push_back({name_of_boundary, 0});
    mobile.push_back(0);
    std::string names;
    std::vector<double> diameters;
    for (const auto& [name, diameter] : list) {
      if (name != name_of_boundary && !is_species_name(name))
        throw UsageError(
            fmt::format("a species cannot be called '{}': {}", name, rule_of_species_names));
      names += name;
      diameters.push_back(diameter);
      names.resize(longest_species_name * diameters.size(), '\0');
    }
    const auto text = string_type(longest_species_name);
    write_fixed(file_, "/grseg/species/name", text, text, {list.size()}, names.data());
    write_numbers("/grseg/species/diameter", diameters);
    write_numbers("/grseg/species/mobile", mobile);
  }

  /// Creates the growing datasets whose paths begin with `group`. H5MD elements consist of `value`,
  /// `step` and `time`; the last two become links.
  void create_series(std::string_view group) const
  {
    for (const auto& row : layout) {
      const std::string path = row.path;
      if (!path.starts_with(group) || !row.grows()) continue;
      if (path == row_of(Field::force).path && !run_.has_force) continue;
      create_series(path, row);
      if (path.ends_with("/value") && path != row_of(Field::position).path)
        h5md::link_times(file_, position, path.substr(0, path.rfind('/')));
    }
  }

  void create_series(const std::string& path, const LayoutRow& row) const
  {
    const auto of_frame =
        shape_of(row.shape.substr(1), {0, 0, run_.grains.size(), 0, run_.box.dimension});
    const auto dataset = create_growing(file_, path, type_of(row.type, storage_.float32), of_frame,
                                        {chunk_rows(row, storage_), storage_.compression});
    if (*row.unit != '\0') write_attribute(dataset, "unit", std::string(row.unit));
  }

  void write_parameters() const
  {
    for (const auto& [name, values] : run_.parameters.numbers)
      if (name != "complete") write_parameter(file_, name, values, false);
    for (const auto& [name, text] : run_.parameters.texts) write_parameter(file_, name, text);
    write_parameter(file_, "complete", std::vector<double>{0}, false);
  }

  static constexpr const char* position = "/particles/grains/position";

  std::string path_;
  const RunDescription& run_;
  StorageSettings storage_;
  File file_;
};

/// Removes the parameter `name`, if it exists, so that it can be rewritten; returns its path.
std::string cleared(hid_t file, const std::string& name)
{
  std::string at = "/parameters/" + name;
  if (exists(file, at)) H5Ldelete(file, at.c_str(), H5P_DEFAULT);
  return at;
}

}  // namespace

void keep_in_pages(hid_t access)
{
  align(access, page);
}

double size_of_live_file(const LayoutSizes& run, std::size_t observables, bool float32)
{
  silence();
  // Bytes of a growing dataset beside its chunks, measured: index, in pages, and header.
  constexpr double index = 4.5 * page + 512;
  const auto round_up = [](auto bytes, auto unit) { return (bytes + unit - 1) / unit * unit; };
  const auto bytes_of = [&](const LayoutRow& row) {
    const auto rows = chunk_rows(row, {});
    hsize_t bytes = rows * H5Tget_size(type_of(row.type, float32));
    for (const auto size : shape_of(row.shape.substr(1), run)) bytes *= size;
    const auto all = row.shape[0] == 'C' ? run.contacts : run.frames;
    const auto chunks = round_up(all, rows) / rows;
    return index + static_cast<double>(round_up(bytes, page) * chunks);
  };
  const auto& of_observable = row_at("/particles/grains/position/time");
  double bytes = static_cast<double>(observables) * bytes_of(of_observable);
  for (const auto& row : layout)
    if (row.grows()) bytes += bytes_of(row);
  return bytes;
}

void create_trajectory(const std::string& path, const RunDescription& run,
                       const StorageSettings& storage)
{
  silence();
  NewFile(path, run, storage).write();
}

void write_parameter(hid_t file, const std::string& name, const std::vector<double>& values,
                     bool live)
{
  if (live) return overwrite(file, "/parameters/" + name, H5T_NATIVE_DOUBLE, values.data());
  std::vector<hsize_t> shape;
  if (values.size() != 1) shape = {values.size()};
  write_fixed(file, cleared(file, name), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, values.data());
}

void write_parameter(hid_t file, const std::string& name, const std::string& text)
{
  const auto type = string_type(text.size());
  write_fixed(file, cleared(file, name), type, type, {}, text.c_str());
}

}  // namespace grseg
