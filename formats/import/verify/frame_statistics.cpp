// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/frame_statistics.hpp"

#include "formats/import/common/frame_tools.hpp"
#include "formats/import/verify/check_context.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// A force or velocity is steady if it changes by less than this fraction between two frames. Their
/// mean then differs from the mean over the time between them by at most half of this fraction.
constexpr double steady = 0.2;
/// Sine of the largest angle between the change of velocity in free flight and the force.
constexpr double largest_sine = 0.05;
/// A bed at rest oscillates, with amplitudes below the overlaps, and frames may show any phase: the
/// mean velocity of two frames is then not the mean over the time between them. Oscillation is
/// excluded if grains have moved by has_moved diameters (root mean square), or if the frames are at
/// most no_swing steps apart, which is half of a collision.
constexpr double has_moved = 0.1;
constexpr std::int64_t no_swing = 10;
/// Largest displacement of a grain, as a fraction of the period, if the archive has no images.
constexpr double share_of_period = 0.25;
/// For a normal distribution: standard deviation over median absolute deviation; and standard error
/// of the median, times the root of the number of values, over standard deviation.
constexpr double deviation_of_normal = 1.4826, error_of_median = 1.2533;

bool is_steady(const Vec3& before, const Vec3& now)
{
  const double mean = (before + now).norm() / 2;
  return mean > 0 && (now - before).norm() <= steady * mean;
}

bool is_along(const Vec3& change, const Vec3& force)
{
  return change.dot(force) >
         std::sqrt(1 - largest_sine * largest_sine) * change.norm() * force.norm();
}

/// Sum of the magnitudes of the contact forces on each grain.
std::vector<double> sizes_of_forces(std::size_t grains, const ContactList<3>& contacts)
{
  std::vector<double> sizes(grains);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double size = contacts.force[c].norm();
    sizes[row(contacts.i[c])] += size;
    if (contacts.j[c] >= 0) sizes[row(contacts.j[c])] += size;
  }
  return sizes;
}

}  // namespace

std::vector<Vec3> contact_sums(std::size_t grains, const ContactList<3>& contacts,
                               const std::vector<Vec3>& forces)
{
  std::vector<Vec3> sum(grains, Vec3::Zero());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    sum[row(contacts.i[c])] += forces[c];
    if (contacts.j[c] >= 0) sum[row(contacts.j[c])] -= forces[c];
  }
  return sum;
}

double change_of_sums(const Grains& grains, const Frame<3>& frame, const std::vector<Vec3>& before,
                      const std::vector<Vec3>& now)
{
  const auto sizes = sizes_of_forces(grains.size(), frame.contacts);
  std::vector<double> changes, forces;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const double change = (now[g] - before[g]).norm();
    if (!is_mobile(grains, g) || !(sizes[g] > 0 || change > 0)) continue;
    changes.push_back(change);
    forces.push_back(sizes[g]);
  }
  const double change = median(changes), force = median(forces);
  if (!(change > 0)) return 0;
  return force > 0 ? change / force : 1;
}

FrameStatistics::FrameStatistics(const Grains& grains, const Box& box)
    : grains_(grains), box_(box), split_(split_of_sizes(grains))
{
  double sum = 0, count = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) sum += 2 * grains.radius[g], ++count;
  diameter_ = count > 0 ? sum / count : 1;
}

bool FrameStatistics::is_in(Group group, std::size_t grain) const
{
  if (group == Group::all) return true;
  return split_ > 0 && (grains_.radius[grain] >= split_) == (group == Group::larger);
}

/// Acceleration of every grain minus its contact forces over mass: an estimate of gravity. NaN if
/// it is unknown, or if a wall's force was inferred from the grain.
auto FrameStatistics::weights(const Frame<3>& frame, const Vectors& sums,
                              const std::optional<FrameBefore>& before) const -> Vectors
{
  const bool has_force = !frame.force.empty();
  Vectors weights(grains_.size(), Vec3::Constant(NAN));
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, frame, g)) continue;
    if (left_out_ && g < left_out_->size() && (*left_out_)[g] != 0) continue;
    if (has_force)
      weights[g] = (frame.force[g] - sums[g]) / grains_.mass[g];
    else if (before && is_present(*before, g))
      weights[g] = (frame.velocity[g] - before->velocity[g]) / (frame.time - before->time) -
                   (sums[g] + before->sums[g]) / (2 * grains_.mass[g]);
  }
  return weights;
}

GravityEstimate FrameStatistics::by_median(Group group, const Vectors& weights) const
{
  std::vector<std::size_t> members;
  for (std::size_t g = 0; g < weights.size(); ++g)
    if (is_in(group, g) && !std::isnan(weights[g].y())) members.push_back(g);
  GravityEstimate estimate;
  estimate.grains = static_cast<double>(members.size());
  if (members.empty()) return estimate;
  double squares = 0;
  std::vector<double> values(members.size());
  for (int k = 0; k < box_.dimension; ++k) {
    std::transform(members.begin(), members.end(), values.begin(),
                   [&](std::size_t g) { return weights[g][k]; });
    const double middle = median(values);
    estimate.gravity[k] = middle;
    for (auto& value : values) value = std::abs(value - middle);
    squares += std::pow(median(values), 2);
  }
  estimate.error = error_of_median * deviation_of_normal * std::sqrt(squares / estimate.grains);
  return estimate;
}

/// Mean over the grains of a group, weighted by mass, so that the forces between them cancel.
GravityEstimate FrameStatistics::by_mean(Group group, const Vectors& weights) const
{
  GravityEstimate estimate;
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (std::size_t g = 0; g < weights.size(); ++g) {
    if (!is_in(group, g) || std::isnan(weights[g].y())) continue;
    sum += grains_.mass[g] * weights[g];
    mass += grains_.mass[g];
    ++estimate.grains;
  }
  if (mass > 0) estimate.gravity = sum / mass;
  return estimate;
}

double FrameStatistics::acceleration(const Frame<3>& frame) const
{
  const auto sizes = sizes_of_forces(grains_.size(), frame.contacts);
  std::vector<double> values;
  for (std::size_t g = 0; g < sizes.size(); ++g)
    if (is_mobile(grains_, frame, g)) values.push_back(sizes[g] / grains_.mass[g]);
  return median(values);
}

/// True for each grain without contact force in both frames.
std::vector<bool> free_grains(const Frame<3>& frame, const std::vector<Vec3>& sums,
                              const FrameBefore& before)
{
  std::vector<bool> is_free(sums.size());
  for (std::size_t g = 0; g < sums.size(); ++g)
    is_free[g] = is_present(frame, g) && is_present(before, g) && sums[g].isZero(0) &&
                 before.sums[g].isZero(0);
  return is_free;
}

/// Adds displacements and velocities of grains whose velocity is steady, or changes along the force
/// in free flight: then the mean velocity of two frames is the mean over the time between them.
void FrameStatistics::add_motion(SlopeSums& all, const Frame<3>& frame, const FrameBefore& before,
                                 const std::vector<bool>& is_free, bool has_images) const
{
  SlopeSums sums;
  const double time = frame.time - before.time;
  const double lengths[] = {box_.length_x, 0, box_.length_z};
  const bool periodic[] = {box_.periodic_x, false, box_.periodic_z};
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, frame, g) || !is_present(before, g)) continue;
    const bool falls = is_free[g] && !frame.force.empty() &&
                       is_along(frame.velocity[g] - before.velocity[g], frame.force[g]);
    if (!falls && !is_steady(before.velocity[g], frame.velocity[g])) continue;
    const Vec3 expected = (before.velocity[g] + frame.velocity[g]) / 2 * time;
    Vec3 moved = frame.position[g] - before.position[g];
    bool known = true;
    for (int k = 0; k < 3; ++k) {
      if (!periodic[k]) continue;
      const auto axis = static_cast<std::size_t>(k);
      if (has_images) moved[k] += lengths[k] * (frame.image[g][axis] - before.image[g][axis]);
      known = known && (has_images || std::abs(expected[k]) <= share_of_period * lengths[k]);
    }
    if (!has_images) moved = minimum_image(box_, moved);
    if (known) sums.add(expected / diameter_, moved / diameter_);
  }
  if (frame.step <= before.step + no_swing || sums.yy >= has_moved * has_moved * sums.grains)
    all += sums;
}

/// Adds forces and accelerations of grains with a steady force that have no contacts, or if frames
/// are consecutive steps: in a collision the mean of two forces is less than the force between.
void FrameStatistics::add_inertia(SlopeSums& sums, const Frame<3>& frame, const FrameBefore& before,
                                  const std::vector<bool>& is_free) const
{
  if (frame.force.empty()) return;
  const bool each_step = frame.step == before.step + 1;
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, frame, g) || !is_present(before, g) || !(each_step || is_free[g]) ||
        !is_steady(before.force[g], frame.force[g]))
      continue;
    sums.add((frame.velocity[g] - before.velocity[g]) / (frame.time - before.time),
             (before.force[g] + frame.force[g]) / (2 * grains_.mass[g]));
  }
}

void FrameStatistics::add_to(CheckNumbers& numbers, const Frame<3>& frame, const Vectors& sums,
                             const std::optional<FrameBefore>& before, bool close,
                             bool has_images) const
{
  numbers.acceleration = acceleration(frame);
  auto weights = this->weights(frame, sums, before);
  const bool medians = close || !frame.force.empty();
  numbers.medians = medians ? 1 : 0;
  if (medians)
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      if (frame.contacts.j[c] < 0) weights[row(frame.contacts.i[c])].setConstant(NAN);
  const auto estimate = [&](Group group) {
    return medians ? by_median(group, weights) : by_mean(group, weights);
  };
  numbers.all = estimate(Group::all);
  numbers.smaller = estimate(Group::smaller);
  numbers.larger = estimate(Group::larger);
  if (!before) return;
  const auto is_free = free_grains(frame, sums, *before);
  add_motion(numbers.motion, frame, *before, is_free, has_images);
  add_inertia(numbers.force, frame, *before, is_free);
}

}  // namespace grseg
