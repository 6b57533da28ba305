// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/type_list.hpp"

#include "formats/cli/words.hpp"

#include <algorithm>
#include <sstream>

namespace grseg {

TypeList::TypeList(const std::string& text, const std::string& option, const ArchiveGrains& grains)
    : numbers_(grains.type_names.empty() ? text : "none", option), named_(grains.type_names.size())
{
  if (text == "none") return;
  const auto& names = grains.type_names;
  std::istringstream words(text);
  for (std::string word; !names.empty() && std::getline(words, word, ',');) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) throw UsageError(unknown_word("type in " + option, word, names));
    named_[static_cast<std::size_t>(found - names.begin())] = true;
  }
}

bool TypeList::contains(std::int32_t type) const
{
  return named_.empty() ? numbers_.contains(type) : named_[static_cast<std::size_t>(type)];
}

}  // namespace grseg
