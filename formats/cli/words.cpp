// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace grseg {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replace});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string counted(std::size_t number, const char* thing)
{
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

std::string list_of_words(const std::vector<std::string>& words)
{
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

std::string unknown_word(const std::string& what, const std::string& word,
                         const std::vector<std::string>& known)
{
  constexpr std::size_t long_list = 5;  // words; a shorter list needs no suggestion
  const auto guess = known.size() < long_list ? "" : nearest(word, known);
  return fmt::format("unknown {} '{}'{} {}", what, word,
                     guess.empty() ? "; choose" : fmt::format(", did you mean {}? Choose", guess),
                     list_of_words(known));
}

std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
  std::string best;
  const auto letters = word.size() - std::min(word.find_first_not_of('-'), word.size());
  // A typing error changes about one letter in three; words that differ more are not suggested.
  std::size_t least = std::min(letters, (letters + 2) / 3 + 1);
  for (const auto& candidate : known) {
    const auto distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string placeholder_in(std::string_view text)
{
  for (const char* word : {"%canonical_option%", "%invalid_line%", "%option%", "%original_token%",
                           "%prefix%", "%value%"})
    if (text.find(word) != std::string_view::npos) return word;
  return "";
}

namespace {

/// True if no character of the word has a special meaning in a shell (zsh expands =NAME to a path).
bool is_bare(std::string_view word)
{
  constexpr auto harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  return !word.empty() && word[0] != '=' &&
         word.find_first_not_of(harmless) == std::string_view::npos;
}

/// A character as written inside $'...'. Octal escapes always have three digits, whereas a
/// hexadecimal escape could absorb the next letter.
std::string escaped(char c)
{
  if (c == '\'' || c == '\\') return {'\\', c};
  if (c >= ' ' && c <= '~') return {c};
  return fmt::format("\\{:03o}", static_cast<unsigned char>(c));
}

}  // namespace

std::string shell_word(std::string_view word)
{
  if (is_bare(word)) return std::string(word);
  const bool plain = printable(word) == word;
  std::string quoted = plain ? "'" : "$'";
  for (const char c : word)
    quoted += !plain ? escaped(c) : c == '\'' ? std::string("'\\''") : std::string{c};
  return quoted + "'";
}

}  // namespace grseg
