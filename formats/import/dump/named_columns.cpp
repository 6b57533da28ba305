// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/named_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>

namespace grseg {
namespace {

using Names = std::initializer_list<const char*>;

// `%` is x, y or z, `#` is 1, 2 and 3.
constexpr Names first_ids{"i", "id1", "idi", "patom1", "atom1", "particle1", "tag1"};
constexpr Names second_ids{"j", "id2", "idj", "patom2", "atom2", "particle2", "tag2"};
constexpr Names forces{"f%", "force%", "ftotal%"};
constexpr Names normal_forces{"fn%", "fnormal%", "forcenormal%", "forcen%", "normalforce%"};
constexpr Names tangential_forces{"t%",  "ft%",     "ftangential%", "forcetangential%",
                                  "fs%", "forcet%", "p#",           "tangentialforce%"};
constexpr Names branches{"b%", "branch%"};
constexpr Names distances{"dist", "distance"};
constexpr Names overlaps{"overlap", "delta", "deltan", "penetration"};

/// Pieces of a mapping, found by the names of columns.
class Namer {
 public:
  explicit Namer(const DumpHeader& header) : header_(header) {}

  /// "i=id1"; "" where no column has one of the names.
  std::string scalar(const char* word, Names names) const
  {
    for (const char* name : names)
      if (const auto column = of(name); !column.empty()) return fmt::format("{}={}", word, column);
    return "";
  }
  /// "fx=fnx,fy=fny,fz=fnz" of those components that there are, for the letter f.
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
