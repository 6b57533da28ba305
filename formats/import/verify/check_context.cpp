// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/check_context.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace grseg {

Waivers::Waivers(const std::vector<std::string>& texts)
{
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    const auto name = equals == std::string::npos ? "balance" : text.substr(0, equals);
    const auto number = equals == std::string::npos ? text : text.substr(equals + 1);
    if (std::find(std::begin(check_names), std::end(check_names), name) == std::end(check_names))
      throw UsageError(fmt::format("--accept-residual '{}': '{}' is not a check; the checks are {}",
                                   excerpt(text), excerpt(name), fmt::join(check_names, ", ")));
    double value = 0;
    if (!parse_finite(number, value) || !(value >= 0))
      throw UsageError(fmt::format(
          "--accept-residual '{}' needs a number of 0 or more, as in balance=0.1", excerpt(text)));
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

std::string lines_with(const std::vector<Finding>& findings, Verdict verdict, const char* between)
{
  std::vector<std::string> lines;
  for (const auto& finding : findings)
    if (finding.verdict == verdict)
      lines.push_back(fmt::format("{}: {}", finding.check, finding.sentence));
  return fmt::format("{}", fmt::join(lines, between));
}

namespace {

/// Ratio of two sizes, below which they count as equal.
constexpr double one_size = 1.05;

}  // namespace

std::vector<SpeciesSizes> species_sizes(const Grains& grains, const SpeciesList& species,
                                        const std::string& types)
{
  std::istringstream lines(types);
  std::vector<SpeciesSizes> sizes;
  for (std::size_t k = 0; k < species.size(); ++k) {
    SpeciesSizes size{species[k].name, "", species[k].diameter, 0, INFINITY, 0};
    std::getline(lines, size.types);
    double count = 0;
    for (std::size_t g = 0; g < grains.size(); ++g) {
      if (grains.species[g] != static_cast<Species>(k)) continue;
      const double diameter = 2 * grains.radius[g];
      size.mean += diameter, ++count;
      size.smallest = std::min(size.smallest, diameter);
      size.largest = std::max(size.largest, diameter);
    }
    if (count == 0) continue;
    size.mean /= count;
    sizes.push_back(size);
  }
  return sizes;
}

double ratio_of_sizes(const Grains& grains)
{
  const double split = split_of_sizes(grains);
  if (split == 0) return 1;
  double sum[2] = {}, count[2] = {};
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const int larger = grains.radius[g] >= split;
    sum[larger] += grains.radius[g], ++count[larger];
  }
  return sum[1] / count[1] / (sum[0] / count[0]);
}

double split_of_sizes(const Grains& grains)
{
  Range radius;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) radius.add(grains.radius[g]);
  return radius.high > one_size * radius.low ? std::sqrt(radius.low * radius.high) : 0;
}

}  // namespace grseg
