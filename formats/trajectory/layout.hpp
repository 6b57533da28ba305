// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/run_description.hpp"
#include "formats/trajectory/writer.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The table of datasets in formats/README.md, from which trajectory files are created, written,
/// read and checked.
namespace grseg {

/// Number type of a dataset; `real` is float64 or, in a run stored in single precision, float32.
enum class Number { i32, i64, u8, u64, f64, real };

/// HDF5 type of a number in a file. Without `float32` it is also the type in memory.
hid_t type_of(Number number, bool float32 = false);

/// A dataset. Each letter of `shape` is the size of a dimension: F frames, O = F+1, N grains, C
/// contacts, K species and the boundary, D digests of a frame, d dimensions of space, w components
/// of a spin (no dimension for discs), or 4.
struct LayoutRow {
  const char* path;
  Number type;
  std::string_view shape;
  const char* unit = "";

  /// True for a dataset that grows with the run.
  bool grows() const { return shape.find_first_of("FOC") == 0; }
};

/// All datasets, in the order in which they are created.
inline constexpr std::array layout{
    LayoutRow{"/particles/grains/box/edges", Number::f64, "d"},
    LayoutRow{"/particles/grains/id", Number::i32, "N"},
    LayoutRow{"/particles/grains/species", Number::i32, "N"},
    LayoutRow{"/particles/grains/radius", Number::f64, "N"},
    LayoutRow{"/particles/grains/mass", Number::f64, "N"},
    LayoutRow{"/particles/grains/fixed", Number::u8, "N"},
    LayoutRow{"/grseg/species/diameter", Number::f64, "K"},
    LayoutRow{"/grseg/species/mobile", Number::u8, "K"},
    LayoutRow{"/particles/grains/position/value", Number::real, "FNd", "m"},
    LayoutRow{"/particles/grains/position/step", Number::i64, "F"},
    LayoutRow{"/particles/grains/position/time", Number::f64, "F", "s"},
    LayoutRow{"/particles/grains/image/value", Number::i32, "FNd"},
    LayoutRow{"/particles/grains/velocity/value", Number::real, "FNd", "m s-1"},
    LayoutRow{"/particles/grains/angular_velocity/value", Number::real, "FNw", "s-1"},
    LayoutRow{"/particles/grains/force/value", Number::real, "FNd", "N"},
    LayoutRow{"/grseg/contacts/i", Number::i32, "C"},
    LayoutRow{"/grseg/contacts/j", Number::i32, "C"},
    LayoutRow{"/grseg/contacts/force", Number::real, "Cd", "N"},
    LayoutRow{"/grseg/contacts/branch", Number::real, "Cd", "m"},
    LayoutRow{"/grseg/contacts/gap", Number::real, "C", "m"},
    LayoutRow{"/grseg/contacts/offset", Number::u64, "O"},
    LayoutRow{"/grseg/digest", Number::u64, "F"},
    LayoutRow{"/grseg/field_digest", Number::u64, "FD"},
    LayoutRow{"/grseg/static_digest", Number::u64, ""},
    LayoutRow{"/grseg/seal", Number::u64, "4"},
};

/// Values of the letters of a shape in one run.
struct LayoutSizes {
  std::size_t frames, contacts, grains, species;  // counts; species: number of mobile ones
  int dimension;
};
std::vector<hsize_t> shape_of(std::string_view letters, const LayoutSizes& sizes);

/// Row of the table for a path, which must be in the table, or for a field of for_each_array().
const LayoutRow& row_at(std::string_view path);
const LayoutRow& row_of(Field field);

// Functions that create and read the content of a file outside frames.

/// Creates the trajectory file `path` (formats/README.md) with all content of `run`, no frame, and
/// a seal of zeros. Throws RunError if the file cannot be written.
void create_trajectory(const std::string& path, const RunDescription& run,
                       const StorageSettings& storage);

/// Setting for files that are written `live` (StorageSettings): everything that is added to a file
/// opened with `access` begins at a memory page (4096 bytes). A kill can cut a write at the end of
/// a page. A header or a part of a chunk index across a page boundary would then be half old and
/// half new. HDF5 treats this as damage, and all chunks in that index part would be lost, even old
/// frames. From 8,180 chunks (frames) on, parts of an index are longer than a page.
void keep_in_pages(hid_t access);

/// Bytes of a file that is written `live`, before it is compressed.
double size_of_live_file(const LayoutSizes& run, std::size_t observables, bool float32);

/// Writes or replaces a parameter (in /parameters). In a `live` file it must already exist with the
/// same number of values. Throws RunError if it cannot be written.
void write_parameter(hid_t file, const std::string& name, const std::vector<double>& values,
                     bool live);
void write_parameter(hid_t file, const std::string& name, const std::string& text);

/// Reads and checks an open trajectory file, except the content of its frames. Throws the same
/// errors as TrajectoryReader.
StoredRun read_stored_run(hid_t file, const std::string& path);

}  // namespace grseg
