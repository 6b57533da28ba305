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

/// The table of formats/README.md, by which a trajectory file is created, written, read and
/// checked.
namespace grseg {

/// Numbers of a dataset; `real` is float64, or float32 where the run is stored so.
enum class Number { i32, i64, u8, u64, f64, real };

/// HDF5 type of these numbers in a file. The type in double precision is also the one in memory.
hid_t type_of(Number number, bool float32 = false);

/// A letter of `shape` is F frames, O = F+1, N grains, C contacts, K species and the boundary, D
/// digests of a frame, d dimensions, w components of a spin (of a disc none), or 4.
struct LayoutRow {
  const char* path;
  Number type;
  std::string_view shape;
  const char* unit = "";

  /// True of a dataset that grows with the run.
  bool grows() const { return shape.find_first_of("FOC") == 0; }
};

/// In the order in which a file is made.
constexpr std::array layout{
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

/// Sizes that the letters of a shape stand for in one run.
struct LayoutSizes {
  std::size_t frames, contacts, grains, species;  // mobile species
  int dimension;
};
std::vector<hsize_t> shape_of(std::string_view letters, const LayoutSizes& sizes);

/// Row of a path, which must be in the table, or of a field of for_each_array().
const LayoutRow& row_at(std::string_view path);
const LayoutRow& row_of(Field field);

// Content that a file holds once: how it is created and read.

/// Creates the trajectory file `path` (formats/README.md) with everything that a run holds once, no
/// frame, and a seal of zeros. RunError where it cannot be written.
void create_trajectory(const std::string& path, const RunDescription& run,
                       const StorageSettings& storage);

/// Settings for files that are written `live`: everything added to a file opened with `access`
/// begins at a page of memory (4096 bytes). A kill can cut a write at the end of a page. A header
/// or a part of a chunk index that crosses one would then be half old and half new; HDF5 takes this
/// for damage, and all chunks in it would be lost, even old frames. After 8,180 chunks, that is,
/// frames, the parts of an index are longer than a page.
void keep_in_pages(hid_t access);

/// Writes one of /parameters into `file`, or replaces it. In a `live` file it must be there
/// already, with the same number of values. RunError where it cannot be written.
void write_parameter(hid_t file, const std::string& name, const std::vector<double>& values,
                     bool live);
void write_parameter(hid_t file, const std::string& name, const std::string& text);

/// Reads and checks an open trajectory file, except the contents of its frames. Throws as
/// TrajectoryReader does.
StoredRun read_stored_run(hid_t file, const std::string& path);

}  // namespace grseg
