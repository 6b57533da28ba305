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

/// The meanings that an option may give to columns.
struct ColumnWords {
  const char* option;   // "--columns"
  const char* example;  // of its value
  std::vector<const char*> words;
  std::vector<std::pair<const char*, std::size_t>> triples;  // of three words from one on
};

/// The meaning of each column of a row: "i=2,j=3,force=5". Columns are given by number, from 1, or
/// by name; a triple is given by the number of its first column.
class ColumnMap {
 public:
  /// UsageError where the text is not of this form, or where a word is not known.
  ColumnMap(const ColumnWords& words, const std::string& text);

  bool has(std::size_t word) const { return !column_[word].empty(); }
  /// Finds the columns among `names`. UsageError naming `place` where one is not there.
  void look_up(const std::vector<std::string>& names, const std::string& place);
  /// The columns to read, 0-based.
  const std::vector<std::size_t>& wanted() const { return wanted_; }
  /// The column of a word, where `values[k]` is column `wanted()[k]`; empty where it has none.
  const std::vector<double>& of(std::size_t word,
                                const std::vector<std::vector<double>>& values) const;
  const std::string& text() const { return text_; }

 private:
  void assign(const std::string& word, const std::string& column);

  const ColumnWords& words_;
  std::string text_;
  std::vector<std::string> column_;  // number or name; "": not given
  std::vector<int> place_;           // in wanted_; -1: not given
  std::vector<std::size_t> wanted_;
};

/// Which column of a contact row means what: "i=2,j=3,dist=4,force=5,tangential=8". Columns are
/// given by number, from 1, or by name. The meanings:
///   i, j          ids of the grains
///   force         force ON i FROM j, all of it or its normal part: three columns from this one on
///   tangential    tangential force ON i FROM j, three columns, to be added to it
///   fx fy fz, tx ty tz   single components, where there are fewer or other columns
///   dist          distance of the centres; or
///   overlap       how deep the two overlap, positive
///   bx by bz      branch x_i - x_j, else found from the positions; at a wall x_i - contact point
///   wall          number of the straight wall, negative where j is a grain; needs the branch
class ContactColumns : public ColumnMap {
 public:
  /// The text of --columns. UsageError unless it names i, j and a force.
  explicit ContactColumns(const std::string& columns);

  /// Rows as contacts; `values[k]` is column `wanted()[k]`. FormatError naming `place` where i or j
  /// is not an id.
  void fill(const std::vector<std::vector<double>>& values, const std::string& place,
            ArchiveContacts& contacts) const;

 private:
  enum Meaning { i, j, fx, fy, fz, tx, ty, tz, bx, by, bz, dist, overlap, wall };
};

/// The meaning of `fx fy fz` of contacts where other columns hold the tangential force.
enum class PlainForce { normal, whole };

/// The mapping of columns that are named by what they hold, by `dump_modify
/// colname` or a script: "id1 id2 dist fnx fny fnz ftx fty ftz". "" where two ids and a force are not
/// among the names.
std::string columns_by_name(const DumpHeader& header, PlainForce plain);

/// Names as they are compared: letters and digits alone, in lower case.
std::string compared_name(std::string_view name);

}  // namespace grseg
