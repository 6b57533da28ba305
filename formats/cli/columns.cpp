// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/columns.hpp"

#include "column_definitions.hpp"
#include "formats/cli/readable_table.hpp"
#include "formats/cli/table.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

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

/// If `written`, an alternative of a definition such as "n_{pair}", stands for the column `name`:
/// the number of letters that are not of placeholders; otherwise 0.
std::size_t letters_in_common(const std::string& written, const std::string& name)
{
  std::string pattern;
  std::size_t letters = 0;
  auto plain = without_unit(written);
  plain.erase(0, plain.rfind(' ') + 1);  // "quantity "
  for (std::size_t k = 0; k < plain.size(); ++k)
    if (plain[k] == '{') {
      const auto end = plain.find('}', k);
      const auto mark = plain.substr(k + 1, end - k - 1);
      pattern += mark == "ab"  ? "[xyz][xyz]"
                 : mark == "a" ? "[xyz]"
                 : mark == "f" ? "[xyzr]"
                               : ".+";
      k = end;
    } else {
      pattern += std::isalnum(static_cast<unsigned char>(plain[k])) ? std::string(1, plain[k])
                                                                    : fmt::format("[{}]", plain[k]);
      ++letters;
    }
  return std::regex_match(name, std::regex(pattern)) ? letters : 0;
}

std::size_t letters_in_common(const Definition& definition, const std::string& name)
{
  std::size_t most = 0;
  for (std::string rest : {definition.in_2d, definition.in_3d})
    while (!rest.empty()) {
      const auto end = std::min(rest.find(" or "), rest.size());
      most = std::max(most, letters_in_common(rest.substr(0, end), without_unit(name)));
      rest.erase(0, end + 4);
    }
  return most;
}

/// The definitions with most letters in common with the name of a column. Throws UsageError if no
/// definition is of this column.
std::vector<Definition> definitions_of(const std::vector<Definition>& all, const std::string& name,
                                       const std::string& tool)
{
  std::size_t most = 1;
  std::vector<Definition> found;
  for (const auto& definition : all) {
    const auto letters = letters_in_common(definition, name);
    if (letters > most) found.clear();
    if (letters >= most) found.push_back(definition);
    most = std::max(most, letters);
  }
  if (found.empty())
    throw UsageError(fmt::format("no table of {} has a column '{}'; {} --columns lists all", tool,
                                 excerpt(name), tool));
  return found;
}

}  // namespace

std::string columns_text(const std::string& tool, const std::vector<std::string>& names)
{
  std::vector<Definition> placeholders, definitions;
  std::istringstream lines(column_definitions);
  for (std::string line; std::getline(lines, line);) {
    const Definition definition(line);
    if (definition.tools == "*") placeholders.push_back(definition);
    if (definition.is_of(tool.substr(tool.find('-') + 1))) definitions.push_back(definition);
  }
  if (definitions.empty()) return "";
  if (!names.empty()) {
    std::vector<Definition> named;
    for (const auto& name : names)
      for (const auto& definition : definitions_of(definitions, name, tool))
        named.push_back(definition);
    definitions = named;
  }
  std::string all, columns;
  for (const auto& definition : definitions) {
    all += definition.sentence();
    columns += wrapped(definition.sentence());
  }
  auto text = wrapped(
      "NAME[unit]: meaning [equation or section of docs/equations.md]; without a unit: a count or a "
      "ratio");
  for (const auto& placeholder : placeholders)
    if (all.find(placeholder.in_2d) != std::string::npos) text += wrapped(placeholder.sentence());
  return text + '\n' + columns;
}

}  // namespace grseg
