// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Names as they are compared: in lower case, without blanks and quotation marks.
std::string bare_name(std::string_view text);

/// The name without a unit in brackets: " Radius [m]" and "radius(m)" are radius.
std::string plain_name(std::string_view text);

/// The parts of --map for the columns of one of the two plain tables: "particle1=i,Fx=fx" gives
/// columns other names, "fx=" has one left out. "2=x" names a column by its number, from 1; a list
/// of such parts holds for the table that its names belong to. "row=id" takes the number of a row
/// at its moment for an id, from 0, and "row+1=id" from 1.
class CsvMap {
 public:
  /// `known` are the names that columns of this table may have, `elsewhere` the names in the other
  /// table. UsageError where a part is not NAME=COLUMN, or COLUMN is none of either.
  CsvMap(const std::vector<std::string>& given, const std::vector<std::string>& known,
         const std::vector<std::string>& elsewhere);

  /// The names by which the columns of a table are known; "" for one that is left out. A name that
  /// --map gives to a column is taken away from a column that has it of its own.
  std::vector<std::string> renamed(const std::vector<std::string>& header);
  /// The number of the first row, where the table has no column `id` and rows are to be ids.
  std::optional<std::int64_t> first_row();

  /// UsageError naming a column that neither table has had.
  void require_all_used(const CsvMap& other) const;

 private:
  struct Part {
    std::string name, column;  // bare
    std::string as_given;
    std::size_t number = 0;  // of the column; 0: by name
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
