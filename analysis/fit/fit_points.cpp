// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_points.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

double component_of(const Tensor2& stress, Component component)
{
  return component == Component::yy ? stress(1, 1) : stress.trace() / 2;
}

void require_finite(const PartialStress& stress, const std::string& table,
                    const PartitionRule& rule, Component component)
{
  if (!std::isfinite(component_of(stress.small + stress.large + stress.total, component)))
    throw FormatError(fmt::format(
        "{}: the stress ({}) by {} is not finite: a sum that it needs was not kept (see "
        "the line '# not kept: ...') or is too large; make the table anew",
        table, word_of(component, components), rule.name()));
}

}  // namespace

std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings)
{
  std::vector<FitPoint> points;
  points.reserve(data.samples.size());
  for (const auto& sample : data.samples) {
    const auto stress = partial_stress(sample.sums, rule, settings.base);
    require_finite(stress, data.tables[sample.table], rule, settings.component);
    points.push_back({.window = sample.window,
                      .phi_large = sample.phi_large,
                      .weight = sample.weight,
                      .size_ratio = sample.size_ratio,
                      .small = component_of(stress.small, settings.component),
                      .large = component_of(stress.large, settings.component),
                      .total = component_of(stress.total, settings.component)});
  }
  return points;
}

}  // namespace grseg
