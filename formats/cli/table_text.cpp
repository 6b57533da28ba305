// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/table_text.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>

namespace grseg {
namespace {

void add_line(std::string& text, const std::vector<std::string>& cells)
{
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) text += '\t';
    text += printable(cells[c]);
  }
  text += '\n';
}

}  // namespace

std::string table_text(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows)
{
  auto text = table_head(header, columns);
  for (const auto& row : rows) add_line(text, row);
  return text + end_line(text, rows.size()) + '\n';
}

std::string table_head(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns)
{
  std::string text;
  for (const auto& [key, value] : header)
    text += fmt::format("# {}: {}\n", printable(key), printable(value));
  add_line(text, columns);
  return text;
}

void add_rows(std::string& text, const std::vector<std::vector<double>>& rows)
{
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) text += '\t';
      text += format_number(row[c]);
    }
    text += '\n';
  }
}

std::string end_line(std::string_view before, std::size_t rows)
{
  return end_line(rows, XXH3_64bits(before.data(), before.size()));
}

std::string end_line(std::size_t rows, std::uint64_t digest_before)
{
  return fmt::format("{}{} rows, xxh3 {:016x}", end_mark, rows, digest_before);
}

std::string format_number(double value)
{
  return std::isnan(value) ? "nan" : fmt::format("{:.17g}", value);
}

std::vector<std::string> format_numbers(const std::vector<double>& values)
{
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(format_number(value));
  return texts;
}

}  // namespace grseg
