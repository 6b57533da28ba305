// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_table.hpp"

#include "formats/import/common/archive.hpp"
#include "formats/import/common/number_row.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace grseg {
namespace {

std::vector<std::string> split(std::string_view text, char separator)
{
  std::vector<std::string> parts(1);
  for (const char c : text) {
    const bool between = c == separator || (separator == ' ' && c == '\t');
    if (!between)
      parts.back() += c;
    else if (separator != ' ' || !parts.back().empty())
      parts.emplace_back();
  }
  return parts;
}

/// " Radius[m]" is radius; quotation marks go, too.
std::string plain_name(const std::string& text)
{
  std::string name;
  for (const char c : text.substr(0, text.find('[')))
    if (!std::isspace(static_cast<unsigned char>(c)) && c != '"')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

char separator_of(std::string_view line)
{
  for (const char c : {',', ';', '\t'})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

}  // namespace

std::vector<std::string> names_in_header(std::string_view line)
{
  std::vector<std::string> names;
  for (const auto& part : split(line, separator_of(line))) names.push_back(plain_name(part));
  if (!names.empty() && names.back().empty()) names.pop_back();
  return names;
}

CsvTable::CsvTable(std::vector<std::string> files, std::span<const Column> columns)
    : source_(std::move(files))
{
  read_names(columns);
}

void CsvTable::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", source_.place(), why));
}

void CsvTable::read_names(std::span<const Column> columns)
{
  do {
    if (!source_.next()) fail("the table is empty; it should begin with a line of column names");
    if (source_.line().starts_with('#')) comments_.emplace_back(source_.line());
  } while (source_.line().empty() || source_.line().starts_with('#'));
  separator_ = separator_of(source_.line());
  const auto names = names_in_header(source_.line());
  width_ = names.size();
  for (const auto& column : columns) {
    place_.push_back(-1);
    const auto known = split(column.names, '|');
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (std::find(known.begin(), known.end(), names[k]) == known.end()) continue;
      if (place_.back() >= 0)
        fail(fmt::format("two columns are named {}; rename one of them", known[0]));
      place_.back() = static_cast<int>(k);
    }
    if (column.needed && place_.back() < 0)
      fail(fmt::format("no column {} among {}", fmt::join(known, " or "),
                       in_quotes(fmt::format("{}", fmt::join(names, " ")))));
  }
}

/// Fills row_; false at the end.
bool CsvTable::next_row()
{
  do {
    if (!source_.next()) return false;
  } while (source_.line().empty() || source_.line().starts_with('#'));
  if (!source_.line_is_whole())
    throw TruncatedArchive(
        fmt::format("{}: the table ends inside a line; copy it again, or leave out the incomplete "
                    "moment with --drop-incomplete",
                    source_.place()));
  read_numbers(source_, row_, separator_);
  if (row_.size() != width_)
    fail(fmt::format("a row of {} numbers, but the header names {} columns", row_.size(), width_));
  return true;
}

bool CsvTable::next()
{
  const bool first = !waiting_ && values_.empty();
  if (first) waiting_ = next_row();
  if (!waiting_) return false;
  const auto time_column = static_cast<std::size_t>(place_[0]);
  begin_ = first ? source_.place() : waiting_place_;
  time_ = row_[time_column];
  values_ = row_;
  rows_ = 1;
  while ((waiting_ = next_row()) && row_[time_column] == time_) {
    values_.insert(values_.end(), row_.begin(), row_.end());
    ++rows_;
  }
  if (waiting_) waiting_place_ = source_.place();
  if (waiting_ && row_[time_column] < time_)
    fail(fmt::format("time {:g} comes after time {:g}: rows must be in order of time",
                     row_[time_column], time_));
  return true;
}

double CsvTable::value(std::size_t row, std::size_t column) const
{
  return place_[column] < 0 ? 0 : values_[row * width_ + static_cast<std::size_t>(place_[column])];
}

}  // namespace grseg
