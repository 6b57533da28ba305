// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/next_step.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace grseg {

void say_next(const std::string& command, bool quiet)
{
  if (quiet || isatty(STDERR_FILENO) != 1) return;
  fmt::print(stderr, "next: {}\n", printable(command));
}

}  // namespace grseg
