// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/column_map.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
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

ColumnMap::ColumnMap(const ColumnWords& words, const std::string& text)
    : words_(words), text_(text), column_(words.words.size()), place_(words.words.size(), -1)
{
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
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
    const auto number = column_number(column);
    if (!number)
      throw UsageError(fmt::format(
          "{}: {}={}: give the number of the first of three columns, or {} {} {} one "
          "by one",
          words_.option, word, column, words[first], words[first + 1], words[first + 2]));
    for (std::size_t k = 0; k < 3; ++k) column_[first + k] = std::to_string(*number + k);
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
    std::size_t column = 0;
    if (const auto number = column_number(column_[w]))
      column = *number - 1;
    else
      column = static_cast<std::size_t>(std::find(names.begin(), names.end(), column_[w]) -
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

}  // namespace grseg
