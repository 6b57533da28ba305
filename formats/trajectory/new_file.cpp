// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/new_file.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/h5md.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/run_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace grseg {
namespace {

using namespace hdf5;

/// From here on all that is added to a file begins at a multiple of so many bytes.
void align(hid_t access, hsize_t bytes)
{
  H5Pset_meta_block_size(access, 0);
  H5Pset_alignment(access, 1, bytes);
}

class NewFile {
 public:
  NewFile(const std::string& path, const RunDescription& run, const StorageSettings& storage)
      : path_(path), run_(run), storage_(storage)
  {
    const Properties create = without_time();
    // Space that the library frees during a run is not reused: a kill may come before the index on
    // disk is updated.
    if (storage.live) H5Pset_file_space_strategy(create, H5F_FSPACE_STRATEGY_NONE, 0, 1);
    const Properties access = newest_format();
    if (storage.live) align(access, 512);  // headers are shorter
    file_ = File(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create, access));
    if (!file_.valid())
      throw RunError(fmt::format("cannot create {}: {}", path, reason_of_failure()));
  }

  void write()
  {
    write_metadata();
    write_grains();
    write_species();
    create_elements();
    create_contacts();
    write_parameters();
    create_digests();
    if (close_file(file_.release()) < 0)
      throw RunError(fmt::format("cannot write {}: {}", path_, reason_of_failure()));
  }

 private:
  hsize_t components() const { return static_cast<hsize_t>(run_.box.dimension); }
  hid_t real_type() const { return storage_.float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE; }

  void write_metadata();
  void write_grains();
  void write_species();
  void create_elements();
  void create_contacts();
  void write_parameters();
  void create_digests();

  void create_series(const std::string& at, const std::string& unit, hid_t type,
                     const std::vector<hsize_t>& shape, hsize_t chunk_rows);
  void create_element(const std::string& at, const std::string& unit, hid_t type,
                      const std::vector<hsize_t>& shape);

  std::string path_;
  const RunDescription& run_;
  StorageSettings storage_;
  File file_;
};

void NewFile::write_metadata()
{
  h5md::write_root(file_);
  write_attribute(make_group(file_, "/h5md/modules/grseg"), "version", std::vector<int>{1, 0});
  const auto& box = run_.box;
  const auto word = [](bool periodic) { return periodic ? "periodic" : "none"; };
  std::vector<std::string> boundary{word(box.periodic_x), word(false)};
  if (box.dimension == 3) boundary.emplace_back(word(box.periodic_z));
  h5md::write_box(file_, "grains", boundary);
  if (run_.grains_come_and_go)
    write_attribute(Group(H5Gopen2(file_, "/particles/grains", H5P_DEFAULT)), "come_and_go",
                    std::vector<int>{1});
  const double edges[3] = {box.length_x, box.length_y, box.length_z};
  write_fixed(file_, "/particles/grains/box/edges", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
              {components()}, edges);
  make_group(file_, "/parameters");
  make_group(file_, "/observables");
}

void NewFile::write_grains()
{
  const auto& all = run_.grains;
  const std::vector<hsize_t> shape{all.size()};
  const std::string at = "/particles/grains/";
  write_fixed(file_, at + "id", H5T_STD_I32LE, H5T_NATIVE_INT32, shape, all.id.data());
  const auto species = species_numbers(all.species, species_of(run_).size());
  write_fixed(file_, at + "species", H5T_STD_I32LE, H5T_NATIVE_INT32, shape, species.data());
  write_fixed(file_, at + "radius", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, all.radius.data());
  write_fixed(file_, at + "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, all.mass.data());
  write_fixed(file_, at + "fixed", H5T_STD_U8LE, H5T_NATIVE_UINT8, shape, all.fixed.data());
}

void NewFile::write_species()
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
  const std::vector<hsize_t> shape{list.size()};
  const auto text = string_type(longest_species_name);
  const std::string at = "/grseg/species/";
  write_fixed(file_, at + "name", text, text, shape, names.data());
  write_fixed(file_, at + "diameter", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, diameters.data());
  write_fixed(file_, at + "mobile", H5T_STD_U8LE, H5T_NATIVE_UINT8, shape, mobile.data());
}

void NewFile::create_series(const std::string& at, const std::string& unit, hid_t type,
                            const std::vector<hsize_t>& shape, hsize_t chunk_rows)
{
  const auto dataset = create_growing(file_, at, type, shape, {chunk_rows, storage_.compression});
  if (!unit.empty()) write_attribute(dataset, "unit", unit);
}

/// Something with a row per frame that has `value`, `step` and `time`, as H5MD demands.
void NewFile::create_element(const std::string& at, const std::string& unit, hid_t type,
                             const std::vector<hsize_t>& shape)
{
  create_series(at + "/value", unit, type, shape, shape.empty() ? storage_.scalar_chunk : 1);
  const std::string first = "/particles/grains/position";
  if (at != first) return h5md::link_times(file_, first, at);
  create_series(at + "/step", "", H5T_STD_I64LE, {}, storage_.scalar_chunk);
  create_series(at + "/time", "s", H5T_IEEE_F64LE, {}, storage_.scalar_chunk);
}

void NewFile::create_elements()
{
  const hsize_t n = run_.grains.size(), d = components();
  const std::vector<hsize_t> spins = d == 2 ? std::vector{n} : std::vector{n, d};
  const std::string at = "/particles/grains/";
  create_element(at + "position", "m", real_type(), {n, d});
  create_element(at + "image", "", H5T_STD_I32LE, {n, d});
  create_element(at + "velocity", "m s-1", real_type(), {n, d});
  create_element(at + "angular_velocity", "s-1", real_type(), spins);
  if (run_.has_force) create_element(at + "force", "N", real_type(), {n, d});
  for (const auto& [name, unit] : run_.observables)
    create_element("/observables/" + name, unit, H5T_IEEE_F64LE, {});
}

void NewFile::create_contacts()
{
  const std::string at = "/grseg/contacts/";
  const auto rows = storage_.contact_chunk;
  create_series(at + "i", "", H5T_STD_I32LE, {}, rows);
  create_series(at + "j", "", H5T_STD_I32LE, {}, rows);
  create_series(at + "force", "N", real_type(), {components()}, rows);
  create_series(at + "branch", "m", real_type(), {components()}, rows);
  create_series(at + "gap", "m", real_type(), {}, rows);
  create_series(at + "offset", "", H5T_STD_U64LE, {}, storage_.scalar_chunk);
}

void NewFile::write_parameters()
{
  for (const auto& [name, values] : run_.parameters.numbers)
    if (name != "complete") write_parameter(file_, name, values, false);
  for (const auto& [name, text] : run_.parameters.texts) write_parameter(file_, name, text);
  write_parameter(file_, "complete", std::vector<double>{0}, false);
}

void NewFile::create_digests()
{
  create_series("/grseg/digest", "", H5T_STD_U64LE, {}, storage_.scalar_chunk);
  create_series("/grseg/field_digest", "", H5T_STD_U64LE, {number_of_fields},
                std::max<hsize_t>(storage_.scalar_chunk / 8, 1));
  const auto digest = static_digest(run_);
  write_fixed(file_, "/grseg/static_digest", H5T_STD_U64LE, H5T_NATIVE_UINT64, {}, &digest);
  const auto seal = Seal{}.numbers();
  write_fixed(file_, "/grseg/seal", H5T_STD_U64LE, H5T_NATIVE_UINT64, {seal.size()}, seal.data());
}

/// Makes room for a parameter that is written anew.
std::string cleared(hid_t file, const std::string& name)
{
  std::string at = "/parameters/" + name;
  if (exists(file, at)) H5Ldelete(file, at.c_str(), H5P_DEFAULT);
  return at;
}

}  // namespace

void keep_in_pages(hid_t access)
{
  align(access, 4096);
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
