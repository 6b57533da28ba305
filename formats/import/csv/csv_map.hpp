// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// A column name prepared for comparison: in lower case, without blanks and quotation marks.
std::string bare_name(std::string_view text);

/// The name without a unit in brackets: " Radius [m]" and "radius(m)" are radius.
std::string plain_name(std::string_view text);

/// The parts of --map that apply to the columns of one of the two plain tables (grains, contacts).
/// "particle1=i,Fx=fx" renames columns, "fx=" leaves a column out. "2=x" names a column by its
/// number, from 1; a list of such parts applies to the table that has these names. "row=id" sets
/// the id to the number of the row in its frame, from 0; "row+1=id" counts from 1.
class CsvMap {
 public:
  /// `known` are the possible names of columns in this table, `elsewhere` in the other table.
  /// Throws UsageError if a part is not NAME=COLUMN, or if neither table has a column COLUMN.
  CsvMap(const std::vector<std::string>& given, const std::vector<std::string>& known,
         const std::vector<std::string>& elsewhere);

  /// The names of a table's columns after renaming; "" for a column that is left out. If --map
  /// assigns a name to one column, another column with this name in the header is left out.
  std::vector<std::string> renamed(const std::vector<std::string>& header);
  /// Number of a frame's first row (0 or 1) if --map sets ids to row numbers; otherwise empty.
  std::optional<std::int64_t> first_row();

  /// Throws UsageError if a part of --map names a column that neither table has.
  void require_all_used(const CsvMap& other) const;

 private:
  struct Part {
    std::string name, column;  // NAME and COLUMN of the part, as bare_name()
    std::string as_given;
    std::size_t number = 0;  // number of the column, from 1; 0: the column is found by its name
    bool used = false;
  };
  void add_list(const std::string& list);
  bool is_of_the_other_table(const std::vector<Part>& list) const;
  template <class IsIt>
  const Part* last_that(const IsIt& is_it);
  const Part* part_of(const std::string& name, std::size_t number);

  std::vector<std::string> known_, elsewhere_;
  std::vector<Part> parts_;
};

}  // namespace grseg
