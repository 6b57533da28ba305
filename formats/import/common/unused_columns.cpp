// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/unused_columns.hpp"

#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace grseg {
namespace {

/// Parts of names that columns of ellipsoids, superquadrics, polyhedra and clumps have.
constexpr const char* words_of_shapes[] = {
    "shape",   "blockiness", "quat",  "superq",   "ellips", "aspect",   "half-ax",  "halfax",
    "half_ax", "polyh",      "clump", "multisph", "ms_id",  "vertices", "roundness"};

bool is_of_a_shape(std::string name)
{
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::any_of(
      words_of_shapes, [&](const char* word) { return name.find(word) != std::string::npos; });
}

std::string to_leave_out(const std::vector<std::string>& names)
{
  return fmt::format("--map {}=", fmt::join(names, "=,"));
}

}  // namespace

std::optional<Question> question_of_columns(const std::vector<std::string>& unused,
                                            const std::string& place)
{
  std::vector<std::string> shapes;
  std::ranges::copy_if(unused, std::back_inserter(shapes), is_of_a_shape);
  if (!shapes.empty())
    throw FormatError(fmt::format(
        "{}: grains must be single discs or spheres, and the table has {}; if the grains are "
        "spheres all the same, leave these columns out with {}",
        place, fmt::join(shapes, ", "), to_leave_out(shapes)));
  if (unused.empty()) return std::nullopt;
  return Question{fmt::format("the meaning of {} in {}", fmt::join(unused, ", "), place),
                  to_leave_out(unused),
                  "if they say nothing of the shape of grains, of places or of forces"};
}

std::vector<std::string> left_out(const std::vector<std::string>& map)
{
  std::vector<std::string> names;
  for (const auto& list : map)
    for (const auto& part : parts_of(list, ',')) {
      if (!part.ends_with('='))
        throw UsageError(
            fmt::format("--map {}: columns of this format can only be left out, by NAME=", part));
      names.push_back(part.substr(0, part.size() - 1));
    }
  return names;
}

}  // namespace grseg
