// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

/// The one place where the HDF5 C library is touched: identifiers close themselves, failures become
/// one sentence with the file and the path inside it, the library's own printing is off.
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
  /// Gives the identifier up, for a close whose result matters.
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;  // a group or dataset
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Properties = Handle<H5Pclose>;
using Attribute = Handle<H5Aclose>;

/// Turns the library's printing of its error stack off, and its closing of files at exit, which
/// crashes on a file that could not be written (1.10.8): handles close theirs. To be called before
/// anything else of the library, by everything that opens files.
void silence();

/// "string[length]" of fixed length, UTF-8.
Type string_type(std::size_t length);

void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);
void write_attribute(hid_t object, const std::string& name, const std::vector<int>& values);

/// The texts (at most 3 of at most 64 bytes) or integers (at most 3) of an attribute; empty where
/// there is none, or one of another kind.
std::vector<std::string> read_texts(hid_t object, const std::string& name);
std::vector<int> read_integers(hid_t object, const std::string& name);

/// How a growing dataset is stored.
struct Storage {
  hsize_t chunk_rows = 1;
  int compression = 0;    // deflate level, with shuffle and fletcher32; 0: none
  bool checksum = false;  // fletcher32 also without compression
};

/// A dataset whose first dimension grows, `shape` being the others. RunError on failure.
Dataset create_growing(hid_t parent, const std::string& path, hid_t type,
                       const std::vector<hsize_t>& shape, const Storage& storage);
/// A dataset of fixed shape with its content; an empty `shape` makes a scalar. RunError on failure.
void write_fixed(hid_t parent, const std::string& path, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& shape, const void* data);
/// Grows `dataset` by `rows` rows and writes them. RunError naming `what` on failure.
void append_rows(hid_t dataset, hid_t memory_type, hsize_t rows, const void* data,
                 const std::string& what);

/// A dataset opened for reading, looked at before anything is read: FormatError, naming `file` and
/// the path, unless it exists, holds numbers of class `kind` (H5T_INTEGER or H5T_FLOAT) of at most
/// 8 bytes (or H5T_STRING of fixed length), has `rank` dimensions, and uses only plain storage and
/// the filters deflate, shuffle and fletcher32.
class CheckedDataset {
 public:
  CheckedDataset() = default;
  CheckedDataset(hid_t parent, const std::string& path, H5T_class_t kind, int rank,
                 const std::string& file);

  const std::vector<hsize_t>& dims() const { return dims_; }
  const std::string& path() const { return path_; }
  hid_t id() const { return dataset_; }
  bool stores_float32() const { return H5Tget_size(Type(H5Dget_type(dataset_))) == 4; }

  /// FormatError unless dimension `axis` has `size` entries (or, at_least, no fewer).
  void require(std::size_t axis, hsize_t size, bool at_least = false) const;
  /// Rows [first, first + count) of the first dimension, all of the others.
  void read_rows(hid_t memory_type, hsize_t first, hsize_t count, void* data) const;
  void read_all(hid_t memory_type, void* data) const;

 private:
  [[noreturn]] void fail(const std::string& why) const;

  Dataset dataset_;
  std::vector<hsize_t> dims_;
  std::string path_, file_;
};

bool exists(hid_t parent, const std::string& path);
/// What the attribute `name` of the object at `path` holds; empty where there is none. FormatError
/// naming `file` where it holds something else, or more of it than a description of a body does.
std::vector<double> numbers_in_attribute(hid_t parent, const std::string& path,
                                         const std::string& name, const std::string& file);
std::string text_in_attribute(hid_t parent, const std::string& path, const std::string& name,
                              const std::string& file);
/// The names linked in a group, in alphabetical order.
std::vector<std::string> names_in(hid_t parent, const std::string& path);

}  // namespace grseg::hdf5
