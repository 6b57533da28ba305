// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes later versions of HDF5 offer the functions of 1.10 under the names of 1.10. Every source
// file must therefore include <hdf5.h> through this header.
#define H5_USE_110_API
#include <hdf5.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

/// Thin C++ layer over the HDF5 C library: identifiers close themselves, and a failure becomes an
/// exception whose sentence names the file and the path inside it.
namespace grseg::hdf5 {

/// Owner of one HDF5 identifier, which it closes with the function `close`.
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
  /// Returns the identifier and gives up its ownership, so that the caller can check its closing.
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// Flushes and closes a file; returns a negative number if it cannot be written. The file then
/// stays open until the program ends, because HDF5 2.2 aborts on closing unwritten data.
herr_t close_file(hid_t file);

using File = Handle<close_file>;
using Group = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;  // a group or dataset
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Properties = Handle<H5Pclose>;
using Attribute = Handle<H5Aclose>;

/// Turns off three features of the library: its error messages, links to other files, and the
/// closing of files at exit, which crashes for a file that could not be written (1.10.8; handles
/// close their files). Must be called before any other function of the library.
void silence();

/// Access settings for writing files in the format of HDF5 1.10, whose metadata have checksums.
Properties newest_format();

/// Settings for a new file whose root has no creation time: the same content gives the same bytes.
Properties without_time();

/// True if the file begins with HDF5's signature.
bool is_hdf5(const std::string& path);

/// Opens an untrusted file for reading, with the further settings `access`. Throws UsageError if it
/// is missing or not a regular file, FormatError if HDF5 cannot open it. Also opens a file that a
/// running or killed writer has open in HDF5's SWMR mode (single writer, multiple readers).
File open_for_reading(const std::string& path, Properties access = Properties());

/// HDF5 type of a UTF-8 text of fixed length (bytes).
Type string_type(std::size_t length);
/// Dataspace of a dataset or attribute of this shape; an empty shape makes a scalar.
Space space_of(const std::vector<hsize_t>& shape);

/// Storage of a growing dataset.
struct Storage {
  hsize_t chunk_rows = 1;  // rows per chunk
  int compression = 0;     // deflate level, with shuffle; 0: none
};

/// Creates a group and its parents, without creation time, so that the same run gives the same
/// bytes. Throws RunError on failure.
Group make_group(hid_t file, const std::string& path);

/// Creates a dataset whose first dimension grows; `shape` lists the other dimensions. Throws
/// RunError on failure.
Dataset create_growing(hid_t parent, const std::string& path, hid_t type,
                       const std::vector<hsize_t>& shape, const Storage& storage);
/// Writes a new dataset of fixed shape (a scalar if `shape` is empty). Throws RunError on failure.
void write_fixed(hid_t parent, const std::string& path, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& shape, const void* data);
/// Replaces all values of an existing dataset of fixed shape. Throws RunError on failure.
void overwrite(hid_t parent, const std::string& path, hid_t memory_type, const void* data);
/// Extends `dataset` by `rows` rows and writes them. Throws RunError naming `what` on failure.
void append_rows(hid_t dataset, hid_t memory_type, hsize_t rows, const void* data,
                 const std::string& what);

/// A dataset that is opened for reading and checked before anything is read. All functions throw
/// FormatError, which names `file` and the path. The constructor does so unless the dataset exists,
/// contains usual numbers (is_usual_number()) of class `kind` (H5T_INTEGER or H5T_FLOAT) or texts
/// of fixed length (H5T_STRING), has `rank` dimensions, is stored in the file itself, and uses only
/// the filters deflate, shuffle and fletcher32. A size that is impossible for the size of the file
/// is refused before memory is allocated.
class CheckedDataset {
 public:
  CheckedDataset() = default;
  CheckedDataset(hid_t parent, const std::string& path, H5T_class_t kind, int rank,
                 const std::string& file);

  const std::vector<hsize_t>& dims() const { return dims_; }
  const std::string& path() const { return path_; }
  /// Path of the dataset with the name of the file before it.
  std::string full_path() const { return file_ + ": " + path_; }
  hid_t id() const { return dataset_; }
  bool stores_float32() const { return H5Tget_size(Type(H5Dget_type(dataset_))) == 4; }

  /// Throws FormatError unless dimension `axis` has `size` entries (with `at_least`: or more).
  void require(std::size_t axis, hsize_t size, bool at_least = false) const;
  /// Throws FormatError unless `rows` rows are possible in a file of this size.
  void require_possible(hsize_t rows) const;
  /// Reads rows [first, first + count) of the first dimension, with all entries of the others.
  void read_rows(hid_t memory_type, hsize_t first, hsize_t count, void* data) const;
  void read_all(hid_t memory_type, void* data) const;

 private:
  [[noreturn]] void fail(const std::string& why) const;
  /// Throws RunError if the system refused the last read, else FormatError.
  [[noreturn]] void fail_to_read(const std::string& from) const;

  void check_storage();

  Dataset dataset_;
  std::vector<hsize_t> dims_;
  hsize_t row_bytes_ = 0;   // bytes of a row, uncompressed
  hsize_t most_bytes_ = 0;  // largest possible uncompressed size in a file of this size, bytes
  std::string path_, file_;
};

/// True for number types that processors have: integers of 1, 2, 4 or 8 bytes, and IEEE single and
/// double precision. A damaged type description could turn the same bytes into other numbers.
bool is_usual_number(hid_t type);

/// Size (bytes) of the file that contains an object.
hsize_t size_of_file(hid_t object);

/// True if a link `path` exists below `parent`.
bool exists(hid_t parent, const std::string& path);
/// Names of the links in a group, in alphabetical order; none if the group does not exist.
std::vector<std::string> names_in(hid_t parent, const std::string& path);

/// Throws RunError if the system has let a call of the library fail since a file was last opened for
/// reading. Call it before something in `path` is called damaged.
void require_system(const std::string& path);

/// The system's reason why the last call of the library failed ("No space left on device"), if the
/// library knows it. Valid until the next call of the library.
std::string reason_of_failure();

}  // namespace grseg::hdf5
