// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_map.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace grseg {

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

CsvMap::CsvMap(const std::vector<std::string>& given, const std::vector<std::string>& known)
{
  for (const auto& list : given) {
    std::istringstream parts(list);
    for (std::string part; std::getline(parts, part, ',');) {
      const auto sign = part.rfind('=');
      const auto name = bare_name(part.substr(0, sign));
      if (sign == std::string::npos || name.empty())
        throw UsageError(fmt::format(
            "--map '{}' is not NAME=COLUMN, such as particle1=i, or NAME= for a column to leave out",
            part));
      const auto column = bare_name(part.substr(sign + 1));
      if (!column.empty() && std::find(known.begin(), known.end(), column) == known.end())
        throw UsageError(unknown_word("--map " + part.substr(0, sign + 1), column, known));
      names_[name] = column;
      as_given_[name] = part;
    }
  }
}

std::vector<std::string> CsvMap::renamed(const std::vector<std::string>& header)
{
  std::vector<std::string> names(header.size());
  std::set<std::string> taken;
  std::vector<bool> told(header.size());
  for (std::size_t k = 0; k < header.size(); ++k)
    for (const auto& name : {bare_name(header[k]), plain_name(header[k])}) {
      const auto found = names_.find(name);
      if (told[k] || found == names_.end()) continue;
      told[k] = true;
      names[k] = found->second;
      taken.insert(found->second);
      used_.insert(name);
    }
  for (std::size_t k = 0; k < header.size(); ++k)
    if (!told[k] && !taken.contains(plain_name(header[k]))) names[k] = plain_name(header[k]);
  return names;
}

void CsvMap::require_all_used() const
{
  for (const auto& [name, part] : as_given_)
    if (!used_.contains(name))
      throw UsageError(fmt::format("--map {}: no table has a column of that name", part));
}

}  // namespace grseg
