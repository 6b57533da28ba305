// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/columns.hpp"

#include "column_definitions.hpp"
#include "formats/cli/readable_table.hpp"

#include <fmt/format.h>

#include <sstream>
#include <vector>

namespace grseg {
namespace {

/// A line of columns.tsv: tools without "grseg-" (a star: any tool that uses the placeholder),
/// names in two and in three dimensions, meaning, and equation or section of docs/equations.md.
struct Definition {
  std::string tools, in_2d, in_3d, meaning, equation;

  explicit Definition(const std::string& line)
  {
    std::istringstream cells(line);
    for (auto* cell : {&tools, &in_2d, &in_3d, &meaning, &equation})
      std::getline(cells, *cell, '\t');
  }
  std::string name() const
  {
    if (in_3d == "=") return in_2d;
    if (in_2d == "-") return "3D " + in_3d;
    return in_3d == "-" ? "2D " + in_2d : fmt::format("{}, 3D {}", in_2d, in_3d);
  }
  std::string sentence() const
  {
    return fmt::format("{}: {}{}", name(), meaning,
                       equation.empty() ? "" : fmt::format(" [{}]", equation));
  }
  bool is_of(const std::string& tool) const
  {
    return fmt::format(" {} ", tools).find(fmt::format(" {} ", tool)) != std::string::npos;
  }
};

}  // namespace

std::string columns_text(const std::string& tool)
{
  std::vector<Definition> placeholders;
  std::string all, columns;
  std::istringstream lines(column_definitions);
  for (std::string line; std::getline(lines, line);) {
    const Definition definition(line);
    if (definition.tools == "*") placeholders.push_back(definition);
    if (!definition.is_of(tool.substr(tool.find('-') + 1))) continue;
    all += definition.sentence();
    columns += wrapped(definition.sentence());
  }
  if (columns.empty()) return "";
  auto text = wrapped(
      "NAME[unit]: meaning [equation or section of docs/equations.md]; without a unit: a count or a "
      "ratio");
  for (const auto& placeholder : placeholders)
    if (all.find(placeholder.in_2d) != std::string::npos) text += wrapped(placeholder.sentence());
  return text + '\n' + columns;
}

}  // namespace grseg
