// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_source.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace grseg {

/// True where the whole text is a number, as from_chars reads it.
template <class Number>
bool parse_whole(std::string_view text, Number& number)
{
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last;
}

/// True where the whole text is a finite number.
inline bool parse_finite(std::string_view text, double& number)
{
  return parse_whole(text, number) && std::isfinite(number);
}

/// The whole number in the text, such as the number of a column; 0 for other text.
inline std::size_t number_of(std::string_view text)
{
  std::size_t number = 0;
  return parse_whole(text, number) ? number : 0;
}

/// True for a whole number of at most `most`; by default that is below 2^53, up to which a double can
/// represent every whole number.
inline bool is_whole(double number, double most = 9e15)
{
  return std::abs(number) <= most && std::trunc(number) == number;
}

/// The texts between separators; nothing behind the last one.
std::vector<std::string> parts_of(const std::string& text, char separator);

/// The finite numbers between separators; empty where something else stands there.
std::vector<double> finite_numbers(const std::string& text, char separator);

/// A finite number as C or Fortran writes it: 1e-5, +.5, 1.0D-05, 1.0-105; one too small to be held is 0.
/// False for other words.
bool read_number(std::string_view word, double& number);

/// The numbers of the current line of `source`, separated by blanks or by `separator`. FormatError
/// naming the line and the first word that is not a finite number.
void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator = ' ');

/// The types of an archive's grains, which it gives as numbers or as words, the same at all moments.
class TypeNames {
 public:
  /// True where a type may have this number.
  static bool is_type(double number);
  /// A number that stands for the word; itself, if it is one. None where it cannot be a type: empty, a
  /// number that is not whole or too large, or more than ten thousand different words.
  std::optional<double> read(std::string_view word);

  /// Fills in `type` and, where one of them is a word, `type_names`. FormatError naming `place` where
  /// types were numbers at moments before.
  void fill(std::span<const double> read, const std::string& place, ArchiveGrains& grains);

 private:
  std::int32_t place_of(std::string_view word);

  std::vector<std::string> words_;
  std::unordered_map<std::string, std::int32_t> places_;  // in words_
  bool has_words_ = false, had_numbers_ = false;
};

}  // namespace grseg
