// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/finding.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace grseg {

Waivers::Waivers(const std::vector<std::string>& texts)
{
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    const auto name = equals == std::string::npos ? "balance" : text.substr(0, equals);
    const auto number = equals == std::string::npos ? text : text.substr(equals + 1);
    if (std::find(std::begin(check_names), std::end(check_names), name) == std::end(check_names))
      throw UsageError(fmt::format("--accept-residual '{}': '{}' is not a check; they are {}",
                                   excerpt(text), excerpt(name), fmt::join(check_names, ", ")));
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value) ||
        !(value > 0))
      throw UsageError(fmt::format(
          "--accept-residual '{}' needs a positive number, as in balance=0.1", excerpt(text)));
    if (!largest_.emplace(name, value).second)
      throw UsageError(fmt::format("--accept-residual names {} twice", name));
  }
}

std::optional<double> Waivers::of(const std::string& check) const
{
  const auto found = largest_.find(check);
  if (found == largest_.end()) return std::nullopt;
  return found->second;
}

std::string Waivers::text() const
{
  std::vector<std::string> words;
  for (const auto& [check, value] : largest_) words.push_back(fmt::format("{}={}", check, value));
  return fmt::format("{}", fmt::join(words, " "));
}

Finding Waivers::applied_to(Finding finding) const
{
  const auto largest = of(finding.check);
  if (!largest) return finding;
  const bool exceeds = !(finding.measure <= *largest);
  if (finding.verdict == Verdict::passed && exceeds) {
    finding.verdict = Verdict::failed;
    finding.sentence += fmt::format(", more than --accept-residual {}={}", finding.check, *largest);
  } else if (finding.verdict != Verdict::passed && !exceeds) {
    finding.verdict = Verdict::waived;
  }
  return finding;
}

std::string lines_with(const std::vector<Finding>& findings, Verdict verdict)
{
  std::vector<std::string> lines;
  for (const auto& finding : findings)
    if (finding.verdict == verdict)
      lines.push_back(fmt::format("{}: {}", finding.check, finding.sentence));
  return fmt::format("{}", fmt::join(lines, "\n"));
}

bool any_with(const std::vector<Finding>& findings, Verdict verdict)
{
  return std::any_of(findings.begin(), findings.end(),
                     [&](const Finding& finding) { return finding.verdict == verdict; });
}

}  // namespace grseg
