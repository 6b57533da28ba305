// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
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

/// Which column of a row means what: "i=2,j=3,force=5". Columns are given by number, from 1, or by
/// name; that of a triple is the number of the first of three.
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

}  // namespace grseg
