// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/writer.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/h5md.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/hdf5_failure.hpp"

#include <fmt/format.h>

#include <cassert>

namespace grseg {
namespace {

using namespace hdf5;

constexpr hsize_t contact_chunk = 8192;  // rows; about 64 kB of doubles
constexpr hsize_t scalar_chunk = 1024;

/// One growing dataset with the type it is filled from.
struct Series {
  Dataset dataset;
  hid_t memory_type = H5I_INVALID_HID;
  std::string path;

  void append(hsize_t rows, const void* data) const
  {
    append_rows(dataset, memory_type, rows, data, path);
  }
};

const double* first(const std::vector<Vec2>& values)
{
  return values.front().data();
}

}  // namespace

struct TrajectoryWriter::Impl {
  std::string path;
  StorageSettings storage;
  std::size_t grains = 0;
  File file;
  Series step, time;
  Series position, image, velocity, angular_velocity, force;
  Series offset, contact_i, contact_j, contact_force, contact_branch, contact_gap, digest;
  std::vector<Series> observables;
  std::size_t frames_so_far = 0;
  std::uint64_t contacts_so_far = 0;
  std::uint64_t digest_so_far = 0;

  hid_t real_type() const { return storage.float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE; }

  /// A chunk that belongs to one frame is written once and carries a checksum. One that fills up
  /// over many frames is rewritten in place during the run: its checksum would be wrong in between,
  /// and compression would move it. Such chunks are filtered in compressed files only.
  Storage storage_of(hsize_t chunk_rows) const
  {
    return {chunk_rows, storage.compression, chunk_rows == 1};
  }
  Series grow(const std::string& name, hid_t file_type, hid_t memory_type,
              const std::vector<hsize_t>& shape, hsize_t chunk_rows)
  {
    return {create_growing(file, name, file_type, shape, storage_of(chunk_rows)), memory_type,
            path + ": " + name};
  }

  void create_metadata(const RunDescription& run);
  void create_grains(const Grains& all);
  Series create_element(const std::string& name, const std::string& unit, hid_t file_type,
                        hid_t memory_type, const std::vector<hsize_t>& shape);
  void create_contacts();
  void write_parameters(const Parameters& parameters);
  void flush()
  {
    if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0)
      throw RunError(fmt::format("cannot write {}: {}", path, reason_of_failure()));
  }
};

void TrajectoryWriter::Impl::create_metadata(const RunDescription& run)
{
  h5md::write_root(file);
  write_attribute(h5md::make_group(file, "/h5md/modules/grseg"), "version", std::vector<int>{1, 0});
  h5md::write_box(file, "grains", {run.box.periodic_x ? "periodic" : "none", "none"});
  const double edges[2] = {run.box.length_x, run.box.length_y};
  write_fixed(file, "/particles/grains/box/edges", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {2}, edges);
  h5md::make_group(file, "/parameters");
  h5md::make_group(file, "/observables");
}

void TrajectoryWriter::Impl::create_grains(const Grains& all)
{
  const std::vector<hsize_t> shape{all.size()};
  const std::string at = "/particles/grains/";
  write_fixed(file, at + "id", H5T_STD_I32LE, H5T_NATIVE_INT32, shape, all.id.data());
  write_fixed(file, at + "species", H5T_STD_I32LE, H5T_NATIVE_INT32, shape, all.species.data());
  write_fixed(file, at + "radius", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, all.radius.data());
  write_fixed(file, at + "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, all.mass.data());
  write_fixed(file, at + "fixed", H5T_STD_U8LE, H5T_NATIVE_UINT8, shape, all.fixed.data());
}

Series TrajectoryWriter::Impl::create_element(const std::string& name, const std::string& unit,
                                              hid_t file_type, hid_t memory_type,
                                              const std::vector<hsize_t>& shape)
{
  const bool per_grain = !shape.empty();
  auto series = grow(name + "/value", file_type, memory_type, shape, per_grain ? 1 : scalar_chunk);
  if (!unit.empty()) write_attribute(series.dataset, "unit", unit);
  const std::string first_element = "/particles/grains/position";
  if (name != first_element) h5md::link_times(file, first_element, name);
  return series;
}

void TrajectoryWriter::Impl::create_contacts()
{
  const std::string at = "/grseg/contacts/";
  const auto add = [&](const std::string& name, const std::string& unit, hid_t type,
                       hid_t memory_type, const std::vector<hsize_t>& shape) {
    auto series = grow(at + name, type, memory_type, shape, contact_chunk);
    if (!unit.empty()) write_attribute(series.dataset, "unit", unit);
    return series;
  };
  contact_i = add("i", "", H5T_STD_I32LE, H5T_NATIVE_INT32, {});
  contact_j = add("j", "", H5T_STD_I32LE, H5T_NATIVE_INT32, {});
  contact_force = add("force", "N", real_type(), H5T_NATIVE_DOUBLE, {2});
  contact_branch = add("branch", "m", real_type(), H5T_NATIVE_DOUBLE, {2});
  contact_gap = add("gap", "m", real_type(), H5T_NATIVE_DOUBLE, {});
  digest = grow("/grseg/digest", H5T_STD_U64LE, H5T_NATIVE_UINT64, {}, scalar_chunk);
  offset = grow(at + "offset", H5T_STD_U64LE, H5T_NATIVE_UINT64, {}, scalar_chunk);
  offset.append(1, &contacts_so_far);
}

void TrajectoryWriter::Impl::write_parameters(const Parameters& parameters)
{
  const auto renew = [&](const std::string& name) {
    std::string at = "/parameters/" + name;
    if (exists(file, at)) H5Ldelete(file, at.c_str(), H5P_DEFAULT);
    return at;
  };
  for (const auto& [name, values] : parameters.numbers) {
    std::vector<hsize_t> shape;
    if (values.size() != 1) shape = {values.size()};
    write_fixed(file, renew(name), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, values.data());
  }
  for (const auto& [name, text] : parameters.texts) {
    const auto type = string_type(text.size());
    write_fixed(file, renew(name), type, type, {}, text.c_str());
  }
}

TrajectoryWriter::TrajectoryWriter(const std::string& path, const RunDescription& run,
                                   const StorageSettings& storage)
    : impl_(std::make_unique<Impl>())
{
  silence();
  auto& my = *impl_;
  my.path = path;
  my.storage = storage;
  my.grains = run.grains.size();
  const Properties create(H5Pcreate(H5P_FILE_CREATE));
  // Space that the library frees during a run is not reused: a kill may come before the index on
  // disk is updated.
  if (storage.compression == 0) H5Pset_file_space_strategy(create, H5F_FSPACE_STRATEGY_NONE, 0, 1);
  my.file = File(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create, H5P_DEFAULT));
  if (!my.file.valid())
    throw RunError(fmt::format("cannot create {}: {}", path, reason_of_failure()));
  my.create_metadata(run);
  my.create_grains(run.grains);

  const hsize_t n = run.grains.size();
  const std::string at = "/particles/grains/";
  const auto real = [&](const std::string& name, const std::string& unit,
                        const std::vector<hsize_t>& shape) {
    return my.create_element(name, unit, my.real_type(), H5T_NATIVE_DOUBLE, shape);
  };
  my.position = real(at + "position", "m", {n, 2});
  my.step = my.grow(at + "position/step", H5T_STD_I64LE, H5T_NATIVE_INT64, {}, scalar_chunk);
  my.time = my.grow(at + "position/time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, scalar_chunk);
  write_attribute(my.time.dataset, "unit", std::string("s"));
  my.image = my.create_element(at + "image", "", H5T_STD_I32LE, H5T_NATIVE_INT32, {n, 2});
  my.velocity = real(at + "velocity", "m s-1", {n, 2});
  my.angular_velocity = real(at + "angular_velocity", "s-1", {n});
  if (run.has_force) my.force = real(at + "force", "N", {n, 2});
  for (const auto& [name, unit] : run.observables) {
    my.observables.push_back(
        my.create_element("/observables/" + name, unit, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}));
  }
  my.create_contacts();
  my.write_parameters(run.parameters);
  my.flush();
}

TrajectoryWriter::~TrajectoryWriter() = default;
TrajectoryWriter::TrajectoryWriter(TrajectoryWriter&&) noexcept = default;

void TrajectoryWriter::append(const Frame& frame, std::span<const double> observables)
{
  auto& my = *impl_;
  assert(frame.position.size() == my.grains);
  assert(frame.force.size() == (my.force.dataset.valid() ? my.grains : 0));
  assert(observables.size() == my.observables.size());
  const auto& contacts = frame.contacts;
  if (const hsize_t rows = contacts.size(); rows > 0) {
    my.contact_i.append(rows, contacts.i.data());
    my.contact_j.append(rows, contacts.j.data());
    my.contact_force.append(rows, first(contacts.force));
    my.contact_branch.append(rows, first(contacts.branch));
    my.contact_gap.append(rows, contacts.gap.data());
  }
  my.position.append(1, first(frame.position));
  my.image.append(1, frame.image.data());
  my.velocity.append(1, first(frame.velocity));
  my.angular_velocity.append(1, frame.angular_velocity.data());
  if (my.force.dataset.valid()) my.force.append(1, first(frame.force));
  for (std::size_t k = 0; k < observables.size(); ++k) my.observables[k].append(1, &observables[k]);
  my.step.append(1, &frame.step);
  my.time.append(1, &frame.time);
  my.digest_so_far = frame_digest(frame, my.digest_so_far, my.storage.float32);
  my.digest.append(1, &my.digest_so_far);
  if (my.storage.compression == 0) my.flush();
  my.contacts_so_far += contacts.size();
  my.offset.append(1, &my.contacts_so_far);
  ++my.frames_so_far;
}

void TrajectoryWriter::flush()
{
  impl_->flush();
}

std::size_t TrajectoryWriter::frames() const
{
  return impl_->frames_so_far;
}

std::uint64_t TrajectoryWriter::digest() const
{
  return impl_->digest_so_far;
}

void TrajectoryWriter::add_parameters(const Parameters& parameters)
{
  impl_->write_parameters(parameters);
}

void TrajectoryWriter::close()
{
  auto& my = *impl_;
  my.write_parameters({{{"complete", {1}}}, {}});
  my.flush();
  const std::string path = my.path;
  File file = std::move(my.file);
  impl_ = std::make_unique<Impl>();  // closes every dataset before the file
  if (H5Fclose(file.release()) < 0)
    throw RunError(fmt::format("cannot write {}: {}", path, reason_of_failure()));
}

}  // namespace grseg
