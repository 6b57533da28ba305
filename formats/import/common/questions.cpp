// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/questions.hpp"

#include <fmt/format.h>

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

}  // namespace grseg
