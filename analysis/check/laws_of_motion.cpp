// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/laws_of_motion.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "formats/core/errors.hpp"
#include "formats/trajectory/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Largest of all contact forces of the frame and all weights of mobile grains, N.
template <int D>
double largest_force(const Grains& grains, const Frame<D>& frame, const Gravity<D>& gravity)
{
  double largest = 0;
  for (const auto& force : frame.contacts.force) largest = std::max(largest, force.norm());
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g)) largest = std::max(largest, grains.mass[g] * gravity.norm());
  return largest;
}

double size_of(double spin)
{
  return std::abs(spin);
}
double size_of(const Vec3& spin)
{
  return spin.norm();
}

}  // namespace

template <int D>
void ForceBalance<D>::add(const Grains& grains, const Frame<D>& frame)
{
  const double scale = largest_force(grains, frame, gravity_);
  if (!frame.force.empty()) add_forces(grains, frame, scale);

  Turning now{frame.step, frame.time, scale * *std::ranges::max_element(grains.radius),
              std::vector<Spin<D>>(grains.size(), no_spin<D>()),
              torques_of(grains, frame.contacts)};
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (is_mobile(grains, g))
      now.inertia_times_spin[g] = grains.mass[g] * grains.radius[g] * grains.radius[g] *
                                  inertia_factor<D> * frame.angular_velocity[g];
    else
      now.torque[g] = no_spin<D>();
  }
  // If a step was divided, the frame has only the torques of its last part: no check is possible.
  const bool is_whole = step_of_force(frame, step_) > 0.99 * step_;
  if (is_whole && !last_.inertia_times_spin.empty()) add_torques(last_, now);
  last_ = std::move(now);
}

template <int D>
void ForceBalance<D>::add_forces(const Grains& grains, const Frame<D>& frame, double scale)
{
  const Vector<D> gravity = gravity_.at(frame.time);
  std::vector<Vector<D>> defect(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g)
    defect[g] = grains.mass[g] * gravity - frame.force[g];
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    defect[static_cast<std::size_t>(contacts.i[c])] += contacts.force[c];
    if (contacts.j[c] >= 0) defect[static_cast<std::size_t>(contacts.j[c])] -= contacts.force[c];
  }
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g))
      forces.add(scale > 0 ? defect[g].norm() / scale : defect[g].norm(), frame.time, g);
}

template <int D>
void ForceBalance<D>::add_torques(const Turning& before, const Turning& after)
{
  if (after.step != before.step + 1) return;
  for (std::size_t g = 0; g < after.torque.size(); ++g) {
    const Spin<D> change = (after.inertia_times_spin[g] - before.inertia_times_spin[g]) / step_;
    const double defect = size_of(Spin<D>(after.torque[g] - change));
    if (std::isnan(defect)) continue;  // the grain is absent in one of the two frames
    torques.add(after.scale > 0 ? defect / after.scale : defect, after.time, g);
  }
}

template class ForceBalance<2>;
template class ForceBalance<3>;

template <int D>
TotalMotion<D> total_motion(const Grains& grains, const Frame<D>& frame, const Box& box,
                            double step)
{
  TotalMotion<D> total;
  Vector<D> force = Vector<D>::Zero();
  total.step = frame.step;
  total.time = frame.time;
  total.grains = which_are_absent(frame);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    total.mass += grains.mass[g];
    total.momentum += grains.mass[g] * frame.velocity[g];
    total.energy += grains.mass[g] * frame.velocity[g].squaredNorm() / 2;
    if (!frame.force.empty()) force += frame.force[g];
    Vector<D> place = frame.position[g];
    place.x() += frame.image[g][0] * box.length_x;
    if constexpr (D == 3) place.z() += frame.image[g][2] * box.length_z;
    total.centre += grains.mass[g] * place;
  }
  if (!(total.mass > 0)) return total;
  total.centre /= total.mass;
  total.speed = (total.momentum - step / 2 * force) / total.mass;
  return total;
}

template <int D>
void MotionBalance<D>::add(const TotalMotion<D>& now, const std::optional<Vector<D>>& base_force)
{
  ++frames_;
  if (!first_) {
    first_ = last_ = now;
    return;
  }
  if (now.grains != last_.grains) {
    same_grains_ = false;
    by_velocity_ += now.centre - last_.centre;
    last_ = now;
    return;
  }
  if (base_force) {
    const auto steps = now.step - last_.step;
    const double between = static_cast<double>(steps) * step_;
    const Vector<D> weight = now.mass * gravity_.mean(now.time, steps, step_);
    const double scale = between * std::max(weight.norm(), base_force->norm());
    const double defect = (now.momentum - last_.momentum - between * (weight + *base_force)).norm();
    momentum_.add(scale > 0 ? defect / scale : defect, now.time, 0);
  }
  by_velocity_ += (now.speed + last_.speed) / 2 * (now.time - last_.time);
  last_ = now;
}

template TotalMotion<2> total_motion(const Grains&, const Frame<2>&, const Box&, double);
template TotalMotion<3> total_motion(const Grains&, const Frame<3>&, const Box&, double);
template class MotionBalance<2>;
template class MotionBalance<3>;

namespace {

template <int D>
double largest_component(const Tensor<D>& t)
{
  return t.cwiseAbs().maxCoeff();
}

/// x_i - x_j (m) to the nearest periodic image of j; at a straight wall the branch.
template <int D>
Vector<D> between_centres(const Frame<D>& frame, const Box& box, std::size_t contact)
{
  const auto j = frame.contacts.j[contact];
  if (j < 0) return frame.contacts.branch[contact];
  Vector<D> apart = frame.position[static_cast<std::size_t>(frame.contacts.i[contact])] -
                    frame.position[static_cast<std::size_t>(j)];
  const auto wrap = [](double& along, double length) {
    along -= length * std::round(along / length);
  };
  if (box.periodic_x) wrap(apart.x(), box.length_x);
  if constexpr (D == 3)
    if (box.periodic_z) wrap(apart.z(), box.length_z);
  return apart;
}

/// By species: sum over contact ends on its grains of (force on the grain) (x) (x - c), N m.
template <int D>
std::vector<Tensor<D>> sums_of_ends(const Grains& grains, const Frame<D>& frame, const Box& box,
                                    std::size_t species)
{
  std::vector<Tensor<D>> sums(species, Tensor<D>::Zero());
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Tensor<D> whole = contacts.force[c] * between_centres(frame, box, c).transpose();
    const double share = share_of_first(grains, contacts, c);
    const auto add_end = [&](std::int32_t grain, double part) {
      const auto g = static_cast<std::size_t>(grain);
      if (grain >= 0 && is_mobile(grains, g))
        sums[static_cast<std::size_t>(grains.species[g])] += part * whole;
    };
    add_end(contacts.i[c], share);
    add_end(contacts.j[c], 1 - share);
  }
  return sums;
}

template <int D>
Tensor<D> sum_of(const std::vector<Tensor<D>>& tensors)
{
  Tensor<D> sum = Tensor<D>::Zero();
  for (const auto& tensor : tensors) sum += tensor;
  return sum;
}

}  // namespace

template <int D>
void StressClosure<D>::add(const Grains& grains, const Frame<D>& frame)
{
  // A single layer that contains the whole bed.
  constexpr double higher_than_any_bed = 1e6;  // m
  PartialContactStress<D> stress(Layers(higher_than_any_bed, 1), Assignment::contact_point, {}, {},
                                 species_);
  stress.add(grains, frame);
  auto sums = stress.mean(0).sums;
  sums.volume = 1;
  const auto by_contact = partial_stress(sums, {PartitionRule::Kind::contact_point});
  const auto by_size = partial_stress(sums, {PartitionRule::Kind::size});
  const auto ends = sums_of_ends(grains, frame, box_, species_);

  const double scale = largest_component<D>(by_contact.total);
  double difference = std::max(largest_component<D>(sum_of<D>(ends) - by_contact.total),
                               largest_component<D>(sum_of<D>(by_size.of_species) - by_size.total));
  for (std::size_t s = 0; s < species_; ++s)
    difference = std::max(difference, largest_component<D>(ends[s] - by_contact.of_species[s]));
  defect.add(scale > 0 ? difference / scale : difference, frame.time, 0);
}

template class StressClosure<2>;
template class StressClosure<3>;

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
  rules.margin = 1e-9 * 2 * *std::ranges::min_element(radius);
  const auto law = parameters.text("contact_law");
  if (law.empty() || law == "touch") {
    rules.look_ahead = 0;
  } else if (law == "centred") {
    rules.look_ahead = 0.5;
  } else if (law == "predictive") {
    rules.look_ahead = 1;
  } else if (law == "speculative") {
    rules.look_ahead = rules.horizon = parameters.number("horizon", run.path());
    // The margin of files without /parameters/contact_margin.
    const double by_gravity =
        rules.horizon * rules.step * std::sqrt(size_of_gravity(run) * run.small_diameter());
    rules.margin =
        std::max(rules.margin, parameters.find_number("contact_margin").value_or(by_gravity));
  } else {
    throw FormatError(fmt::format(
        "{}: /parameters/contact_law is '{}', which this version of grseg-check does not support; "
        "use the version that made the run",
        run.path(), law));
  }
  return rules;
}

namespace {

/// Velocities of grain i relative to grain j, m/s, after and before the step.
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
    if (contacts.gap[c] < 0) overlap.add(-contacts.gap[c], frame.time, c);
    if (scale > 0 && bears_force(contacts, c)) add_forces(frame, c, scale);
    if (!frame.force.empty()) add_motion(grains, frame, c);
  }
}

template <int D>
void ContactViolations::add_forces(const Frame<D>& frame, std::size_t contact, double scale)
{
  const auto [n, f_n, f_t] = force_parts(frame.contacts, contact);
  tension.add(std::max(0.0, -f_n) / scale, frame.time, contact);
  if (rules_.friction)
    coulomb.add(std::max(0.0, std::abs(f_t) - *rules_.friction * std::max(0.0, f_n)) / scale,
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
    // Distance from a straight wall is measured along the normal of the wall.
    const double distance =
        contacts.j[contact] < 0 ? branch.norm() + flight.dot(n) : (branch + flight).norm();
    open_gap.add(std::max(0.0, distance - reach - rules_.margin), frame.time, contact);
  }
  if (!rules_.restitution) return;
  // Imported files may list pairs that are close but do not touch.
  if (gap > 0 && !bears && rules_.horizon == 0) return;
  double least = -*rules_.restitution * relative.before.dot(n);
  if (gap > 0)
    least = std::min(least, rules_.horizon > 0 ? -gap / (rules_.horizon * rules_.step) : 0);
  approach.add(std::max(0.0, least - relative.after.dot(n)) * rules_.step, frame.time, contact);
}

template void ContactViolations::add(const Grains&, const Frame<2>&);
template void ContactViolations::add(const Grains&, const Frame<3>&);

}  // namespace grseg
