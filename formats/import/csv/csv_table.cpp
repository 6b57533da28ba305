// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_table.hpp"

#include "formats/import/common/archive.hpp"
#include "formats/import/common/archive_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace grseg {
namespace {

constexpr std::string_view digits = "0123456789";

/// The text of `path` that matches the `*` of a pattern; if no pattern matches, the file's name
/// without its endings.
std::string time_in(const std::string& path, const std::vector<std::string>& patterns)
{
  for (const auto& pattern : patterns) {
    const auto star = pattern.rfind('*');
    if (star == std::string::npos || pattern.find('*') != star) continue;
    const std::string_view before(pattern.data(), star), after(pattern.data() + star + 1);
    if (path.size() >= before.size() + after.size() && path.starts_with(before) &&
        path.ends_with(after))
      return path.substr(before.size(), path.size() - before.size() - after.size());
  }
  auto name = std::filesystem::path(path).filename().string();
  for (const std::string_view ending : {".csv", ".txt", ".tsv", ".dat"})
    if (const auto at = name.find(ending); at != std::string::npos) return name.substr(0, at);
  return name;
}

std::optional<CsvTime> read_time(const std::string& text)
{
  double time = 0;
  if (parse_finite(text, time) && text.find('.') != std::string::npos) return CsvTime{time, false};
  const auto last = text.find_last_of(digits);
  if (last == std::string::npos) return std::nullopt;
  const auto first = text.find_last_not_of(digits, last) + 1;  // 0 if no text precedes the digits
  std::int64_t step = 0;
  if (!parse_whole(text.substr(first, last + 1 - first), step)) return std::nullopt;
  return CsvTime{static_cast<double>(step), true};
}

constexpr std::string_view blanks = " \t";

std::string_view without_blanks(std::string_view text)
{
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// Position of the first `separator` from `at` on, outside quotation marks, or of the line's end.
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

void drop_empty_end(std::vector<std::string_view>& fields)
{
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
}

std::size_t numbers_among(const std::vector<std::string_view>& fields, char separator)
{
  CsvNumbers numbers(separator);
  double number = 0;
  return static_cast<std::size_t>(
      std::count_if(fields.begin(), fields.end(),
                    [&](std::string_view field) { return numbers.read(field, number); }));
}

bool is_comment(std::string_view line)
{
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

}  // namespace

std::vector<CsvFile> csv_files(const std::vector<std::string>& names, const std::string& option)
{
  std::vector<CsvFile> files;
  for (const auto& path : archive_files(names, option))
    files.push_back({path, read_time(time_in(path, names))});
  return files;
}

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

CsvTable::CsvTable(std::vector<CsvFile> files, std::span<const Column> columns, CsvMap& map)
    : files_(std::move(files)), columns_(columns), map_(map)
{
  open_next();
  if (!next_line()) fail("the table is empty; it should begin with a line of column names");
  read_names();
}

void CsvTable::fail(const std::string& why) const
{
  source_->fail(why);
}

std::string CsvTable::names() const
{
  return in_quotes(fmt::format("{}", fmt::join(header_, " ")));
}

bool CsvTable::open_next()
{
  if (opened_ == files_.size()) return false;
  source_.emplace(std::vector<std::string>{files_[opened_++].path});
  return true;
}

/// Advances to the next line of the open file that is neither empty nor a comment.
bool CsvTable::next_line()
{
  while (source_->next()) {
    line_ = source_->line();
    if (is_comment(line_) && header_.empty()) comments_.emplace_back(line_);
    if (!is_comment(line_) && line_.find_first_not_of(" \t,;") != std::string_view::npos)
      return true;
  }
  return false;
}

void CsvTable::read_names()
{
  row_waits_ = is_row_of_numbers();
  if (!row_waits_) {
    separator_ = csv_separator(line_);
    split_csv(line_, separator_, fields_);
    drop_empty_end(fields_);
  }
  numbers_ = CsvNumbers(separator_);
  name_columns();
}

/// True if the line, expected to have column names, has numbers in more than half of its fields.
bool CsvTable::is_row_of_numbers()
{
  for (const bool all : {true, false})
    for (const char separator : {';', '\t', ',', ' '}) {
      split_csv(line_, separator, fields_);
      drop_empty_end(fields_);
      const auto numbers = numbers_among(fields_, separator), fields = fields_.size();
      if (fields < 2 || (all ? numbers < fields : 2 * numbers <= fields)) continue;
      separator_ = separator;
      return true;
    }
  return false;
}

void CsvTable::name_columns()
{
  header_.assign(fields_.begin(), fields_.end());
  if (row_waits_ && !take_names_of_comment())
    for (std::size_t k = 0; k < header_.size(); ++k) header_[k] = std::to_string(k + 1);
  const auto names = map_.renamed(header_);
  if (names == header_ && header_.front() == "1") {
    std::string example;
    for (std::size_t k = 0, number = 0; k < columns_.size() && number < 2; ++k)
      if (columns_[k].needed)
        example += fmt::format("{}={},", ++number, parts_of(columns_[k].names, '|')[0]);
    fail(fmt::format(
        "the first line contains numbers, not names: name the columns with --map {}...", example));
  }
  find_columns(names);
}

/// Reads column names from the comment directly above the rows; false if it does not have a word
/// for each column.
bool CsvTable::take_names_of_comment()
{
  if (comments_.empty()) return false;
  const std::string_view comment = comments_.back();
  const auto names = comment.substr(std::min(comment.find_first_not_of("#%/ \t"), comment.size()));
  std::vector<std::string_view> words;
  split_csv(names, csv_separator(names), words);
  if (words.size() != header_.size() || numbers_among(words, ' ') > 0) return false;
  header_.assign(words.begin(), words.end());
  return true;
}

void CsvTable::find_columns(const std::vector<std::string>& names)
{
  place_.clear();
  first_row_.reset();
  missing_.clear();
  unused_.clear();
  std::vector<bool> used(names.size());
  for (const auto& column : columns_) {
    place_.push_back(-1);
    const auto known = parts_of(column.names, '|');
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (std::find(known.begin(), known.end(), names[k]) == known.end()) continue;
      if (place_.back() >= 0)
        fail(
            fmt::format("two columns are named {}; rename one of them, or leave one out with --map "
                        "NAME=",
                        known[0]));
      place_.back() = static_cast<int>(k);
      used[k] = true;
    }
    if (place_.back() >= 0) continue;
    const bool may_be_row = column.holds == Column::ids;
    if (may_be_row) first_row_ = map_.first_row();
    if (may_be_row && first_row_)
      row_column_ = place_.size() - 1;
    else if (column.needed)
      missing_.push_back(known[0]);
  }
  if (!has(0) && !has(1) && !files_[opened_ - 1].time) missing_.emplace_back("time");
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!used[k] && !names[k].empty() && header_[k] != std::to_string(k + 1))
      unused_.push_back(header_[k]);
}

std::string CsvTable::complaint(const std::vector<std::string>& missing) const
{
  if (missing.empty()) return "";
  const auto has = [&](const char* name) {
    return std::ranges::find(missing, name) != missing.end();
  };
  return fmt::format("{}: no column{} {} among {}; --map NAME={} names {}{}{}", source_->place(),
                     missing.size() > 1 ? "s" : "", fmt::join(missing, ", "), names(),
                     fmt::join(missing, ",NAME="), missing.size() > 1 ? "them" : "it",
                     has("id")
                         ? ", and --map row=id takes the number of the row, from 0, as the id "
                           "(from 1: row+1=id)"
                         : "",
                     has("time") ? "; a time or step may also be in the names of files" : "");
}

/// True if the first line of a further file contains column names.
bool CsvTable::is_header() const
{
  CsvNumbers numbers(separator_);
  double number = 0;
  for (const int place : place_)
    if (place >= 0 && static_cast<std::size_t>(place) < fields_.size() &&
        numbers.read(fields_[static_cast<std::size_t>(place)], number))
      return false;
  return true;
}

/// Advances to the next line that is a row; false at the end.
bool CsvTable::go_to_row()
{
  if (std::exchange(row_waits_, false)) return true;
  while (!next_line()) {
    ends_in_rows_ |= !source_->line_is_whole();
    if (!open_next()) return false;
    if (!next_line()) continue;
    split_csv(line_, separator_, fields_);
    if (!is_header()) break;
    read_names();
    if (!missing_.empty()) throw FormatError(complaint(missing_));
    if (std::exchange(row_waits_, false)) break;
  }
  return true;
}

/// Reads the next row into row_; false at the end.
bool CsvTable::next_row()
{
  if (!go_to_row()) return false;
  if (!source_->line_is_whole() && opened_ == files_.size() && !ends_in_rows_)
    throw TruncatedArchive(
        fmt::format("{}: the table ends inside a line; copy it again, or leave out the incomplete "
                    "frame with --drop-incomplete",
                    source_->place()));
  split_csv(line_, separator_, fields_);
  while (fields_.size() > header_.size() && fields_.back().empty()) fields_.pop_back();
  if (fields_.size() != header_.size())
    fail(fmt::format("a row of {} fields, but the header names {} columns", fields_.size(),
                     header_.size()));
  read_fields();
  return true;
}

void CsvTable::read_fields()
{
  row_.assign(columns_.size(), 0);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (place_[k] < 0) continue;
    const auto at = static_cast<std::size_t>(place_[k]);
    if (columns_[k].holds == Column::words) {
      read_word(k, fields_[at]);
      continue;
    }
    if (numbers_.read(fields_[at], row_[k])) continue;
    const auto word = columns_[k].holds == Column::truth ? bare_name(fields_[at]) : std::string();
    if (word != "true" && word != "false")
      fail(fmt::format("{} in column {} ({}) is not a finite number{}", in_quotes(fields_[at]),
                       at + 1, in_quotes(header_[at]), numbers_.why_not(fields_[at])));
    row_[k] = word == "true";
  }
}

/// Reads a whole number, or a word, which gets a number as its code (TypeNames).
void CsvTable::read_word(std::size_t column, std::string_view field)
{
  if (numbers_.read(field, row_[column]) && TypeNames::is_type(row_[column])) return;
  const auto number = words_.read(field);
  if (!number)
    fail(fmt::format("{} in column {} ({}) is neither a whole number nor a word", in_quotes(field),
                     place_[column] + 1,
                     in_quotes(header_[static_cast<std::size_t>(place_[column])])));
  row_[column] = *number;
}

void CsvTable::wait_for_next_row()
{
  waiting_ = next_row();
  if (waiting_) waiting_place_ = source_->place();
}

CsvTime CsvTable::time_of_row() const
{
  if (has(0)) return {row_[0], false};
  if (has(1)) return {row_[1], true};
  return *files_[opened_ - 1].time;
}

bool CsvTable::next()
{
  if (!std::exchange(started_, true)) wait_for_next_row();
  if (!waiting_) return false;
  begin_ = waiting_place_;
  time_ = time_of_row();
  values_ = row_;
  rows_ = 1;
  for (wait_for_next_row(); waiting_ && time_of_row().value == time_.value; wait_for_next_row()) {
    values_.insert(values_.end(), row_.begin(), row_.end());
    ++rows_;
  }
  for (std::size_t row = 0; first_row_ && row < rows_; ++row)
    values_[row * columns_.size() + row_column_] =
        static_cast<double>(row) + static_cast<double>(*first_row_);
  if (!waiting_) return true;
  if (const auto later = time_of_row(); later.value < time_.value)
    fail(fmt::format("{0} {1:g} comes after {0} {2:g}: rows must be in order of time",
                     later.is_step ? "step" : "time", later.value, time_.value));
  return true;
}

}  // namespace grseg
