// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/shell_word.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

/// True where no shell gives a character of the word a meaning; zsh takes =NAME for a program.
bool is_bare(std::string_view word)
{
  constexpr auto harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  return !word.empty() && word[0] != '=' &&
         word.find_first_not_of(harmless) == std::string_view::npos;
}

/// Inside $'...'. Three octal digits end by themselves, hexadecimal ones may run into the next letter.
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
