// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/table.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

namespace grseg {
namespace {

std::string without_unit(const std::string& column)
{
  return column.substr(0, column.find('['));
}

std::vector<std::string> split(const std::string& line, char at)
{
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

std::vector<double> parse_row(const std::string& line, std::size_t columns,
                              const std::string& where)
{
  const auto cells = split(line, '\t');
  if (cells.size() != columns)
    throw FormatError(
        fmt::format("{}: {} columns, but the header names {}; is the table truncated?", where,
                    cells.size(), columns));
  std::vector<double> row;
  row.reserve(columns);
  for (const auto& cell : cells) {
    char* end = nullptr;
    row.push_back(std::strtod(cell.c_str(), &end));
    if (end == cell.c_str() || *end != '\0')
      throw FormatError(fmt::format("{}: '{}' is not a number", where, cell));
  }
  return row;
}

}  // namespace

std::string format_number(double value)
{
  return std::isnan(value) ? "nan" : fmt::format("{:.17g}", value);
}

std::size_t Table::column(const std::string& wanted) const
{
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (without_unit(columns[c]) == wanted) return c;
  throw FormatError(fmt::format("{}: no column '{}'", name, wanted));
}

bool Table::has_column(const std::string& wanted) const
{
  for (const auto& column : columns)
    if (without_unit(column) == wanted) return true;
  return false;
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
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0')
    throw FormatError(fmt::format("{}: '# {}: {}' should be a number", name, key, text));
  return value;
}

std::string Table::to_text() const
{
  std::string text;
  for (const auto& [key, value] : header) text += fmt::format("# {}: {}\n", key, value);
  text += fmt::format("{}\n", fmt::join(columns, "\t"));
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) text += '\t';
      text += format_number(row[c]);
    }
    text += '\n';
  }
  return text;
}

std::string Table::to_json() const
{
  using Json = nlohmann::ordered_json;
  Json settings = Json::object(), inputs = Json::array(), history = Json::array();
  for (const auto& [key, value] : header) {
    if (key == "input")
      inputs.push_back(value);
    else if (key == "history")
      history.push_back(value);
    else
      settings[key] = value;
  }
  const Json all{{"columns", columns},
                 {"rows", rows},
                 {"settings", settings},
                 {"inputs", inputs},
                 {"history", history}};
  return all.dump() + '\n';
}

Table Table::read(const std::string& path)
{
  if (path == "-")
    return parse(std::string(std::istreambuf_iterator<char>(std::cin), {}), "standard input");
  require_file(path);
  std::ifstream file(path, std::ios::binary);
  return parse(std::string(std::istreambuf_iterator<char>(file), {}), path);
}

Table Table::parse(const std::string& text, const std::string& name)
{
  Table table;
  table.name = name;
  if (text.empty()) throw FormatError(fmt::format("{}: is empty, not a table", name));
  if (text.starts_with("\x89HDF"))
    throw FormatError(fmt::format(
        "{}: is an HDF5 file, not a table; if it is a run, make its table with grseg-stress",
        name));
  if (text.back() != '\n')
    throw FormatError(fmt::format("{}: the last line is incomplete; the table is truncated", name));
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("# ") && table.columns.empty()) {
      const auto colon = line.find(": ");
      if (colon == std::string::npos)
        table.header.emplace_back(line.substr(2), "");
      else
        table.header.emplace_back(line.substr(2, colon - 2), line.substr(colon + 2));
    } else if (table.columns.empty()) {
      table.columns = split(line, '\t');
    } else {
      table.rows.push_back(
          parse_row(line, table.columns.size(), fmt::format("{}: line {}", name, number)));
    }
  }
  if (table.columns.empty())
    throw FormatError(fmt::format("{}: has no line of column names, so it is not a table", name));
  return table;
}

}  // namespace grseg
