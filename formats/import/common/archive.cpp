// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

std::string sentence_of(const std::vector<Question>& questions)
{
  std::string text = "the archive leaves open what an import needs to know:";
  for (const auto& [what, option, reason] : questions)
    text += fmt::format("\n  {}: {}{}", what, option,
                        reason.empty() ? "" : fmt::format("  ({})", reason));
  return text;
}

}  // namespace

OpenQuestions::OpenQuestions(std::vector<Question> open)
    : UsageError(sentence_of(open)), questions(std::move(open))
{
}

std::string OpenQuestions::options() const
{
  std::string text;
  for (const auto& question : questions) text += (text.empty() ? "" : " ") + question.option;
  return text;
}

Vec3 ArchiveMoment::minimum_image(Vec3 between) const
{
  for (int axis = 0; axis < 3; ++axis) {
    const double length = high[axis] - low[axis];
    if (periodic[static_cast<std::size_t>(axis)] && length > 0)
      between[axis] -= length * std::round(between[axis] / length);
  }
  return between;
}

void enclose_grains(ArchiveMoment& moment)
{
  const auto& grains = moment.grains;
  Vec3 low = grains.position.front(), high = low;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3 reach = Vec3::Constant(grains.radius.empty() ? 0 : grains.radius[g]);
    low = low.cwiseMin(grains.position[g] - reach);
    high = high.cwiseMax(grains.position[g] + reach);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (moment.periodic[static_cast<std::size_t>(axis)]) continue;
    moment.low[axis] = low[axis];
    moment.high[axis] = high[axis];
    moment.cell[static_cast<std::size_t>(axis)] = CellSource::grains;
  }
}

}  // namespace grseg
