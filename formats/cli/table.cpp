// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/table.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <xxhash.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Appends a line of tab-separated cells to `text`, each converted by `text_of`.
template <class Cells, class Text>
void add_line(std::string& text, const Cells& cells, const Text& text_of)
{
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) text += '\t';
    text += text_of(cells[c]);
  }
  text += '\n';
}

}  // namespace

std::string without_unit(const std::string& column)
{
  return column.substr(0, column.find('['));
}

std::size_t Table::column(const std::string& wanted) const
{
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (without_unit(columns[c]) == wanted) return c;
  throw FormatError(fmt::format("{}: no column '{}'", name, wanted));
}

bool Table::has_column(const std::string& wanted) const
{
  return std::any_of(columns.begin(), columns.end(),
                     [&](const auto& column) { return without_unit(column) == wanted; });
}

bool Table::has_header(const std::string& key) const
{
  return std::any_of(header.begin(), header.end(),
                     [&](const auto& line) { return line.first == key; });
}

const std::string& Table::header_text(const std::string& key) const
{
  for (const auto& [known, value] : header)
    if (known == key) return value;
  throw FormatError(fmt::format("{}: no line '# {}: ...'", name, key));
}

double Table::header_number(const std::string& key) const
{
  const auto& text = header_text(key);
  if (const auto number = parse_number(text)) return *number;
  throw FormatError(fmt::format("{}: '# {}: {}' should be a number", name, key, excerpt(text)));
}

double Table::header_positive(const std::string& key) const
{
  const double number = header_number(key);
  if (number > 0 && std::isfinite(number)) return number;
  throw FormatError(
      fmt::format("{}: '# {}: {}' should be positive", name, key, format_number(number)));
}

std::string Table::to_text() const
{
  auto text = table_head(header, columns);
  add_rows(text, rows);
  return text + end_line(text, rows.size()) + '\n';
}

std::string Table::to_json() const
{
  using Json = nlohmann::ordered_json;
  Json all{{"columns", columns},
           {"rows", rows},
           {"settings", Json::object()},
           {"inputs", Json::array()},
           {"history", Json::array()}};
  for (const auto& [key, value] : header) {
    if (key == "input")
      all["inputs"].push_back(printable(value));
    else if (key == "history" || key == "bed" || key == "verified" || key == "incomplete" ||
             key == "undecided" || key == "waived" || key == "doubt")
      all[key].push_back(printable(value));
    else
      all["settings"][key] = printable(value);
  }
  return all.dump() + '\n';
}

std::string table_text(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows)
{
  auto text = table_head(header, columns);
  for (const auto& row : rows) add_line(text, row, printable);
  return text + end_line(text, rows.size()) + '\n';
}

std::string table_head(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns)
{
  std::string text;
  for (const auto& [key, value] : header)
    text += fmt::format("# {}: {}\n", printable(key), printable(value));
  add_line(text, columns, printable);
  return text;
}

void add_rows(std::string& text, const std::vector<std::vector<double>>& rows)
{
  for (const auto& row : rows) add_line(text, row, format_number);
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

}  // namespace grseg
