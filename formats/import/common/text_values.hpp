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

/// Reads a number by from_chars; true if the whole text is a number.
template <class Number>
bool parse_whole(std::string_view text, Number& number)
{
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last;
}

/// Reads a number; true if the whole text is a finite number.
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

/// True for a whole number of at most `most` (in absolute value). The default is below 2^53, up to
/// which a double can represent every whole number.
inline bool is_whole(double number, double most = 9e15)
{
  return std::abs(number) <= most && std::trunc(number) == number;
}

/// The texts between separators, without an empty text after the last separator.
std::vector<std::string> parts_of(const std::string& text, char separator);

/// The finite numbers between separators; empty if one of the texts is not a finite number.
std::vector<double> finite_numbers(const std::string& text, char separator);

/// Reads a finite number in the notation of C or Fortran: 1e-5, +.5, 1.0D-05, 1.0-105. A number too
/// small for a double becomes 0. False for other words.
bool read_number(std::string_view word, double& number);

/// Reads the numbers of the current line of `source`, separated by blanks or by `separator`. Throws
/// FormatError with the line and the first word that is not a finite number.
void read_numbers(const TextSource& source, std::vector<double>& numbers, char separator = ' ');

/// Reads the types of an archive's grains, which are numbers or words, the same kind in all frames.
class TypeNames {
 public:
  /// True if a type may have this number.
  static bool is_type(double number);
  /// The number of a type: the number itself, or a code for a word. Empty if the text cannot be a
  /// type: no text, a number that is not whole or too large, or more than ten thousand different
  /// words.
  std::optional<double> read(std::string_view word);

  /// Fills in `type` and, if one of the types is a word, `type_names`. Throws FormatError naming
  /// `place` if types are words from this frame on and were numbers before.
  void fill(std::span<const double> read, const std::string& place, ArchiveGrains& grains);

 private:
  std::int32_t place_of(std::string_view word);

  std::vector<std::string> words_;
  std::unordered_map<std::string, std::int32_t> places_;  // index of a word in words_
  bool has_words_ = false, had_numbers_ = false;
};

}  // namespace grseg
