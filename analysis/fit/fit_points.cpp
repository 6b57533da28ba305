// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_points.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

double component_of(const Tensor3& stress, const FitData& data, Component component)
{
  return component == Component::yy ? stress(1, 1) : stress.trace() / data.dimension;
}

bool is_finite(const FitPoint& point)
{
  return std::isfinite(point.small + point.large + point.total);
}

[[noreturn]] void refuse(const std::string& table, const PartitionRule& rule, Component component)
{
  throw FormatError(
      fmt::format("{}: the stress ({}) by {} is not finite: a sum that it needs was not kept (see "
                  "the line '# not kept: ...') or is too large; make the table anew",
                  table, word_of(component, components), rule.name()));
}

/// One per sample, finite or not.
std::vector<FitPoint> points_of(const FitData& data, const PartitionRule& rule,
                                const FitSettings& settings)
{
  std::vector<PartialStress<3>> stresses;
  stresses.reserve(data.rows.size());
  for (const auto& sums : data.rows) stresses.push_back(partial_stress(sums, rule, settings.base));
  std::vector<FitPoint> points;
  points.reserve(data.samples.size());
  for (const auto& sample : data.samples) {
    const auto& stress = stresses[sample.row];
    const auto of = [&](const Tensor3& tensor) {
      return component_of(tensor, data, settings.component);
    };
    const auto &smaller = stress.of_species[sample.pair.smaller],
               &larger = stress.of_species[sample.pair.larger];
    const bool only_two = stress.of_species.size() == 2;
    points.push_back({.window = sample.window,
                      .phi_large = sample.phi_large,
                      .weight = sample.weight,
                      .frames = sample.frames,
                      .size_ratio = sample.size_ratio,
                      .small = of(smaller),
                      .large = of(larger),
                      .total = only_two ? of(stress.total) : of(smaller) + of(larger)});
  }
  return points;
}

}  // namespace

std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings)
{
  auto points = points_of(data, rule, settings);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!is_finite(points[k])) refuse(data.tables[data.samples[k].table], rule, settings.component);
  return points;
}

}  // namespace grseg
