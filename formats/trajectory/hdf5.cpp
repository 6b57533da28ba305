// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/hdf5.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

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

// Largest accepted ratio of uncompressed to stored size (deflate reaches at most 1032 : 1), and the
// uncompressed size below which any ratio is accepted.
constexpr hsize_t most_packing = 1100;
constexpr hsize_t small = 16 << 20;  // bytes

// Largest number of attempts to read a structure whose checksum is wrong: a writer may be about to
// complete it. HDF5 waits 1 ns after the first attempt and doubles the wait each time: 17 ms in
// all. With its default of 100 attempts HDF5 would wait for ever if the structure is damaged.
constexpr unsigned most_attempts = 24;

/// Creates all groups above `path`.
void make_parents(hid_t file, const std::string& path)
{
  const auto slash = path.rfind('/');
  if (slash != std::string::npos && slash > 0) make_group(file, path.substr(0, slash));
}

/// Marks of a writer in the superblock (HDF5 File Format Specification, II.A): one has the file open,
/// perhaps in SWMR mode, or was killed in that state.
struct Writer {
  bool any = false, swmr = false;
};

Writer writer_of(const std::string& path)
{
  constexpr char signature[] = "\x89HDF\r\n\x1a\n";
  constexpr std::size_t version = 8, flags = 11;
  constexpr char write_access = 1, swmr_access = 4;
  char bytes[12] = {};
  std::ifstream(path, std::ios::binary).read(bytes, sizeof bytes);
  if (!std::equal(signature, signature + 8, bytes) || bytes[version] != 3) return {};
  const bool any = (bytes[flags] & write_access) != 0;
  return {any, any && (bytes[flags] & swmr_access) != 0};
}

/// Finds the errno in an entry of HDF5's error stack, which contains it only as part of a text. EINVAL
/// is none of the system's troubles: the file names an impossible place.
herr_t find_errno(unsigned, const H5E_error2_t* entry, void* found)
{
  const char* place = entry->desc == nullptr ? nullptr : std::strstr(entry->desc, "errno = ");
  int error = 0;
  if (place != nullptr && std::sscanf(place, "errno = %d", &error) == 1 && error != 0 &&
      error != EINVAL)
    *static_cast<int*>(found) = error;
  return 0;
}

int last_system_error = 0;  // errno of the last call that the system let fail since an opening

herr_t remember_errno(hid_t stack, void*)
{
  return H5Ewalk2(stack, H5E_WALK_UPWARD, find_errno, &last_system_error);
}

/// The system's error by which the last call of the library failed; 0: it failed for another reason.
int error_of_failure()
{
  int error = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_errno, &error);
  return error;
}

/// Throws the reason why HDF5 does not open a file, after its last call.
[[noreturn]] void refuse(const std::string& path, Writer writer)
{
  const int error = error_of_failure();
  if (error != 0 && error != EWOULDBLOCK)
    throw RunError(fmt::format("{}: cannot be opened: {}", path, reason(error)));
  const char* why = "is not an HDF5 file, or is truncated or damaged";
  if (error == EWOULDBLOCK)
    why = "is being written by a run; wait until the run has ended, or read a copy";
  else if (writer.any && !writer.swmr)
    why = "is being written, or its writer was killed; wait until it has ended, or write it again";
  const auto kind = kind_of_file(path);
  last_system_error = 0;  // none of the system's
  throw FormatError(fmt::format("{}: {}", path, kind.instead_of("a run (HDF5)", why)));
}

/// The product of two numbers; the largest number if the product overflows.
hsize_t product(hsize_t a, hsize_t b)
{
  constexpr auto most = std::numeric_limits<hsize_t>::max();
  return a > 0 && b > most / a ? most : a * b;
}

}  // namespace

void silence()
{
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, remember_errno, nullptr);  // prints nothing
  H5Lunregister(H5L_TYPE_EXTERNAL);
  H5Pset_obj_track_times(H5P_GROUP_CREATE_DEFAULT, 0);
}

Properties newest_format()
{
  silence();
  Properties access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_file_locking(access, false, true);  // writers have an OutputLock, or a name of their own
  return access;
}

herr_t close_file(hid_t file)
{
  return H5Fflush(file, H5F_SCOPE_LOCAL) < 0 ? -1 : H5Fclose(file);
}

Properties without_time()
{
  Properties create(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_obj_track_times(create, 0);
  return create;
}

bool is_hdf5(const std::string& path)
{
  silence();
  return H5Fis_hdf5(path.c_str()) > 0;
}

File open_for_reading(const std::string& path, Properties access)
{
  silence();
  require_seekable(path);
  if (!access.valid()) access = Properties(H5Pcreate(H5P_FILE_ACCESS));
  const auto writer = writer_of(path);
  if (writer.swmr) H5Pset_metadata_read_attempts(access, most_attempts);
  const unsigned mode = H5F_ACC_RDONLY | (writer.swmr ? H5F_ACC_SWMR_READ : 0U);
  File file(H5Fopen(path.c_str(), mode, access));
  if (!file.valid() && error_of_failure() != EWOULDBLOCK) {
    // Many file systems of clusters have no locks. Only other programs' writers need one.
    H5Pset_file_locking(access, false, true);
    file = File(H5Fopen(path.c_str(), mode, access));
  }
  if (!file.valid()) refuse(path, writer);
  last_system_error = 0;
  return file;
}

Group make_group(hid_t file, const std::string& path)
{
  const Properties create(H5Pcreate(H5P_GROUP_CREATE));
  H5Pset_obj_track_times(create, 0);
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const auto name = path.substr(0, slash);
    Group group(exists(file, name)
                    ? H5Gopen2(file, name.c_str(), H5P_DEFAULT)
                    : H5Gcreate2(file, name.c_str(), H5P_DEFAULT, create, H5P_DEFAULT));
    if (slash == std::string::npos || !group.valid()) return opened<Group>(group.release(), path);
  }
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
  H5Pset_obj_track_times(create, 0);  // no creation time: the same run gives the same bytes
  make_parents(parent, path);
  return opened<Dataset>(
      H5Dcreate2(parent, path.c_str(), type, space, H5P_DEFAULT, create, H5P_DEFAULT), path);
}

void write_fixed(hid_t parent, const std::string& path, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& shape, const void* data)
{
  const auto space = space_of(shape);
  const Properties create(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(create, 0);
  make_parents(parent, path);
  const auto dataset = opened<Dataset>(
      H5Dcreate2(parent, path.c_str(), file_type, space, H5P_DEFAULT, create, H5P_DEFAULT), path);
  check_written(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path);
}

void overwrite(hid_t parent, const std::string& path, hid_t memory_type, const void* data)
{
  const auto dataset = opened<Dataset>(H5Dopen2(parent, path.c_str(), H5P_DEFAULT), path);
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
  if (!dataset_.valid()) fail("cannot be opened: it is damaged, or a link out of the file");

  check_storage();
  const Type type(H5Dget_type(dataset_));
  if (H5Tget_class(type) != kind)
    fail("does not contain the right kind of values: the file is damaged, or of another kind");
  if (kind == H5T_STRING ? H5Tis_variable_str(type) > 0 : !is_usual_number(type))
    fail("has values of a type that grseg does not read; is the file damaged?");

  const Space space(H5Dget_space(dataset_));
  if (H5Sget_simple_extent_ndims(space) != rank)
    fail(fmt::format("should have {} dimensions", rank));
  dims_.resize(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space, dims_.data(), nullptr);
  row_bytes_ = H5Tget_size(type);
  for (std::size_t k = 1; k < dims_.size(); ++k) row_bytes_ = product(row_bytes_, dims_[k]);
  require_possible(rank == 0 ? 1 : std::min<hsize_t>(dims_[0], 1));
}

/// Checks storage and filters. Must come before all other checks, because any access to a virtual
/// dataset would open other files.
void CheckedDataset::check_storage()
{
  const Properties create(H5Dget_create_plist(dataset_));
  if (H5Pget_layout(create) > H5D_CHUNKED || H5Pget_external_count(create) > 0)
    fail("is stored outside this file");
  const int filters = H5Pget_nfilters(create);
  most_bytes_ = std::max(product(size_of_file(dataset_), filters > 0 ? most_packing : 1), small);
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    const auto filter = H5Pget_filter2(create, static_cast<unsigned>(k), &flags, &values, nullptr,
                                       0, nullptr, &config);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32)
      fail("uses a filter other than deflate, shuffle and fletcher32");
  }
  if (H5Pget_layout(create) != H5D_CHUNKED) return;
  hsize_t chunk[H5S_MAX_RANK] = {};
  const int rank = H5Pget_chunk(create, H5S_MAX_RANK, chunk);
  hsize_t bytes = H5Tget_size(Type(H5Dget_type(dataset_)));
  for (int k = 0; k < rank; ++k) bytes = product(bytes, chunk[k]);
  if (rank < 0 || bytes > most_bytes_) fail("has chunks that are larger than the file");
}

void CheckedDataset::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{} {}", full_path(), why));
}

void CheckedDataset::fail_to_read(const std::string& from) const
{
  require_system(full_path());
  fail(fmt::format("cannot be read{}: the file is damaged or truncated", from));
}

void CheckedDataset::require(std::size_t axis, hsize_t size, bool at_least) const
{
  if (at_least ? dims_[axis] < size : dims_[axis] != size)
    fail(fmt::format("has {} entries along dimension {}, but {}{} are needed", dims_[axis], axis,
                     at_least ? "at least " : "", size));
  if (axis == 0) require_possible(size);
}

void CheckedDataset::require_possible(hsize_t rows) const
{
  if (product(rows, row_bytes_) > most_bytes_)
    fail("claims to hold more than a file of this size can; the file is damaged");
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
    fail_to_read(fmt::format(" from row {}", first));
}

void CheckedDataset::read_all(hid_t memory_type, void* data) const
{
  if (H5Dread(dataset_, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail_to_read("");
}

bool is_usual_number(hid_t type)
{
  const auto bytes = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_INTEGER)
    return bytes <= 8 && std::has_single_bit(bytes) && H5Tget_precision(type) == 8 * bytes;
  const hid_t floats[] = {H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_IEEE_F64LE, H5T_IEEE_F64BE};
  return std::any_of(std::begin(floats), std::end(floats),
                     [type](hid_t known) { return H5Tequal(type, known) > 0; });
}

hsize_t size_of_file(hid_t object)
{
  hsize_t bytes = 0;
  const File file(H5Iget_file_id(object));
  H5Fget_filesize(file, &bytes);
  return bytes;
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
  // H5_ITER_NATIVE, sorted afterwards: to visit links in order, HDF5 1.10 first makes a list of
  // them, and if the file is damaged it frees entries of the list that it has not filled.
  H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, visit, &names);
  std::sort(names.begin(), names.end());
  return names;
}

void require_system(const std::string& path)
{
  if (last_system_error != 0)
    throw RunError(fmt::format("{}: cannot be read: {}", path, reason(last_system_error)));
}

std::string reason_of_failure()
{
  const int error = error_of_failure();
  return error != 0 ? reason(error) : "the HDF5 library does not say why";
}

}  // namespace grseg::hdf5
