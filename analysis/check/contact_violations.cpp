// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/contact_violations.hpp"

#include "analysis/frames/contacts.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
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

namespace {

/// Relative velocities of i against j, m/s, after the step and before it.
template <int D>
struct Approach {
  Vector<D> after, before;
};

template <int D>
Approach<D> approach_of(const Grains& grains, const Frame<D>& frame, std::size_t contact,
                        double step)
{
  Approach<D> relative{Vector<D>::Zero(), Vector<D>::Zero()};
  const auto add = [&](std::size_t g, double sign) {
    const Vector<D> change = step * frame.force[g] / grains.mass[g];
    relative.after += sign * frame.velocity[g];
    relative.before += sign * (frame.velocity[g] - change);
  };
  add(static_cast<std::size_t>(frame.contacts.i[contact]), 1);
  const auto j = frame.contacts.j[contact];
  if (j >= 0) add(static_cast<std::size_t>(j), -1);
  return relative;
}

}  // namespace

template <int D>
void ContactViolations::add(const Grains& grains, const Frame<D>& frame)
{
  const auto& contacts = frame.contacts;
  double scale = 0;
  for (const auto& force : contacts.force) scale = std::max(scale, force.norm());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts.gap[c] < 0) overlap_.add(-contacts.gap[c], frame.time, c);
    if (scale > 0 && bears_force(contacts, c)) add_forces(frame, c, scale);
    if (!frame.force.empty()) add_motion(grains, frame, c);
  }
}

template <int D>
void ContactViolations::add_forces(const Frame<D>& frame, std::size_t contact, double scale)
{
  const auto [n, f_n, f_t] = force_parts(frame.contacts, contact);
  tension_.add(std::max(0.0, -f_n) / scale, frame.time, contact);
  if (rules_.friction)
    coulomb_.add(std::max(0.0, std::abs(f_t) - *rules_.friction * std::max(0.0, f_n)) / scale,
                 frame.time, contact);
}

template <int D>
void ContactViolations::add_motion(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto& contacts = frame.contacts;
  const double gap = contacts.gap[contact], reach = contacts.branch[contact].norm() - gap;
  const Vector<D>& branch = contacts.branch[contact];
  const Vector<D> n = branch.normalized();
  const bool bears = bears_force(contacts, contact);
  const auto relative = approach_of(grains, frame, contact, rules_.step);
  if (bears) {
    const Vector<D> flight = rules_.look_ahead * rules_.step * relative.before;
    // The distance from a straight wall is along its normal.
    const double distance =
        contacts.j[contact] < 0 ? branch.norm() + flight.dot(n) : (branch + flight).norm();
    open_gap_.add(std::max(0.0, distance - reach - rules_.margin), frame.time, contact);
  }
  if (!rules_.restitution) return;
  // Files of other programs may list pairs that are merely close.
  if (gap > 0 && !bears && rules_.horizon == 0) return;
  double least = -*rules_.restitution * relative.before.dot(n);
  if (gap > 0)
    least = std::min(least, rules_.horizon > 0 ? -gap / (rules_.horizon * rules_.step) : 0);
  approach_.add(std::max(0.0, least - relative.after.dot(n)) * rules_.step, frame.time, contact);
}

template void ContactViolations::add(const Grains&, const Frame<2>&);
template void ContactViolations::add(const Grains&, const Frame<3>&);

}  // namespace grseg
