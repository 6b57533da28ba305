// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/verification.hpp"

#include "formats/import/common/frame_tools.hpp"
#include "formats/import/verify/judge.hpp"
#include "formats/import/verify/rigid_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

Residual residual_of(const Grains& grains, const std::vector<Vec3>& defect, double scale)
{
  Residual residual;
  std::vector<double> sizes;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g) || std::isnan(defect[g].y())) continue;
    sizes.push_back(defect[g].norm() / scale);
    if (sizes.back() >= residual.largest) residual.largest = sizes.back(), residual.grain = g;
  }
  residual.median = median(sizes);
  residual.unexplained = residual.largest;
  return residual;
}

}  // namespace

Verification::Verification(const Grains& grains, const Box& box, const Vec3& gravity,
                           const OutputAccuracy& accuracy, const Waivers& waivers,
                           const std::array<AxisInArchive, 3>& axes)
    : grains_(grains),
      box_(box),
      gravity_(gravity),
      accuracy_(accuracy),
      waivers_(waivers),
      axes_(axes),
      statistics_(grains, box)
{
}

std::optional<Complaint> Verification::check(const Frame<3>& frame, bool has_images)
{
  numbers_ = {};
  numbers_.step = frame.step;
  numbers_.time = frame.time;
  auto sums = sums_as(frame, nullptr);
  residual_ = residual_with(frame, sums);
  auto complaint = distance_moved(frame);
  const auto also = [&](std::optional<Complaint> other) {
    if (!complaint) complaint = std::move(other);
  };
  also(geometry(frame));
  const auto listed = ListedPairs(frame.contacts);
  if (const auto twice = listed.twice())
    also(Complaint{"contacts",
                   fmt::format("the contact of {} appears twice; each must be listed once",
                               pair_of(twice->first, twice->second))});
  also(completeness(frame, listed));
  also(pull(frame));
  also(balance(frame, sums));
  const auto distance = from_before(frame, sums);
  if (before_ && frame.force.empty() && distance != Distance::step)
    numbers_.change = change_of_sums(grains_, frame, sums.before, sums.now);
  const bool close = distance == Distance::step || distance == Distance::close;
  statistics_.add_to(numbers_, frame, sums.now, before_, close, has_images && !frame.image.empty());
  before_ = {frame, std::move(sums.now)};
  return complaint;
}

/// Names a pair in a message, by ids. `i` and `j` are rows of grains, or negative for a wall.
std::string Verification::pair_of(std::int32_t i, std::int32_t j) const
{
  if (i < 0) std::swap(i, j);
  const auto first = grains_.id[row(i)];
  if (j < 0) return fmt::format("grain {} and wall {}", first, -j - 1);
  return fmt::format("grains {} and {}", first, grains_.id[row(j)]);
}

/// Checks that contacts with a force join grains that touch. Contacts with walls are not checked.
std::optional<Complaint> Verification::geometry(const Frame<3>& frame)
{
  const auto& contacts = frame.contacts;
  std::optional<Complaint> first;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts.j[c] < 0 || contacts.force[c].norm() == 0) continue;
    if (auto complaint = touching(frame, c); !first) first = std::move(complaint);
  }
  return first;
}

std::optional<Complaint> Verification::touching(const Frame<3>& frame, std::size_t c)
{
  const auto& contacts = frame.contacts;
  const auto i = row(contacts.i[c]), j = row(contacts.j[c]);
  const double smaller = std::min(grains_.radius[i], grains_.radius[j]);
  const double radii = grains_.radius[i] + grains_.radius[j];
  const auto between = minimum_image(box_, frame.position[i] - frame.position[j]);
  const double stated = radii + contacts.gap[c], apart = between.norm();
  // Contact dynamics finds contacts at the beginning of a step; grains may separate until its end.
  const double parted = (frame.velocity[i] - frame.velocity[j]).norm() * accuracy_.step;
  const double gap = (contacts.gap[c] - parted) / smaller;
  const double overlap = -contacts.gap[c] / smaller;
  const double distance =
      std::max(std::abs(apart - stated), (contacts.branch[c] - between).norm()) / smaller;
  numbers_.distance = std::max(numbers_.distance, distance);
  numbers_.gap = std::max(numbers_.gap, gap);
  numbers_.overlap = std::max(numbers_.overlap, overlap);
  const bool as_stated = distance <= waivers_.limit("contacts", largest_distance);
  if (!as_stated || gap > waivers_.limit("contacts", widest_gap))
    return Complaint{
        "contacts",
        fmt::format(
            "{} are listed as touching, but their centres are {:.6g} apart and the radii add up "
            "to {:.6g}{}: are i and j their ids, and is the cell periodic as the archive states?",
            pair_of(contacts.i[c], contacts.j[c]), apart, radii,
            as_stated ? "" : fmt::format(" while the archive states a distance of {:.6g}", stated)),
        true};
  if (overlap > waivers_.limit("overlap", deepest_overlap))
    return Complaint{
        "overlap",
        fmt::format(
            "{} overlap by {:.2g} of the smaller radius: their centres are {:.6g} apart and "
            "the radii add up to {:.6g}: are radii and ids read correctly? If "
            "grains are that soft, or the bed is still filling, "
            "--accept-residual overlap={:.1g} accepts it",
            pair_of(contacts.i[c], contacts.j[c]), overlap, apart, radii,
            std::ceil(overlap * 10) / 10),
        true};
  return std::nullopt;
}

std::optional<Complaint> Verification::completeness(const Frame<3>& frame,
                                                    const ListedPairs& listed)
{
  auto found =
      unlisted_pairs_of(grains_, box_, frame, listed, std::max(numbers_.gap, numbers_.distance));
  const bool is_soft = accuracy_.lists_all || found.forces_grow;
  const bool all_balance =
      residual_ && std::max(residual_->worst, residual_->unexplained) <= tolerance();
  if (is_soft || !all_balance) {
    numbers_.unlisted = found.deepest();
    numbers_.unlisted_pairs = static_cast<double>(found.unlisted.size());
    numbers_.unlisted_may_part = !is_soft && !residual_ && !found.unlisted.empty();
  }
  if (all_balance) {
    // Accelerations that follow from velocities contain inner forces; forces in an archive may not.
    if (frame.force.empty())
      found.rigid.clear();
    else
      remove_plugs(grains_, box_, frame, accuracy_.inertia, found.rigid);
  }
  numbers_.rigid = part_of_mobile(grains_, found.rigid);
  const double limit = waivers_.limit("completeness", 0);
  if (numbers_.rigid > fewest_rigid && limit < rigid_bodies)
    return Complaint{
        "completeness",
        fmt::format(
            "{:.0f} % of the grains move as one body with a neighbour without a contact (the "
            "first: {}): rigid bodies of several grains are not supported, because the forces "
            "inside them are unknown; if they are single grains of a bed that turns as a plug, "
            "--accept-residual completeness={:g} accepts it",
            100 * numbers_.rigid, pair_of(found.rigid.front().i, found.rigid.front().j),
            rigid_bodies)};
  if (numbers_.unlisted > limit && numbers_.unlisted_may_part == 0)
    return Complaint{"completeness", missing_rows_of(found), true};
  return std::nullopt;
}

std::string Verification::missing_rows_of(const UnlistedPairs& found) const
{
  const auto& deepest = found.unlisted.front();
  const auto pairs = found.unlisted.size(), at_base = found.at_boundary;
  const auto first = pair_of(deepest.i, deepest.j);
  const auto what =
      pairs == 1 ? fmt::format("{} overlap by {:.2g} of the smaller radius", first, -deepest.gap)
                 : fmt::format("{} pairs overlap (the first: {}, by {:.2g} of the smaller radius)",
                               pairs, first, -deepest.gap);
  return fmt::format(
      "{} and are not in the list of contacts{}; write all contacts, or leave these "
      "out by --accept-residual completeness={:.1g}",
      what,
      at_base == 0       ? ""
      : at_base == pairs ? ": contacts with the base are missing"
                         : fmt::format(": {} of them are contacts with the base", at_base),
      std::ceil(-deepest.gap * 10) / 10);
}

std::optional<Complaint> Verification::pull(const Frame<3>& frame)
{
  const auto& contacts = frame.contacts;
  double pushing = 0, pulling = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double normal = contacts.force[c].dot(contacts.branch[c].normalized());
    (normal < 0 ? pulling : pushing) += std::abs(normal);
  }
  if (pulling > 0) numbers_.pull = pulling / (pulling + pushing);
  if (numbers_.pull <= waivers_.limit("pull", largest_pull)) return std::nullopt;
  auto reading = other_readings(frame);
  if (reading.empty() && 1 - numbers_.pull <= largest_pull)
    reading =
        "; with the opposite sign they push: the force seems to be that on j; exchange i and j";
  return Complaint{"pull",
                   fmt::format("contacts pull: {:.0f} % of the normal force is attractive{}",
                               100 * numbers_.pull, reading),
                   true};
}

auto Verification::sums_as(const Frame<3>& frame, const Reading& reading) const -> Sums
{
  Sums sums;
  const auto of = [&](const ContactList<3>& contacts) {
    Forces forces = contacts.force;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (reading) forces[c] = reading(forces[c], contacts.branch[c].normalized());
      sums.largest = std::max(sums.largest, forces[c].norm());
    }
    return contact_sums(grains_.size(), contacts, forces);
  };
  if (before_ && frame.force.empty()) sums.before = of(before_->contacts);
  sums.largest = 0;
  sums.now = of(frame.contacts);
  return sums;
}

/// Largest possible displacement, in radii, since the previous frame, by the faster velocity.
double Verification::longest_path(const Frame<3>& frame) const
{
  double longest = 0;
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    const double speed = std::max(frame.velocity[g].norm(), before_->velocity[g].norm());
    if (is_mobile(grains_, frame, g) && speed > 0)
      longest = std::max(longest, speed * (frame.time - before_->time) / grains_.radius[g]);
  }
  return longest;
}

/// Median displacement since the previous frame, over the median that the velocities allow. 0 if it
/// is less than a thousandth of the radius, which may be round-off of the text.
double Verification::too_far(const Frame<3>& frame) const
{
  std::vector<double> moved, expected;
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, frame, g) || !is_present(*before_, g)) continue;
    const auto between = minimum_image(box_, frame.position[g] - before_->position[g]);
    const double speed = std::max(frame.velocity[g].norm(), before_->velocity[g].norm());
    moved.push_back(between.norm() / grains_.radius[g]);
    expected.push_back(speed * (frame.time - before_->time) / grains_.radius[g]);
  }
  if (moved.empty()) return 0;
  const double way = median(moved), allowed = median(expected);
  return way > 1e-3 ? way / allowed : 0;
}

/// Complains if grains have moved farther than their velocities allow between two frames with
/// consecutive step numbers.
std::optional<Complaint> Verification::distance_moved(const Frame<3>& frame) const
{
  if (!before_ || frame.step != before_->step + 1) return std::nullopt;
  const double factor = too_far(frame);
  if (factor <= 1 + waivers_.limit("time", farthest - 1)) return std::nullopt;
  return Complaint{
      "time",
      fmt::format("most grains have moved {:.3g} times as far as their velocities allow since the "
                  "previous frame, which seems to be one step earlier: are {} and {} numbers of "
                  "frames instead of steps? Then pass the time "
                  "between two frames with --frame-interval",
                  factor, before_->step, frame.step),
      false};
}

auto Verification::from_before(const Frame<3>& frame, const Sums& sums) const -> Distance
{
  if (!before_) return Distance::none;
  if (accuracy_.step > 0 && frame.step == before_->step + 1)
    return too_far(frame) > farthest ? Distance::far : Distance::step;
  if (!frame.force.empty()) return Distance::far;
  const double change = change_of_sums(grains_, frame, sums.before, sums.now);
  const bool close = change <= close_together && longest_path(frame) <= close_together;
  return close ? Distance::close : Distance::far;
}

auto Verification::defect_of(const Frame<3>& frame, const Sums& sums) const
    -> std::pair<Forces, double>
{
  const bool has_force = !frame.force.empty();
  double scale = sums.largest;
  Forces defect(grains_.size(), Vec3::Constant(NAN));  // NaN for grains absent now or before
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, frame, g)) continue;
    const Vec3 weight = grains_.mass[g] * gravity_;
    scale = std::max(scale, weight.norm());
    if (has_force)
      defect[g] = sums.now[g] + weight - frame.force[g];
    else if (is_present(*before_, g))
      defect[g] = (sums.now[g] + sums.before[g]) / 2 + weight -
                  grains_.mass[g] * (frame.velocity[g] - before_->velocity[g]) /
                      (frame.time - before_->time);
  }
  return {std::move(defect), scale};
}

std::optional<Residual> Verification::residual_with(const Frame<3>& frame, const Sums& sums) const
{
  const bool has_force = !frame.force.empty();
  if (!has_force) {
    const auto distance = from_before(frame, sums);
    if (distance == Distance::none || distance == Distance::far) return std::nullopt;
  }
  auto [defect, scale] = defect_of(frame, sums);
  if (!(scale > 0)) return std::nullopt;
  auto residual = residual_of(grains_, defect, scale);
  if (!has_force) {
    judge_by_velocities(frame, sums, defect, scale, residual);
  } else if (accuracy_.late_forces) {
    residual.late =
        subtract_late_damping(grains_, frame, accuracy_.step, accuracy_.inertia, defect);
    residual.unexplained = residual_of(grains_, defect, scale).largest;
  }
  residual.worst = std::max(residual.worst, residual.unexplained);
  return residual;
}

/// Computes the residuals if the archive has no forces on grains. The mean force over a short time
/// differs from the mean of the two frames by at most half of their difference, which is
/// subtracted. Over several steps a few grains may have collided; then the median grain in contact
/// is judged.
void Verification::judge_by_velocities(const Frame<3>& frame, const Sums& sums,
                                       const Forces& defect, double scale, Residual& residual) const
{
  const bool each = frame.step == before_->step + 1;
  std::vector<double> sizes;
  residual.worst = 0;
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, g) || std::isnan(defect[g].y())) continue;
    const double change = (sums.now[g] - sums.before[g]).norm();
    const double size = std::max(0.0, defect[g].norm() - change / 2) / scale;
    residual.worst = std::max(residual.worst, size);
    if (sums.now[g].norm() > 0) sizes.push_back(size);
  }
  residual.unexplained = each ? residual.worst : median(sizes);
}

std::optional<Complaint> Verification::balance(const Frame<3>& frame, const Sums& sums)
{
  if (!residual_) return std::nullopt;
  numbers_.balance = residual_->unexplained;
  numbers_.balance_worst = residual_->worst;
  for (std::size_t g = 0; g < grains_.size(); ++g)
    numbers_.balance_grains += is_mobile(grains_, frame, g);
  if (residual_->unexplained <= tolerance()) return std::nullopt;
  const auto [defect, scale] = defect_of(frame, sums);
  const Imbalance missing{grains_, box_, frame, defect, tolerance() * scale};
  UnlistedForces cause{other_readings(frame), false};
  if (cause.sentence.empty()) cause.sentence = late_damping(frame, defect, scale);
  if (cause.sentence.empty()) cause = unlisted_forces(missing);
  if (cause.sentence.empty()) cause.sentence = likely_cause(missing, axes_);
  return Complaint{
      "balance",
      fmt::format(
          "the forces on grain {} do not add up: {:.3g} of the largest force is missing "
          "(tolerance {:g}){}{}{}",
          grains_.id[residual_->grain], residual_->largest, tolerance(),
          residual_->late ? fmt::format(", and {:.3g} that damping evaluated half a step late does "
                                        "not explain",
                                        residual_->unexplained)
                          : "",
          frame.force.empty() ? ", with its acceleration from the difference of velocities between "
                                "two frames close together"
                              : "",
          cause.sentence),
      true, cause.acts_as_weight};
}

/// Text about late damping if it explains most of the missing forces; "" if it does not, or if the
/// archive is known to have it.
std::string Verification::late_damping(const Frame<3>& frame, Forces defect, double scale) const
{
  constexpr double most_squares = 0.8;
  constexpr std::ptrdiff_t enough_grains = 10;  // the fit has two parameters
  const auto unbalanced = std::ranges::count_if(
      defect, [&](const Vec3& missing) { return missing.norm() > tolerance() * scale; });
  if (frame.force.empty() || accuracy_.late_forces || unbalanced < enough_grains) return "";
  const auto squares = [&] {
    double sum = 0;
    for (std::size_t g = 0; g < defect.size(); ++g)
      if (is_mobile(grains_, frame, g)) sum += defect[g].squaredNorm();
    return sum;
  };
  const double before = squares();
  subtract_late_damping(grains_, frame, accuracy_.step, accuracy_.inertia, defect);
  if (squares() > (1 - most_squares) * before) return "";
  return fmt::format(
      "; contact forces whose damping is evaluated half a step late, as LAMMPS and LIGGGHTS write "
      "them, explain all but {:.2g} of it",
      residual_of(grains_, defect, scale).largest);
}

/// Text about another meaning of the rows with which grains balance; "" if there is none.
std::string Verification::other_readings(const Frame<3>& frame) const
{
  const std::pair<const char*, Reading> readings[] = {
      {"with the opposite sign: the force seems to be that on j; exchange i and j",
       [](const Vec3& f, const Vec3&) { return Vec3(-f); }},
      {"with half of every force: is each contact in two rows?",
       [](const Vec3& f, const Vec3&) { return Vec3(f / 2); }},
      {"with only the normal part of the forces",
       [](const Vec3& f, const Vec3& n) { return Vec3(f.dot(n) * n); }},
      {"with the tangential part reversed",
       [](const Vec3& f, const Vec3& n) { return Vec3(2 * f.dot(n) * n - f); }},
  };
  for (const auto& [what, reading] : readings) {
    const auto residual = residual_with(frame, sums_as(frame, reading));
    if (residual && residual->unexplained <= tolerance())
      return fmt::format("; they balance to {:.2g} {}", residual->unexplained, what);
  }
  return "";
}

}  // namespace grseg
