// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/table.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/trajectory/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>

namespace grseg {
namespace {

std::vector<std::string_view> split(std::string_view text, char at)
{
  std::vector<std::string_view> parts;
  for (auto end = text.find(at); end != std::string_view::npos; end = text.find(at)) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

/// Reads a table line by line and throws FormatError if the table is damaged.
class TableParser {
 public:
  TableParser(const std::string& text, const std::string& name, const WantedTables* wanted)
      : text_(text)
  {
    table_.name = name;
    require_text();
    lines_ = split(std::string_view(text_).substr(0, text_.size() - 1), '\n');
    require_printable_lines();
    std::size_t head = 0;
    while (head < lines_.size() && lines_[head].starts_with('#')) ++head;
    has_end_ = lines_.back().starts_with(end_mark) && head < lines_.size();
    if (head == lines_.size()) fail("has no line of column names, so it is not a table");
    const auto end = lines_.size() - (has_end_ ? 1 : 0);
    if (has_end_) require_end(end - head - 1);
    read_header(head);
    if (!has_end_ && !table_.made_by_hand())
      fail(
          fmt::format("does not end with the line '{}N rows, xxh3 ...' of every table of {}; it is "
                      "truncated or damaged, make it again (a table made by hand has no line '# "
                      "program: ...')",
                      end_mark, excerpt(table_.header_text("program"))));
    if (wanted != nullptr) require(*wanted);
    read_columns(head);
    for (std::size_t k = head + 1; k < end; ++k) read_row(k);
  }

  Table table() && { return std::move(table_); }

 private:
  [[noreturn]] void fail(const std::string& why) const
  {
    throw FormatError(fmt::format("{}: {}", table_.name, why));
  }
  [[noreturn]] void fail(std::size_t line, const std::string& why) const
  {
    fail(fmt::format("line {}: {}", line + 1, why));
  }

  void require_text() const
  {
    if (text_.empty()) fail("is empty, not a table");
    if (const auto wrong = kind_of_start(text_).instead_of("a table", ""); !wrong.empty())
      fail(wrong);
    if (text_.starts_with("\x89HDF"))
      fail(kind_of_file(table_.name)
               .instead_of("a table",
                           "is an HDF5 file, not a table; if it is a run, make its "
                           "table with grseg-stress"));
    if (text_.starts_with("\xef\xbb\xbf"))
      fail("begins with a byte order mark; save it as UTF-8 without BOM");
    if (text_.find("\r\n") != std::string::npos)
      fail("its lines end as on Windows (CR LF); convert it with dos2unix");
    if (text_.back() != '\n') fail("the last line is incomplete; the table is truncated");
  }

  void require_printable_lines() const
  {
    for (std::size_t k = 0; k < lines_.size(); ++k)
      for (const auto cell : split(lines_[k], '\t')) {
        const bool plain =
            std::all_of(cell.begin(), cell.end(), [](char c) { return c >= ' ' && c < '\x7f'; });
        if (!plain && printable(cell) != cell)
          fail(k,
               fmt::format("'{}' is not plain text (UTF-8); the table is damaged", excerpt(cell)));
      }
  }

  void require_end(std::size_t rows) const
  {
    const auto last = lines_.back();
    const std::string_view before(text_.data(), text_.size() - last.size() - 1);
    if (last == end_line(before, rows)) return;
    if (!last.starts_with(fmt::format("{}{} rows, ", end_mark, rows)))
      fail(fmt::format("has {} rows, but ends with '{}'; it is damaged, make it again", rows,
                       excerpt(last)));
    fail(
        "does not agree with the checksum in its last line: it was changed or damaged after it was "
        "written; make it again");
  }

  void read_header(std::size_t head)
  {
    std::optional<std::size_t> malformed;
    for (std::size_t k = 0; k < head; ++k) {
      const auto line = lines_[k];
      const auto colon = line.find(": ");
      if (line.starts_with("# ") && colon != std::string_view::npos && colon > 2) {
        table_.header.emplace_back(line.substr(2, colon - 2), line.substr(colon + 2));
      } else {
        table_.header.emplace_back(line.substr(line.starts_with("# ") ? 2 : 1), "");
        if (!malformed) malformed = k;
      }
    }
    if (malformed && !table_.made_by_hand())
      fail(*malformed, fmt::format("'{}' should be '# key: value'", excerpt(lines_[*malformed])));
    if (table_.made_by_hand() && !table_.has_header("verified"))
      table_.header.emplace_back("verified", "no, made by hand");
  }

  void require(const WantedTables& wanted) const
  {
    const auto program = table_.made_by_hand() ? "" : table_.header_text("program");
    if (std::ranges::find(wanted.programs, program.substr(0, program.find(' '))) !=
        wanted.programs.end())
      return;
    fail(fmt::format("is a table {}; {}",
                     program.empty() ? "made by hand" : "of " + excerpt(program), wanted.remedy));
  }

  void read_columns(std::size_t k)
  {
    const auto cells = split(lines_[k], '\t');
    constexpr std::size_t most = 10000;
    if (cells.size() > most) fail(k, fmt::format("{} columns are too many", cells.size()));
    std::set<std::string> names;
    for (const auto cell : cells) {
      const std::string column(cell), plain = without_unit(column);
      const bool has_unit = plain.size() < column.size();
      const bool whole = column.find(']') == (has_unit ? column.size() - 1 : std::string::npos);
      if (plain.empty() || !whole)
        fail(k,
             fmt::format("'{}' should be the name of a column, such as V[m^2]", excerpt(column)));
      if (!names.insert(plain).second)
        fail(k, fmt::format("two columns are called '{}'", excerpt(plain)));
      table_.columns.push_back(column);
    }
  }

  void read_row(std::size_t k)
  {
    if (lines_[k].starts_with('#'))
      fail(k, fmt::format("'{}' is between the rows; only the last line, '{}N rows, xxh3 ...', may "
                          "begin with #",
                          excerpt(lines_[k]), end_mark));
    const auto cells = split(lines_[k], '\t');
    if (cells.size() != table_.columns.size())
      fail(k, fmt::format("{} columns, but the header names {}; is the table truncated?",
                          cells.size(), table_.columns.size()));
    auto& row = table_.rows.emplace_back();
    row.reserve(cells.size());
    for (const auto cell : cells) {
      const auto number = parse_number(cell);
      if (!number) fail(k, fmt::format("'{}' is not a number", excerpt(cell)));
      row.push_back(*number);
    }
  }

  const std::string& text_;
  Table table_;
  std::vector<std::string_view> lines_;  // all lines, including "# end: ..." if there is one
  bool has_end_ = false;                 // true: the last line is "# end: ..."
};

}  // namespace

Table Table::read(const std::string& path, const WantedTables* wanted)
{
  const auto all_of = [](std::istream& file) {
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  if (path == "-") return parse(all_of(std::cin), "standard input", wanted);
  require_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw RunError(fmt::format("{}: cannot be opened: {}", path, reason(errno)));
  return parse(all_of(file), path, wanted);
}

Table Table::parse(const std::string& text, const std::string& name, const WantedTables* wanted)
{
  return TableParser(text, name, wanted).table();
}

}  // namespace grseg
