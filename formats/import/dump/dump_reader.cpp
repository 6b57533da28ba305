// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

constexpr std::string_view item_word = "ITEM: ";
constexpr std::size_t most_rows = std::size_t{1} << 31;

bool is_blank(char c)
{
  return c == ' ' || c == '\t';
}

/// The numbers in a line; empty if one of the words is not a finite number.
std::vector<double> numbers_in(std::string_view line)
{
  std::vector<double> numbers;
  for (const auto word : words_of(line))
    if (!read_number(word, numbers.emplace_back())) return {};
  return numbers;
}

}  // namespace

std::optional<std::size_t> DumpHeader::find(std::string_view name) const
{
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::string_view DumpReader::next_line(const char* what)
{
  require_line(source_.next(), what);
  return source_.line();
}

/// Throws unless a line was read (`there`) and is complete. Only the last line lacks a line end.
void DumpReader::require_line(bool there, const char* what)
{
  if (there && source_.line_is_whole()) return;
  const auto place = source_.place();
  if (there && source_.next()) {
    if (source_.line().starts_with(item_word)) fail_at_next_block(0);
    throw FormatError(
        fmt::format("{}: the file ends in {}, and {} does not begin with a block; copy it again",
                    place, what, source_.file()));
  }
  rows_left_ = 0;
  throw TruncatedArchive(
      fmt::format("{}: the archive ends in {}; copy it again, or leave out the incomplete frame "
                  "with --drop-incomplete",
                  place, what));
}

/// Throws TruncatedArchive: a new block begins at column `begin` of the line, before all rows of
/// the last block were read. A killed job leaves its last block incomplete, and the next job writes
/// behind it, in the same file (perhaps behind a part of a row) or in another.
void DumpReader::fail_at_next_block(std::size_t begin)
{
  next_block_ = begin;
  const auto missing = std::exchange(rows_left_, 0);
  throw TruncatedArchive(
      fmt::format(
          "{}: {} of {} rows of step {} are missing where a new block begins (a job that was "
          "killed, and the next one?); leave out the incomplete frame with --drop-incomplete",
          source_.place(), missing, header_.rows, header_.step),
      true);
}

/// Skips the rows that were not read. They may be incomplete if another block follows.
void DumpReader::skip_rows()
{
  for (; rows_left_ > 0; --rows_left_) {
    try {
      next_line("a row");
    } catch (const TruncatedArchive& at_its_end) {
      if (!at_its_end.goes_on) throw;
    }
    if (const auto begin = source_.line().find(item_word); begin != std::string_view::npos)
      next_block_ = begin;
    if (next_block_) break;
  }
}

bool DumpReader::next()
{
  skip_rows();
  if (!next_block_) {
    do {
      if (!source_.next()) return false;
    } while (source_.line().empty());
    next_block_ = 0;
  }
  rows_left_ = 0;
  try {
    require_line(true, "a header");
    read_header();
  } catch (const TruncatedArchive& at_its_end) {
    if (!at_its_end.goes_on) throw;
    return next();
  }
  rows_left_ = header_.rows;
  return true;
}

/// Reads the header from the current line to the line of column names, the last one above the rows.
void DumpReader::read_header()
{
  header_ = {};
  header_.file = source_.file();
  header_.place = source_.place();
  std::string label;
  for (bool has_step = false, has_box = false;; next_line("a header")) {
    const auto line = source_.line().substr(next_block_.value_or(0));
    next_block_.reset();
    const bool is_text = std::all_of(line.begin(), line.end(), [](char c) {
      return is_blank(c) || c == '\r' || static_cast<unsigned char>(c) >= ' ';
    });
    if (!is_text)
      source_.fail(
          "this is not text: a binary dump? Turn it into text "
          "with binary2txt, which comes with LAMMPS");
    if (!line.starts_with(item_word))
      source_.fail(
          fmt::format("{} found where a text dump has a line 'ITEM: ...'", in_quotes(line)));
    const auto item = line.substr(item_word.size());
    if (!label.empty() && item.starts_with(label) &&
        (item.size() == label.size() || is_blank(item[label.size()]))) {
      for (const auto name : words_of(item.substr(label.size())))
        header_.columns.emplace_back(name);
      if (!has_step || !has_box) source_.fail("TIMESTEP or BOX BOUNDS is missing above the rows");
      if (header_.columns.empty()) source_.fail("the line names no columns");
      header_.label = label;
      return;
    }
    has_step = has_step || item == "TIMESTEP";
    has_box = has_box || item.starts_with("BOX BOUNDS");
    read_item(std::string(item), label);
  }
}

void DumpReader::read_item(std::string_view item, std::string& label)
{
  constexpr std::string_view number_of = "NUMBER OF ";
  if (item.starts_with("BOX BOUNDS abc origin")) return read_general_box(item);
  if (item.starts_with("BOX BOUNDS")) return read_box(item);
  if (item.starts_with(number_of)) {
    label = item.substr(number_of.size());
    if (!parse_whole(next_line("a header"), header_.rows) || header_.rows > most_rows)
      source_.fail(fmt::format("{} is not a number of rows", in_quotes(source_.line())));
  } else if (item == "TIMESTEP") {
    if (!parse_whole(next_line("a header"), header_.step))
      source_.fail(fmt::format("{} is not a time step", in_quotes(source_.line())));
  } else if (item == "UNITS") {
    const auto before = std::exchange(units_, std::string(next_line("a header")));
    if (before && *before != *units_)
      source_.fail(
          fmt::format("units {} after units {}: import the parts of this archive separately",
                      in_quotes(*units_), in_quotes(*before)));
  } else if (item == "TIME") {
    if (!read_number(next_line("a header"), header_.time.emplace()))
      source_.fail(fmt::format("{} is not a time", in_quotes(source_.line())));
  } else {
    source_.fail(fmt::format("{} is not part of a dump", in_quotes(source_.line())));
  }
}

/// Reads the cell in the form "BOX BOUNDS abc origin pp ff pp"; then a line per axis: three
/// components of an edge of the cell, and a coordinate of its origin.
void DumpReader::read_general_box(std::string_view item)
{
  constexpr double round_off = 1e-12;  // relative round-off of a rotated cell
  const auto letters = words_of(item);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = numbers_in(next_line("a header"));
    if (value.size() != 4 || value[axis] < 0)
      source_.fail(
          fmt::format("{} is not an edge of the cell and its origin", in_quotes(source_.line())));
    for (std::size_t k = 0; k < 3; ++k)
      if (k != axis && std::abs(value[k]) > round_off * value[axis]) refuse_tilted_cell();
    header_.periodic[axis] = letters.size() > 4 + axis && letters[4 + axis] == "pp";
    const auto k = static_cast<Eigen::Index>(axis);
    header_.low[k] = value[3];
    header_.high[k] = value[3] + value[axis];
  }
}

void DumpReader::refuse_tilted_cell() const
{
  source_.fail(
      "the cell is tilted; only rectangular cells are imported: if no shear tilts the cell, use "
      "`change_box all ortho` before writing the dump");
}

/// Reads the cell in the form "BOX BOUNDS pp ff pp" or, if tilted, "BOX BOUNDS xy xz yz pp ff pp";
/// then a line per axis.
void DumpReader::read_box(std::string_view item)
{
  const auto words = words_of(item);
  const std::size_t letters = words.size() > 2 && words[2] == "xy" ? 5 : 2;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Dumps from before 2010 have no letters; then no axis is taken as periodic.
    if (letters + axis >= words.size()) continue;
    header_.periodic[axis] = words[letters + axis] == "pp";
    header_.shrinks[axis] = words[letters + axis].find_first_of("sm") != std::string_view::npos;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = numbers_in(next_line("a header"));
    if (value.size() < 2 || value.size() > 3 || value[0] > value[1])
      source_.fail(
          fmt::format("{} is not a pair of bounds of the cell", in_quotes(source_.line())));
    if (value.size() == 3 && value[2] != 0) refuse_tilted_cell();
    header_.low[axis] = value[0];
    header_.high[axis] = value[1];
  }
}

void DumpReader::read_rows(std::span<const std::size_t> wanted,
                           std::vector<std::vector<double>>& values, const TypeColumn& types)
{
  std::vector<int> role(header_.columns.size(), -1);
  for (std::size_t k = 0; k < wanted.size(); ++k) role.at(wanted[k]) = static_cast<int>(k);
  values.resize(wanted.size());
  while (has_rows_alone_ && source_.next()) {
    require_line(true, "a row");
    read_row(role, values, types);
  }
  for (; rows_left_ > 0; --rows_left_) {
    next_line("a row");
    read_row(role, values, types);
  }
}

/// Reads a type, or a word that from_chars refuses as a number. Throws FormatError if it is none.
double DumpReader::number_in(std::string_view word, std::size_t column, TypeNames* names)
{
  double value = 0;
  if (names == nullptr && read_number(word, value)) return value;
  if (names != nullptr)
    if (const auto type = names->read(word)) return *type;
  if (const auto begin = source_.line().find(item_word); begin != std::string_view::npos)
    fail_at_next_block(begin);
  source_.fail(fmt::format(
      "{} in column {} ({}) is not {}", in_quotes(word), column + 1, header_.columns[column],
      names == nullptr ? "a finite number" : "a type, a whole number or a word"));
}

void DumpReader::read_row(std::span<const int> role, std::vector<std::vector<double>>& values,
                          const TypeColumn& types)
{
  const auto line = source_.line();
  if (line.starts_with(item_word)) fail_at_next_block(0);
  const char *at = line.data(), *const end = at + line.size();
  std::size_t column = 0;
  for (;; ++column) {
    while (at < end && is_blank(*at)) ++at;
    if (at == end) break;
    const char* word = at;
    if (column < role.size() && role[column] >= 0) {
      double value = 0;
      const auto parsed = std::from_chars(at, end, value);
      at = parsed.ptr;
      const bool is_type = role[column] == types.place;
      if (parsed.ec != std::errc() || !std::isfinite(value) || is_type ||
          (at < end && !is_blank(*at))) {
        at = std::find_if(word, end, is_blank);
        value = number_in({word, at}, column, is_type ? types.names : nullptr);
      }
      values[static_cast<std::size_t>(role[column])].push_back(value);
    } else {
      while (at < end && !is_blank(*at)) ++at;
    }
  }
  if (column == role.size()) return;
  if (const auto begin = line.find(item_word); begin != std::string_view::npos)
    fail_at_next_block(begin);
  source_.fail(fmt::format("a row of {} columns, but the header names {}", column, role.size()));
}

}  // namespace grseg
