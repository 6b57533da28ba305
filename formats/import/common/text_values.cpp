// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_values.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace grseg {

namespace {

bool are_digits(std::string_view text)
{
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The exponent in Fortran's notation: -05 of "D-05", or "-105" (Fortran omits the letter before
/// three digits). "" for other text.
std::string_view exponent_of_fortran(std::string_view text)
{
  const bool has_letter = text.find_first_of("DdQq") == 0;
  if (has_letter) text.remove_prefix(1);
  const bool has_sign = text.find_first_of("+-") == 0;
  const auto digits = text.substr(has_sign ? 1 : 0);
  return are_digits(digits) && (has_letter || (has_sign && digits.size() == 3)) ? text : "";
}

/// Reads a number by strtod: one too small for a double becomes 0, an error for from_chars.
bool read_as_c(const std::string& text, double& number)
{
  number = std::strtod(text.c_str(), nullptr);
  return std::isfinite(number);
}

constexpr std::size_t most_words = 10'000;
constexpr double first_word = 1e10;  // code of the first word; larger than the number of any type
constexpr double largest_type = std::numeric_limits<std::int32_t>::max();

bool is_nan_or_infinite(std::string_view word)
{
  double number = 0;
  return parse_whole(word, number) && !std::isfinite(number);
}

}  // namespace

std::vector<std::string> parts_of(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::vector<double> finite_numbers(const std::string& text, char separator)
{
  std::vector<double> numbers;
  for (const auto& part : parts_of(text, separator))
    if (!parse_finite(part, numbers.emplace_back())) return {};
  return numbers;
}

bool read_number(std::string_view word, double& number)
{
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const auto read = static_cast<std::size_t>(stop - word.data());
  if (read == word.size() && error == std::errc()) return std::isfinite(number);
  if (read == word.size() && error == std::errc::result_out_of_range)
    return read_as_c(std::string(word), number);
  const auto mantissa = word.substr(0, read), exponent = exponent_of_fortran(word.substr(read));
  const bool is_decimal = !mantissa.empty() && mantissa.find_first_of("eEnN") == mantissa.npos;
  if (!is_decimal || exponent.empty()) return false;
  return read_as_c(fmt::format("{}e{}", mantissa, exponent), number);
}

void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator)
{
  numbers.clear();
  const auto line = source.line();
  const char *at = line.data(), *const end = at + line.size();
  const auto is_between = [separator](char c) { return c == ' ' || c == '\t' || c == separator; };
  for (;;) {
    while (at < end && is_between(*at)) ++at;
    if (at == end) return;
    const char* const word = at;
    at = std::find_if(at, end, is_between);
    double value = 0;
    if (!read_number({word, at}, value))
      throw FormatError(fmt::format("{}: {} in column {} is not a finite number", source.place(),
                                    in_quotes({word, at}), numbers.size() + 1));
    numbers.push_back(value);
  }
}

bool TypeNames::is_type(double number)
{
  return is_whole(number, largest_type);
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
        "{}: types are words from here on, such as {}, and were numbers in earlier frames; import "
        "the parts of this archive separately, with --begin and --end",
        place, in_quotes(words_.front())));
  had_numbers_ = had_numbers_ || (!has_words_ && !grains.type.empty());
  if (has_words_) grains.type_names = words_;
}

}  // namespace grseg
