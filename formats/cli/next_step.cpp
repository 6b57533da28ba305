// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/next_step.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace grseg {

std::string shell_word(const std::string& word)
{
  if (!word.empty() && word.find_first_of(" \t\n'\"\\$*?[]();&|<>`!#~{}") == std::string::npos)
    return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

void say_next(const std::string& command, bool quiet)
{
  if (quiet || isatty(STDERR_FILENO) != 1) return;
  fmt::print(stderr, "next: {}\n", printable(command));
}

}  // namespace grseg
