// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/dump_reader.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grseg {

/// The words by which an option assigns meanings to columns.
struct ColumnWords {
  const char* option;   // name of the option: "--columns"
  const char* example;  // example of its value
  std::vector<const char*> words;
  std::vector<std::pair<const char*, std::size_t>> triples;  // word; index of its 1st component
};

/// The mapping from meanings to columns, "i=2,j=3,force=5". A column is its number, from 1, or its
/// name; a triple (three components) is the number of its first column.
class ColumnMap {
 public:
  /// Throws UsageError if the text does not have this form, or if a word is unknown.
  ColumnMap(const ColumnWords& words, const std::string& text);

  bool has(std::size_t word) const { return !column_[word].empty(); }
  /// Finds the columns among `names`. Throws UsageError naming `place` if one is missing.
  void look_up(const std::vector<std::string>& names, const std::string& place);
  /// The numbers of the columns to read, from 0.
  const std::vector<std::size_t>& wanted() const { return wanted_; }
  /// The values of a word's column, empty if it has none; `values[k]` is column `wanted()[k]`.
  const std::vector<double>& of(std::size_t word,
                                const std::vector<std::vector<double>>& values) const;
  const std::string& text() const { return text_; }

 private:
  void assign(const std::string& word, const std::string& column);

  const ColumnWords& words_;
  std::string text_;
  std::vector<std::string> column_;  // number or name of each word's column; "": not assigned
  std::vector<int> place_;           // index in wanted_ of each word's column; -1: not assigned
  std::vector<std::size_t> wanted_;
};

/// The mapping for rows of contacts: "i=2,j=3,dist=4,force=5,tangential=8". A column is its number,
/// from 1, or its name. The meanings:
///   i, j          ids of the grains
///   force         force ON i FROM j, total or normal part: first of three columns
///   tangential    tangential force ON i FROM j, added to `force`: first of three columns
///   fx fy fz, tx ty tz   single components, if there are fewer or separate columns
///   dist          distance of the centres, or alternatively
///   overlap       depth of the overlap, positive
///   bx by bz      branch x_i - x_j (default: from the positions); at a wall x_i - contact point
///   wall          number of the straight wall, negative if j is a grain; needs the branch
class ContactColumns : public ColumnMap {
 public:
  /// `columns` is the value of --columns. Throws UsageError unless it names i, j and a force.
  explicit ContactColumns(const std::string& columns);

  /// Converts rows to contacts; `values[k]` is column `wanted()[k]`. Throws FormatError naming
  /// `place` if i or j is not an id.
  void fill(const std::vector<std::vector<double>>& values, const std::string& place,
            ArchiveContacts& contacts) const;

 private:
  enum Meaning { i, j, fx, fy, fz, tx, ty, tz, bx, by, bz, dist, overlap, wall };
};

/// The meaning of columns fx fy fz if there are other columns with the tangential force.
enum class PlainForce { normal, whole };

/// The mapping for columns with meaningful names (by `dump_modify colname` or a script), such as
/// "id1 id2 dist fnx fny fnz ftx fty ftz". "" unless two ids and a force are among the names.
std::string columns_by_name(const DumpHeader& header, PlainForce plain);

/// A column name prepared for comparison: its letters and digits, in lower case.
std::string compared_name(std::string_view name);

}  // namespace grseg
