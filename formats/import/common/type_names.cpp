// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/type_names.hpp"

#include "formats/import/common/number_row.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr std::size_t most_words = 10'000;
constexpr double first_word = 1e10;  // codes of words are above those of numbers
constexpr double largest_type = std::numeric_limits<std::int32_t>::max();

bool is_nan_or_infinite(std::string_view word)
{
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && !std::isfinite(number);
}

}  // namespace

bool TypeNames::is_type(double number)
{
  return std::abs(number) <= largest_type && std::trunc(number) == number;
}

std::int32_t TypeNames::place_of(std::string_view word)
{
  const auto [found, is_new] =
      places_.try_emplace(std::string(word), static_cast<std::int32_t>(words_.size()));
  if (is_new) words_.emplace_back(word);
  return found->second;
}

std::optional<double> TypeNames::read(std::string_view word)
{
  double number = 0;
  if (read_number(word, number)) return is_type(number) ? std::optional(number) : std::nullopt;
  if (word.empty() || is_nan_or_infinite(word) || words_.size() >= most_words) return std::nullopt;
  has_words_ = true;
  return first_word + place_of(word);
}

void TypeNames::fill(std::span<const double> read, const std::string& place, ArchiveGrains& grains)
{
  grains.type.clear();
  grains.type_names.clear();
  for (const double type : read) {
    grains.type.push_back(type >= first_word ? static_cast<std::int32_t>(type - first_word)
                          : has_words_       ? place_of(fmt::format("{:.0f}", type))
                                             : static_cast<std::int32_t>(type));
  }
  if (has_words_ && had_numbers_)
    throw FormatError(fmt::format(
        "{}: types are words from here on, such as {}, and were numbers at moments before; import "
        "the parts of this archive separately, with --begin and --end",
        place, in_quotes(words_.front())));
  had_numbers_ = had_numbers_ || (!has_words_ && !grains.type.empty());
  if (has_words_) grains.type_names = words_;
}

}  // namespace grseg
