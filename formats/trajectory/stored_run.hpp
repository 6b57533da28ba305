// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/row_reader.hpp"
#include "formats/trajectory/run_description.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// An open trajectory file: what it holds once, read and checked, and its growing datasets, whose
/// types and shapes have been checked. Throws as TrajectoryReader does.
struct StoredRun {
  explicit StoredRun(const std::string& path);

  std::string path;
  hdf5::File file;
  RunDescription run;
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<std::uint64_t> offset;
  std::vector<std::uint64_t> chain;         // /grseg/digest
  std::vector<FieldDigests> field_digests;  // none in files of version 1.0
  int minor_version = 0;                    // of the module grseg: 1.1 or later has field digests
  RowReader position, image, velocity, angular_velocity, force;
  RowReader contact_i, contact_j, contact_force, contact_branch, contact_gap;

  /// FormatError naming the file.
  [[noreturn]] void fail(const std::string& why) const;

  /// The dataset at a path of the file.
  hdf5::CheckedDataset open(const std::string& at, H5T_class_t kind, int rank) const
  {
    return {file, at, kind, rank, path};
  }

  /// Committed frames.
  std::size_t size() const { return offset.size() - 1; }
  bool has_field_digests() const { return minor_version >= 1; }
  /// Forgets the last frame.
  void drop_last();
  /// Whether numbers of grains and contacts are stored in single precision.
  bool stores_float32() const { return position.stores_float32(); }
  int dimension() const { return run.box.dimension; }
  /// A row of a dataset with one vector, or one number, per grain. What is compressed is appended to
  /// `packed`.
  template <class T>
  void load_row(const RowReader& rows, hsize_t row, std::vector<T>& out,
                std::vector<PackedRows>& packed) const;
  template <int D>
  void load_contacts(std::size_t frame, ContactList<D>& contacts,
                     std::vector<PackedRows>& packed) const;
  /// FormatError where the numbers of a frame that has been read are not finite (of an absent grain:
  /// not NaN throughout), or its contacts join no grains or absent ones.
  template <int D>
  void check(std::size_t index, const Frame<D>& frame) const;
  /// The values of an observable in all committed frames.
  std::vector<double> read_observable(const std::string& name) const;

 private:
  /// FormatError naming `what` and `frame` where one of the values is not finite.
  void check_finite(const double* values, std::size_t count, const std::string& what,
                    std::size_t frame) const;
  template <int D>
  void check_presence(std::size_t index, const Frame<D>& frame) const;
  template <int D>
  void check_contacts(std::size_t index, const ContactList<D>& contacts) const;
  std::vector<int> require_version(const std::string& module) const;
  void read_offset();
  void read_box();
  void read_species();
  void read_grains();
  void read_times();
  void read_digests();
  void read_parameters();
  void read_parameter(const std::string& name);
  void read_observables();

  /// A property of the grains that is the same in all frames.
  template <class T>
  std::vector<T> constant(const std::string& name, H5T_class_t kind, hid_t type,
                          hsize_t count) const;
  /// A property of the grains with a row per frame.
  RowReader element(const std::string& name, H5T_class_t kind, int rank) const;
  /// A property of the contacts of all frames.
  RowReader rows(const std::string& name, H5T_class_t kind, int rank) const;
};

}  // namespace grseg
