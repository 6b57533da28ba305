// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// What separates the columns of a table: the first of comma, semicolon and tab that the line of its
/// names contains outside quotation marks, or blanks.
char csv_separator(std::string_view names);

/// The fields of a line. A field in quotation marks may hold separators; the marks and the blanks
/// around a field go. They are views into `line`.
void split_csv(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// Numbers as C or Fortran writes them (number_row.hpp), with a point or, where commas do not separate
/// columns, with a comma, the same in the whole table.
class CsvNumbers {
 public:
  explicit CsvNumbers(char separator = ' ') : may_have_comma_(separator != ',') {}

  /// False where `field` is not a finite number, or has the other decimal sign than those before.
  bool read(std::string_view field, double& number);
  /// What more there is to say of a field that is not read; may be "".
  const char* why_not(std::string_view field) const;

 private:
  bool may_have_comma_;
  char sign_ = 0;  // of decimals; 0: not known yet
};

}  // namespace grseg
