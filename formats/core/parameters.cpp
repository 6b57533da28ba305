// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/parameters.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

namespace grseg {

double Parameters::number(const std::string& name, const std::string& file) const
{
  if (const auto found = find_number(name)) return *found;
  throw FormatError(
      fmt::format("{}: /parameters/{} should be one number; see formats/README.md", file, name));
}

std::optional<double> Parameters::find_number(const std::string& name) const
{
  const auto found = numbers.find(name);
  if (found == numbers.end() || found->second.size() != 1) return std::nullopt;
  return found->second[0];
}

std::string Parameters::text(const std::string& name) const
{
  const auto found = texts.find(name);
  return found == texts.end() ? "" : found->second;
}

}  // namespace grseg
