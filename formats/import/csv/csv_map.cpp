// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_map.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

namespace grseg {
namespace {

bool is_in(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_row(const std::string& name)
{
  return name == "row" || name == "row+1";
}

}  // namespace

std::string bare_name(std::string_view text)
{
  std::string name;
  for (const char c : text)
    if (!std::isspace(static_cast<unsigned char>(c)) && c != '"' && c != '\'')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

std::string plain_name(std::string_view text)
{
  return bare_name(text.substr(0, text.find_first_of("[(")));
}

CsvMap::CsvMap(const std::vector<std::string>& given, const std::vector<std::string>& known,
               const std::vector<std::string>& elsewhere)
    : known_(known), elsewhere_(elsewhere)
{
  for (const auto& list : given) add_list(list);
}

void CsvMap::add_list(const std::string& list)
{
  std::vector<Part> parts;
  for (const auto& part : parts_of(list, ',')) {
    const auto sign = part.rfind('=');
    const auto name = bare_name(part.substr(0, sign));
    if (sign == std::string::npos || name.empty())
      throw UsageError(
          fmt::format("--map '{}' is neither NAME=COLUMN, such as "
                      "particle1=i, nor NAME= for a column to leave out",
                      part));
    const auto column = bare_name(part.substr(sign + 1));
    if (!column.empty() && !is_in(known_, column) && !is_in(elsewhere_, column)) {
      std::set<std::string> all(known_.begin(), known_.end());
      all.insert(elsewhere_.begin(), elsewhere_.end());
      throw UsageError(
          unknown_word("--map " + part.substr(0, sign + 1), column, {all.begin(), all.end()}));
    }
    if (is_row(name) && column != "id")
      throw UsageError(fmt::format("--map {}: the number of a row can only be an id", part));
    parts.push_back({name, column, part, number_of(name)});
  }
  if (is_of_the_other_table(parts))
    std::erase_if(parts, [](const Part& part) { return part.number > 0; });
  parts_.insert(parts_.end(), parts.begin(), parts.end());
}

/// True if the list assigns names of the other table to column numbers.
bool CsvMap::is_of_the_other_table(const std::vector<Part>& list) const
{
  const auto has = [&](const auto& these, const auto& those) {
    return std::any_of(list.begin(), list.end(), [&](const Part& part) {
      return part.number > 0 && is_in(these, part.column) && !is_in(those, part.column);
    });
  };
  return has(elsewhere_, known_) && !has(known_, elsewhere_);
}

/// The part of --map that names a column of this table. Among several, the last one whose name only
/// this table may have, or else the last one. Marks all of them as used.
template <class IsIt>
const CsvMap::Part* CsvMap::last_that(const IsIt& is_it)
{
  const Part* found = nullptr;
  for (auto& part : parts_) {
    const bool is_shared = is_in(elsewhere_, part.column);
    if (!is_it(part) || !(part.column.empty() || is_in(known_, part.column))) continue;
    part.used = true;
    if (found == nullptr || !is_shared || is_in(elsewhere_, found->column)) found = &part;
  }
  return found;
}

/// The part of --map for a column, found by its name (with or without unit) or by its number.
const CsvMap::Part* CsvMap::part_of(const std::string& name, std::size_t number)
{
  for (const auto& text : {bare_name(name), plain_name(name)})
    if (const auto* part =
            last_that([&](const Part& p) { return p.number == 0 && p.name == text; }))
      return part;
  return last_that([&](const Part& p) { return p.number == number; });
}

std::vector<std::string> CsvMap::renamed(const std::vector<std::string>& header)
{
  std::vector<std::string> names(header.size());
  std::set<std::string> taken;
  std::vector<bool> told(header.size());
  for (std::size_t k = 0; k < header.size(); ++k) {
    const auto* const part = part_of(header[k], k + 1);
    if (part == nullptr) continue;
    told[k] = true;
    names[k] = part->column;
    taken.insert(part->column);
  }
  if (first_row()) taken.insert("id");
  for (std::size_t k = 0; k < header.size(); ++k)
    if (!told[k] && !taken.contains(plain_name(header[k]))) names[k] = plain_name(header[k]);
  return names;
}

std::optional<std::int64_t> CsvMap::first_row()
{
  for (auto& part : parts_) {
    if (!is_row(part.name) || !is_in(known_, part.column)) continue;
    part.used = true;
    return part.name == "row" ? 0 : 1;
  }
  return std::nullopt;
}

void CsvMap::require_all_used(const CsvMap& other) const
{
  std::set<std::string> used;
  for (const auto* parts : {&parts_, &other.parts_})
    for (const auto& part : *parts)
      if (part.used) used.insert(part.as_given);
  for (const auto* parts : {&parts_, &other.parts_})
    for (const auto& part : *parts)
      if (!used.contains(part.as_given))
        throw UsageError(
            fmt::format("--map {}: no table has a column of that name", part.as_given));
}

}  // namespace grseg
