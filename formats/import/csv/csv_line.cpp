// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_line.hpp"

#include "formats/import/common/number_row.hpp"

#include <algorithm>

namespace grseg {
namespace {

constexpr std::string_view blanks = " \t";

std::string_view without_blanks(std::string_view text)
{
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// The first `separator` from `at` on that is not in quotation marks, or the end.
std::size_t end_of_field(std::string_view line, std::size_t at, char separator)
{
  bool quoted = false;
  for (; at < line.size(); ++at) {
    if (line[at] == '"') quoted = !quoted;
    const bool between = line[at] == separator || (separator == ' ' && line[at] == '\t');
    if (between && !quoted) return at;
  }
  return line.size();
}

}  // namespace

char csv_separator(std::string_view names)
{
  for (const char c : {',', ';', '\t'})
    if (end_of_field(names, 0, c) < names.size()) return c;
  return ' ';
}

void split_csv(std::string_view line, char separator, std::vector<std::string_view>& fields)
{
  fields.clear();
  for (std::size_t at = 0; at < line.size();) {
    const auto end = end_of_field(line, at, separator);
    const auto field = without_blanks(line.substr(at, end - at));
    if (separator != ' ' || end > at) fields.push_back(field);
    at = end + 1;
    if (at == line.size() && separator != ' ') fields.push_back(line.substr(at));
  }
}

bool CsvNumbers::read(std::string_view field, double& number)
{
  const auto comma = may_have_comma_ ? field.find(',') : std::string_view::npos;
  const bool has_comma = comma != std::string_view::npos, has_point = field.find('.') != field.npos;
  const char sign = has_comma ? ',' : has_point ? '.' : sign_;
  if ((has_comma && has_point) || (sign_ != 0 && sign != sign_)) return false;
  char text[64];
  if (has_comma) {
    if (field.size() > sizeof text) return false;
    std::copy(field.begin(), field.end(), text);
    text[comma] = '.';
    field = {text, field.size()};
  }
  const bool is_number = read_number(field, number);
  if (is_number) sign_ = sign;
  return is_number;
}

const char* CsvNumbers::why_not(std::string_view field) const
{
  const bool other = field.find(sign_ == ',' ? '.' : ',') != std::string_view::npos;
  return may_have_comma_ && sign_ != 0 && other
             ? "; numbers have a decimal point or a decimal comma, the same in the whole table"
             : "";
}

}  // namespace grseg
