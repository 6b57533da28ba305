// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Later versions of HDF5 keep the functions of 1.10, but under other names unless this is said.
// Every file includes <hdf5.h> through this header.
#define H5_USE_110_API
#include <hdf5.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

/// A thin layer over the HDF5 C library: identifiers close themselves, and a failure becomes one
/// sentence with the file and the path inside it.
namespace grseg::hdf5 {

/// Owns one HDF5 identifier and closes it with the call of its kind.
template <herr_t (*close)(hid_t)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept
  {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle()
  {
    if (id_ >= 0) close(id_);
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }
  /// Hands over the identifier, to close it where the result of that matters.
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// Writes what is left and closes a file; below 0 where it cannot be written. The file then stays
/// open until the program ends: HDF5 2.2 aborts when a file is closed whose data it could not
/// write.
herr_t close_file(hid_t file);

using File = Handle<close_file>;
using Group = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;  // a group or dataset
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Properties = Handle<H5Pclose>;
using Attribute = Handle<H5Aclose>;

/// Turns off the library's own error messages, its closing of files at exit, which crashes on a
/// file that could not be written (1.10.8; handles close theirs), and links that lead out of a
/// file. Whoever opens a file calls it before any other function of the library.
void silence();

/// How files are written: in the format of HDF5 1.10, whose metadata carry checksums.
Properties newest_format();

/// Settings for a new file whose root has no time of day: the same content gives the same bytes.
Properties without_time();

/// True where the file begins with HDF5's signature.
bool is_hdf5(const std::string& path);

/// Opens a file that anybody may have made, for reading: UsageError where it is missing or not a
/// regular file, FormatError where HDF5 cannot open it. A file that a running (or killed) writer
/// holds open in HDF5's SWMR mode can be read, too. `access`: further settings, changed.
File open_for_reading(const std::string& path, Properties access = Properties());

/// Text of fixed length, UTF-8.
Type string_type(std::size_t length);
/// Dataspace of a dataset or attribute of this shape; an empty shape makes a scalar.
Space space_of(const std::vector<hsize_t>& shape);

/// How a growing dataset is stored.
struct Storage {
  hsize_t chunk_rows = 1;
  int compression = 0;  // deflate level, with shuffle; 0: none
};

/// Creates a group and its parents, without the time of day, so that the same run gives the same
/// bytes. RunError on failure.
Group make_group(hid_t file, const std::string& path);

/// A dataset whose first dimension grows, `shape` being the others. RunError on failure.
Dataset create_growing(hid_t parent, const std::string& path, hid_t type,
                       const std::vector<hsize_t>& shape, const Storage& storage);
/// A dataset of fixed shape with its content; an empty `shape` makes a scalar. RunError on failure.
void write_fixed(hid_t parent, const std::string& path, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& shape, const void* data);
/// Replaces all values of a dataset of fixed shape that is there. RunError on failure.
void overwrite(hid_t parent, const std::string& path, hid_t memory_type, const void* data);
/// Grows `dataset` by `rows` rows and writes them. RunError naming `what` on failure.
void append_rows(hid_t dataset, hid_t memory_type, hsize_t rows, const void* data,
                 const std::string& what);

/// A dataset opened for reading and checked before anything is read: FormatError, naming `file` and
/// the path, unless it exists, holds usual numbers of class `kind` (H5T_INTEGER or H5T_FLOAT, or
/// H5T_STRING of fixed length), has `rank` dimensions, and uses only plain storage and the filters
/// deflate, shuffle and fletcher32. What is read must be possible for a file of this size, or it is
/// refused before memory is allocated.
class CheckedDataset {
 public:
  CheckedDataset() = default;
  CheckedDataset(hid_t parent, const std::string& path, H5T_class_t kind, int rank,
                 const std::string& file);

  const std::vector<hsize_t>& dims() const { return dims_; }
  const std::string& path() const { return path_; }
  /// With the name of the file before it.
  std::string full_path() const { return file_ + ": " + path_; }
  hid_t id() const { return dataset_; }
  bool stores_float32() const { return H5Tget_size(Type(H5Dget_type(dataset_))) == 4; }

  /// FormatError unless dimension `axis` has `size` entries (or, at_least, no fewer).
  void require(std::size_t axis, hsize_t size, bool at_least = false) const;
  /// FormatError unless `rows` rows can be in a file of this size.
  void require_possible(hsize_t rows) const;
  /// Rows [first, first + count) of the first dimension, all of the others.
  void read_rows(hid_t memory_type, hsize_t first, hsize_t count, void* data) const;
  void read_all(hid_t memory_type, void* data) const;

 private:
  [[noreturn]] void fail(const std::string& why) const;

  void check_storage();

  Dataset dataset_;
  std::vector<hsize_t> dims_;
  hsize_t row_bytes_ = 0;   // of a row, as stored
  hsize_t most_bytes_ = 0;  // that a file of this size can hold
  std::string path_, file_;
};

/// True where the type is a number that processors have: an integer of 1 to 8 bytes, or IEEE single
/// or double precision. A damaged description of a type makes other numbers of the same bytes.
bool is_usual_number(hid_t type);

/// Size of the file in which an object lies, bytes.
hsize_t size_of_file(hid_t object);

/// True where `path` leads from `parent` to something.
bool exists(hid_t parent, const std::string& path);
/// The names linked in a group, in alphabetical order.
std::vector<std::string> names_in(hid_t parent, const std::string& path);

/// Why the last call of the library failed, as the system told it ("No space left on device"),
/// where the library knows; to be asked before the next call.
std::string reason_of_failure();

}  // namespace grseg::hdf5
