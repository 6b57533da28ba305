// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/contact_rules.hpp"

#include "formats/core/dimension.hpp"
#include "formats/core/errors.hpp"
#include "formats/trajectory/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

double size_of_gravity(const TrajectoryReader& run)
{
  return with_dimension(run.dimension(), [&](auto d) { return run.gravity<d>().norm(); });
}

}  // namespace

ContactRules read_contact_rules(const TrajectoryReader& run)
{
  const auto& parameters = run.parameters();
  ContactRules rules;
  rules.friction = parameters.find_number("friction");
  rules.restitution = parameters.find_number("restitution");
  rules.step = run.step();
  rules.accuracy = parameters.text("accuracy");
  const auto& radius = run.grains().radius;
  rules.margin = 1e-9 * 2 * *std::min_element(radius.begin(), radius.end());
  const auto law = parameters.text("contact_law");
  if (law.empty() || law == "touch") {
    rules.look_ahead = 0;
  } else if (law == "centred") {
    rules.look_ahead = 0.5;
  } else if (law == "predictive") {
    rules.look_ahead = 1;
  } else if (law == "speculative") {
    rules.look_ahead = rules.horizon = parameters.number("horizon", run.path());
    // For files without /parameters/contact_margin.
    const double by_gravity =
        rules.horizon * rules.step * std::sqrt(size_of_gravity(run) * run.small_diameter());
    rules.margin =
        std::max(rules.margin, parameters.find_number("contact_margin").value_or(by_gravity));
  } else {
    throw FormatError(fmt::format(
        "{}: /parameters/contact_law is '{}', which this grseg-check does not know; use that of the "
        "version that made the run",
        run.path(), law));
  }
  return rules;
}

}  // namespace grseg
