// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/checks.hpp"

#include <fmt/format.h>

namespace grseg::checks {

std::string listed()
{
  std::string text;
  for (const auto& check : all)
    text += fmt::format("  {:<20} {}\n{:<23}--{}; {}\n", check.name, check.measured, "",
                        CheckTolerances::option_of(check.tolerance), check.law);
  return text;
}

}  // namespace grseg::checks
