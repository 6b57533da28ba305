// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/contact_columns.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>

namespace grseg {
namespace {

const ColumnWords& contact_words()
{
  static const ColumnWords words{
      "--columns",
      "i=2,j=3,force=5",
      {"i", "j", "fx", "fy", "fz", "tx", "ty", "tz", "bx", "by", "bz", "dist", "overlap", "wall"},
      {{"force", 2}, {"tangential", 5}}};
  return words;
}

using Names = std::initializer_list<const char*>;

// Names of columns, compared by compared_name(). `%` means x, y or z; `#` means 1, 2 or 3.
constexpr Names first_ids{"i", "id1", "idi", "patom1", "atom1", "particle1", "tag1"};
constexpr Names second_ids{"j", "id2", "idj", "patom2", "atom2", "particle2", "tag2"};
constexpr Names forces{"f%", "force%", "ftotal%"};
constexpr Names normal_forces{"fn%", "fnormal%", "forcenormal%", "forcen%", "normalforce%"};
constexpr Names tangential_forces{"t%",  "ft%",     "ftangential%", "forcetangential%",
                                  "fs%", "forcet%", "p#",           "tangentialforce%"};
constexpr Names branches{"b%", "branch%"};
constexpr Names distances{"dist", "distance"};
constexpr Names overlaps{"overlap", "delta", "deltan", "penetration"};

/// Finds columns by their names and writes parts of a mapping, the text of --columns.
class Namer {
 public:
  explicit Namer(const DumpHeader& header) : header_(header) {}

  /// The part "i=id1"; "" if no column has one of the names.
  std::string scalar(const char* word, Names names) const
  {
    for (const char* name : names)
      if (const auto column = of(name); !column.empty()) return fmt::format("{}={}", word, column);
    return "";
  }
  /// The part "fx=fnx,fy=fny,fz=fnz" for the letter f, without the components that have no column.
  std::string vector(char letter, Names names) const
  {
    for (const std::string name : names) {
      std::string pieces;
      int found = 0;
      for (const int k : {0, 1, 2}) {
        auto component = name;
        std::replace(component.begin(), component.end(), '%', static_cast<char>('x' + k));
        std::replace(component.begin(), component.end(), '#', static_cast<char>('1' + k));
        const auto column = of(component);
        if (column.empty()) continue;
        pieces += fmt::format("{}{}{:c}={}", pieces.empty() ? "" : ",", letter, 'x' + k, column);
        ++found;
      }
      if (found == 3 || (found > 0 && name.find('%') != std::string::npos)) return pieces;
    }
    return "";
  }

 private:
  std::string of(const std::string& name) const
  {
    for (const auto& column : header_.columns)
      if (compared_name(column) == name && column.find_first_of(",=") == std::string::npos)
        return column;
    return "";
  }

  const DumpHeader& header_;
};

}  // namespace

ColumnMap::ColumnMap(const ColumnWords& words, const std::string& text)
    : words_(words), text_(text), column_(words.words.size()), place_(words.words.size(), -1)
{
  for (const auto& part : parts_of(text, ',')) {
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size())
      throw UsageError(fmt::format("{}: '{}' is not of the form meaning=column, as in {}",
                                   words_.option, part, words_.example));
    assign(part.substr(0, equals), part.substr(equals + 1));
  }
}

void ColumnMap::assign(const std::string& word, const std::string& column)
{
  const auto& words = words_.words;
  for (const auto& [triple, first] : words_.triples) {
    if (word != triple) continue;
    const auto number = number_of(column);
    if (number == 0)
      throw UsageError(fmt::format(
          "{}: {}={}: write the number of the first of three columns, or {} {} {} one "
          "by one",
          words_.option, word, column, words[first], words[first + 1], words[first + 2]));
    for (std::size_t k = 0; k < 3; ++k) column_[first + k] = std::to_string(number + k);
    return;
  }
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    std::vector<std::string> known(words.begin(), words.end());
    for (const auto& triple : words_.triples) known.emplace_back(triple.first);
    throw UsageError(unknown_word(fmt::format("meaning in {}", words_.option), word, known));
  }
  column_[static_cast<std::size_t>(found - words.begin())] = column;
}

void ColumnMap::look_up(const std::vector<std::string>& names, const std::string& place)
{
  wanted_.clear();
  for (std::size_t w = 0; w < column_.size(); ++w) {
    place_[w] = -1;
    if (column_[w].empty()) continue;
    const auto number = number_of(column_[w]);
    const auto column =
        number > 0 ? number - 1
                   : static_cast<std::size_t>(std::find(names.begin(), names.end(), column_[w]) -
                                              names.begin());
    if (column >= names.size())
      throw UsageError(fmt::format("{}: {}={}, but {} has the columns {}", words_.option,
                                   words_.words[w], column_[w], place, fmt::join(names, " ")));
    const auto before = std::find(wanted_.begin(), wanted_.end(), column);
    place_[w] = static_cast<int>(before - wanted_.begin());
    if (before == wanted_.end()) wanted_.push_back(column);
  }
}

const std::vector<double>& ColumnMap::of(std::size_t word,
                                         const std::vector<std::vector<double>>& values) const
{
  static const std::vector<double> none;
  return place_[word] < 0 ? none : values[static_cast<std::size_t>(place_[word])];
}

ContactColumns::ContactColumns(const std::string& columns) : ColumnMap(contact_words(), columns)
{
  const bool has_force = has(fx) || has(fy) || has(fz);
  if (!has(i) || !has(j) || !has_force)
    throw UsageError(fmt::format(
        "--columns '{}' does not name the columns of i, j and a force, as in i=2,j=3,force=5",
        text()));
  if (has(dist) && has(overlap))
    throw UsageError("--columns: dist and overlap both determine the overlap; leave one out");
  if (has(wall) && !(has(bx) || has(by) || has(bz)))
    throw UsageError("--columns: wall needs the branch bx by bz to the contact point");
}

void ContactColumns::fill(const std::vector<std::vector<double>>& values, const std::string& place,
                          ArchiveContacts& contacts) const
{
  const auto of = [&](std::size_t meaning) -> const std::vector<double>& {
    return ColumnMap::of(meaning, values);
  };
  const auto ids = [&](Meaning meaning, std::vector<std::int64_t>& out) {
    out.clear();
    for (const double id : of(meaning)) {
      if (!is_whole(id))
        throw FormatError(
            fmt::format("{}: {:g} in the column of {} is not an id of a grain; set "
                        "the meaning of the columns with --columns",
                        place, id, contact_words().words[meaning]));
      out.push_back(static_cast<std::int64_t>(id));
    }
  };
  const auto add = [&](Meaning x, std::vector<Vec3>& out) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& column = of(x + axis);
      for (std::size_t c = 0; c < column.size(); ++c)
        out[c][static_cast<Eigen::Index>(axis)] += column[c];
    }
  };
  ids(i, contacts.i);
  ids(j, contacts.j);
  // Sums start at -0, because -0 + x is exactly x, also for x = -0 and x = +0.
  contacts.force.assign(contacts.size(), Vec3::Constant(-0.0));
  add(fx, contacts.force);
  add(tx, contacts.force);
  contacts.branch.assign(has(bx) || has(by) || has(bz) ? contacts.size() : 0, Vec3::Constant(-0.0));
  add(bx, contacts.branch);
  contacts.missing.clear();
  const auto& words = contact_words().words;
  for (const std::size_t x : {fx, tx, bx})
    for (std::size_t k = x; k < x + 3; ++k)
      if (!has(k) && (has(x) || has(x + 1) || has(x + 2))) contacts.missing.emplace_back(words[k]);
  contacts.overlap = of(overlap);
  contacts.distance = of(dist);
  contacts.wall.clear();
  for (const double number : of(wall)) {
    if (!is_whole(number, 1e9))
      throw FormatError(
          fmt::format("{}: {:g} in the column of wall is not the number of a wall", place, number));
    contacts.wall.push_back(number < 0 ? -1 : static_cast<std::int32_t>(number));
  }
}

std::string compared_name(std::string_view name)
{
  std::string compared;
  for (const unsigned char c : name)
    if (std::isalnum(c) != 0) compared += static_cast<char>(std::tolower(c));
  return compared;
}

std::string columns_by_name(const DumpHeader& header, PlainForce plain)
{
  const Namer namer(header);
  auto force = namer.vector('f', forces), tangential = namer.vector('t', tangential_forces);
  const auto normal = namer.vector('f', normal_forces);
  const bool is_whole = !force.empty() && (plain == PlainForce::whole || !normal.empty());
  if (is_whole) tangential.clear();
  if (force.empty()) force = normal;
  const auto i = namer.scalar("i", first_ids), j = namer.scalar("j", second_ids);
  if (i.empty() || j.empty() || force.empty()) return "";
  auto text = i;
  const auto distance = namer.scalar("dist", distances);
  for (const auto& piece : {j, force, tangential, namer.vector('b', branches), distance,
                            distance.empty() ? namer.scalar("overlap", overlaps) : std::string()})
    if (!piece.empty()) text += "," + piece;
  return text;
}

}  // namespace grseg
