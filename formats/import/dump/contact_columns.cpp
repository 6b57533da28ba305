// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/contact_columns.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace grseg {
namespace {

std::optional<std::size_t> column_number(const std::string& text)
{
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1) return std::nullopt;
  return number;
}

}  // namespace

const std::array<const char*, ContactColumns::meanings> ContactColumns::words{
    "i", "j", "fx", "fy", "fz", "tx", "ty", "tz", "bx", "by", "bz", "dist", "overlap", "wall"};

ContactColumns::ContactColumns(const std::string& text) : text_(text)
{
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size())
      throw UsageError(fmt::format(
          "--columns: '{}' is not of the form meaning=column, as in i=2,j=3,force=5", part));
    assign(part.substr(0, equals), part.substr(equals + 1));
  }
  require_sense();
}

void ContactColumns::assign(const std::string& word, const std::string& column)
{
  for (const auto& [triple, first] : {std::pair{"force", fx}, {"tangential", tx}}) {
    if (word != triple) continue;
    const auto number = column_number(column);
    if (!number)
      throw UsageError(
          fmt::format("--columns: {}={}: give the number of the first of three "
                      "columns, or {} {} {} one by one",
                      word, column, words[first], words[first + 1], words[first + 2]));
    for (std::size_t k = 0; k < 3; ++k) column_[first + k] = std::to_string(*number + k);
    return;
  }
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    std::vector<std::string> known(words.begin(), words.end());
    known.insert(known.end(), {"force", "tangential"});
    throw UsageError(unknown_word("meaning in --columns", word, known));
  }
  column_[static_cast<std::size_t>(found - words.begin())] = column;
}

void ContactColumns::require_sense() const
{
  const bool has_force = has(fx) || has(fy) || has(fz);
  if (!has(i) || !has(j) || !has_force)
    throw UsageError(fmt::format(
        "--columns '{}' does not name the columns of i, j and a force, as in i=2,j=3,force=5",
        text_));
  if (has(dist) && has(overlap))
    throw UsageError("--columns: dist and overlap both give the overlap; leave one out");
  if (has(wall) && !(has(bx) || has(by) || has(bz)))
    throw UsageError("--columns: wall needs the branch bx by bz to the contact point");
}

void ContactColumns::look_up(const std::vector<std::string>& names, const std::string& place)
{
  wanted_.clear();
  for (std::size_t m = 0; m < meanings; ++m) {
    place_[m] = -1;
    if (column_[m].empty()) continue;
    std::size_t column = 0;
    if (const auto number = column_number(column_[m]))
      column = *number - 1;
    else
      column = static_cast<std::size_t>(std::find(names.begin(), names.end(), column_[m]) -
                                        names.begin());
    if (column >= names.size())
      throw UsageError(fmt::format("--columns: {}={}, but {} has the columns {}", words[m],
                                   column_[m], place, fmt::join(names, " ")));
    const auto before = std::find(wanted_.begin(), wanted_.end(), column);
    place_[m] = static_cast<int>(before - wanted_.begin());
    if (before == wanted_.end()) wanted_.push_back(column);
  }
}

const std::vector<double>& ContactColumns::of(Meaning meaning,
                                              const std::vector<std::vector<double>>& values) const
{
  static const std::vector<double> none;
  return place_[meaning] < 0 ? none : values[static_cast<std::size_t>(place_[meaning])];
}

void ContactColumns::fill(const std::vector<std::vector<double>>& values, const std::string& place,
                          ArchiveContacts& contacts) const
{
  const auto ids = [&](Meaning meaning, std::vector<std::int64_t>& out) {
    out.clear();
    for (const double id : of(meaning, values)) {
      if (!(std::abs(id) < 9e15) || std::trunc(id) != id)
        throw FormatError(
            fmt::format("{}: {:g} in the column of {} is not an id of a grain; say "
                        "what the columns mean with --columns",
                        place, id, words[meaning]));
      out.push_back(static_cast<std::int64_t>(id));
    }
  };
  const auto add = [&](Meaning x, std::vector<Vec3>& out) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& column = of(static_cast<Meaning>(x + axis), values);
      for (std::size_t c = 0; c < column.size(); ++c)
        out[c][static_cast<Eigen::Index>(axis)] += column[c];
    }
  };
  ids(i, contacts.i);
  ids(j, contacts.j);
  // To -0 everything adds without loss, the sign of 0 included.
  contacts.force.assign(contacts.size(), Vec3::Constant(-0.0));
  add(fx, contacts.force);
  add(tx, contacts.force);
  contacts.branch.assign(has(bx) || has(by) || has(bz) ? contacts.size() : 0, Vec3::Constant(-0.0));
  add(bx, contacts.branch);
  contacts.missing.clear();
  for (const auto x : {fx, tx, bx})
    add_missing({has(x), has(static_cast<Meaning>(x + 1)), has(static_cast<Meaning>(x + 2))},
                {words[x], words[x + 1], words[x + 2]}, contacts.missing);
  contacts.overlap = of(overlap, values);
  contacts.distance = of(dist, values);
  contacts.wall.clear();
  for (const double number : of(wall, values)) {
    if (!(std::abs(number) < 1e9) || std::trunc(number) != number)
      throw FormatError(
          fmt::format("{}: {:g} in the column of wall is not a number of a wall", place, number));
    contacts.wall.push_back(number < 0 ? -1 : static_cast<std::int32_t>(number));
  }
}

}  // namespace grseg
