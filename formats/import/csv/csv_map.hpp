// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Names as they are compared: in lower case, without blanks and quotation marks.
std::string bare_name(std::string_view text);

/// The same without a unit in brackets: " Radius [m]" and "radius(m)" are radius.
std::string plain_name(std::string_view text);

/// What --map says of the columns of plain tables: "particle1=i,Fx=fx" gives columns other names,
/// "fx=" has one left out.
class CsvMap {
 public:
  /// UsageError where a part is not NAME=COLUMN, or COLUMN is none of `known`.
  CsvMap(const std::vector<std::string>& given, const std::vector<std::string>& known);

  /// The names by which the columns of a table are known; "" for one that is left out. A name that
  /// --map gives to a column is taken away from a column that has it of its own.
  std::vector<std::string> renamed(const std::vector<std::string>& header);

  /// UsageError naming a column that no table has had.
  void require_all_used() const;

 private:
  std::map<std::string, std::string> names_;  // bare names of columns: what they are called
  std::map<std::string, std::string> as_given_;
  std::set<std::string> used_;
};

}  // namespace grseg
