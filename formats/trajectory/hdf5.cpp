// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/hdf5.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5_failure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg::hdf5 {
namespace {

template <class Owner>
Owner opened(hid_t id, const std::string& what)
{
  if (id < 0) throw RunError(fmt::format("cannot create {}: {}", what, reason_of_failure()));
  return Owner(id);
}

void check_written(herr_t status, const std::string& what)
{
  if (status < 0) throw RunError(fmt::format("cannot write {}: {}", what, reason_of_failure()));
}

Properties with_parents()
{
  Properties links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  return links;
}

}  // namespace

void silence()
{
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Space space_of(const std::vector<hsize_t>& shape)
{
  if (shape.empty()) return Space(H5Screate(H5S_SCALAR));
  return Space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
}

Type string_type(std::size_t length)
{
  Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Dataset create_growing(hid_t parent, const std::string& path, hid_t type,
                       const std::vector<hsize_t>& shape, const Storage& storage)
{
  std::vector<hsize_t> now{0}, most{H5S_UNLIMITED}, chunk{storage.chunk_rows};
  for (const auto size : shape) {
    now.push_back(size);
    most.push_back(size);
    chunk.push_back(size);
  }
  const int rank = static_cast<int>(now.size());
  const Space space(H5Screate_simple(rank, now.data(), most.data()));
  const Properties create(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_chunk(create, rank, chunk.data());
  if (storage.compression > 0) {
    H5Pset_shuffle(create);
    H5Pset_deflate(create, static_cast<unsigned>(storage.compression));
  }
  if (storage.compression > 0 || storage.checksum) H5Pset_fletcher32(create);
  H5Pset_obj_track_times(create, 0);  // the same run gives the same bytes
  return opened<Dataset>(
      H5Dcreate2(parent, path.c_str(), type, space, with_parents(), create, H5P_DEFAULT), path);
}

void write_fixed(hid_t parent, const std::string& path, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& shape, const void* data)
{
  const auto space = space_of(shape);
  const Properties create(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(create, 0);
  const auto dataset = opened<Dataset>(
      H5Dcreate2(parent, path.c_str(), file_type, space, with_parents(), create, H5P_DEFAULT),
      path);
  check_written(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path);
}

void append_rows(hid_t dataset, hid_t memory_type, hsize_t rows, const void* data,
                 const std::string& what)
{
  if (rows == 0) return;
  const Space before(H5Dget_space(dataset));
  const auto rank = static_cast<std::size_t>(H5Sget_simple_extent_ndims(before));
  std::vector<hsize_t> dims(rank);
  H5Sget_simple_extent_dims(before, dims.data(), nullptr);
  std::vector<hsize_t> start(rank, 0), count = dims;
  start[0] = dims[0];
  count[0] = rows;
  dims[0] += rows;
  check_written(H5Dset_extent(dataset, dims.data()), what);
  const Space file_space(H5Dget_space(dataset));
  H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Space memory_space(H5Screate_simple(static_cast<int>(rank), count.data(), nullptr));
  check_written(H5Dwrite(dataset, memory_type, memory_space, file_space, H5P_DEFAULT, data), what);
}

CheckedDataset::CheckedDataset(hid_t parent, const std::string& path, H5T_class_t kind, int rank,
                               const std::string& file)
    : path_(path), file_(file)
{
  if (!exists(parent, path)) fail("is missing");
  dataset_ = Dataset(H5Dopen2(parent, path.c_str(), H5P_DEFAULT));
  if (!dataset_.valid()) fail("cannot be opened");

  const Type type(H5Dget_type(dataset_));
  if (H5Tget_class(type) != kind) fail("does not hold the right kind of values");
  if (kind == H5T_STRING ? H5Tis_variable_str(type) > 0 : H5Tget_size(type) > 8)
    fail("has values of an unknown size");

  const Space space(H5Dget_space(dataset_));
  if (H5Sget_simple_extent_ndims(space) != rank)
    fail(fmt::format("should have {} dimensions", rank));
  dims_.resize(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space, dims_.data(), nullptr);

  const Properties create(H5Dget_create_plist(dataset_));
  if (H5Pget_layout(create) > H5D_CHUNKED || H5Pget_external_count(create) > 0)
    fail("is stored outside this file");
  for (int k = 0; k < H5Pget_nfilters(create); ++k) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    const auto filter = H5Pget_filter2(create, static_cast<unsigned>(k), &flags, &values, nullptr,
                                       0, nullptr, &config);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32)
      fail("uses a filter other than deflate, shuffle and fletcher32");
  }
}

void CheckedDataset::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {} {}", file_, path_, why));
}

void CheckedDataset::require(std::size_t axis, hsize_t size, bool at_least) const
{
  if (at_least ? dims_[axis] < size : dims_[axis] != size)
    fail(fmt::format("has {} entries along dimension {}, but {}{} are needed", dims_[axis], axis,
                     at_least ? "at least " : "", size));
}

void CheckedDataset::read_rows(hid_t memory_type, hsize_t first, hsize_t count, void* data) const
{
  if (count == 0) return;
  std::vector<hsize_t> start(dims_.size(), 0), extent = dims_;
  start[0] = first;
  extent[0] = count;
  const Space file_space(H5Dget_space(dataset_));
  H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  const Space memory_space(
      H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
  if (H5Dread(dataset_, memory_type, memory_space, file_space, H5P_DEFAULT, data) < 0)
    fail(fmt::format("cannot be read from row {}: the file is damaged or truncated", first));
}

void CheckedDataset::read_all(hid_t memory_type, void* data) const
{
  if (H5Dread(dataset_, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    fail("cannot be read: the file is damaged or truncated");
}

bool exists(hid_t parent, const std::string& path)
{
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    if (H5Lexists(parent, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> names_in(hid_t parent, const std::string& path)
{
  std::vector<std::string> names;
  if (!exists(parent, path)) return names;
  const Group group(H5Gopen2(parent, path.c_str(), H5P_DEFAULT));
  if (!group.valid()) return names;
  const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names);
  return names;
}

}  // namespace grseg::hdf5
