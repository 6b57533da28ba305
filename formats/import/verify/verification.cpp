// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/verification.hpp"

#include "formats/import/common/minimum_image.hpp"
#include "formats/import/verify/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace grseg {
namespace {

std::size_t row(std::int32_t index)
{
  return static_cast<std::size_t>(index);
}

template <int D>
Residual residual_of(const Grains& grains, const std::vector<Vector<D>>& defect, double scale)
{
  std::vector<std::pair<double, std::size_t>> sizes;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g) && !std::isnan(defect[g].y()))
      sizes.emplace_back(defect[g].norm() / scale, g);
  if (sizes.empty()) return {};
  const auto largest = *std::max_element(sizes.begin(), sizes.end());
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return {largest.first, middle->first, largest.second, largest.first, 0, std::nullopt};
}

}  // namespace

template <int D>
Verification<D>::Verification(const Grains& grains, const Box& box, const Vector<D>& gravity,
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

template <int D>
std::optional<Complaint> Verification<D>::check(const Frame<D>& frame, bool has_images)
{
  moment_ = {};
  moment_.step = frame.step;
  moment_.time = frame.time;
  auto sums = sums_as(frame, [](const Vector<D>& force, const Vector<D>&) { return force; });
  residual_ = residual_with(frame, sums);
  auto complaint = geometry(frame);
  if (!complaint) complaint = double_rows(frame);
  if (auto other = pull(frame); !complaint) complaint = other;
  if (auto other = balance(frame); !complaint) complaint = other;
  const auto distance = from_before(frame, sums);
  if (before_ && frame.force.empty() && distance != Distance::step)
    moment_.change = change_of_sums(grains_, frame, sums.before, sums.now);
  const bool close = distance == Distance::step || distance == Distance::close;
  statistics_.add_to(moment_, frame, sums.now, before_, close, has_images && !frame.image.empty());
  before_ = {frame.step,  frame.time,  frame.position,      frame.velocity,
             frame.force, frame.image, std::move(sums.now), frame.contacts};
  return complaint;
}

template <int D>
std::string Verification<D>::pair_of(const ContactList<D>& contacts, std::size_t c) const
{
  const auto i = grains_.id[row(contacts.i[c])];
  if (contacts.j[c] < 0) return fmt::format("grain {} and wall {}", i, -contacts.j[c] - 1);
  return fmt::format("grains {} and {}", i, grains_.id[row(contacts.j[c])]);
}

/// Contacts that carry force must join grains that touch. Wall contacts are not checked.
template <int D>
std::optional<Complaint> Verification<D>::geometry(const Frame<D>& frame)
{
  const auto& contacts = frame.contacts;
  std::optional<Complaint> first;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts.j[c] < 0 || contacts.force[c].norm() == 0) continue;
    if (auto complaint = touching(frame, c); !first) first = std::move(complaint);
  }
  return first;
}

template <int D>
std::optional<Complaint> Verification<D>::touching(const Frame<D>& frame, std::size_t c)
{
  const auto& contacts = frame.contacts;
  const auto i = row(contacts.i[c]), j = row(contacts.j[c]);
  const double smaller = std::min(grains_.radius[i], grains_.radius[j]);
  const double radii = grains_.radius[i] + grains_.radius[j];
  const auto between = minimum_image<D>(box_, frame.position[i] - frame.position[j]);
  const double stated = radii + contacts.gap[c], apart = between.norm();
  const double gap = contacts.gap[c] / smaller;
  const double distance =
      std::max(std::abs(apart - stated), (contacts.branch[c] - between).norm()) / smaller;
  moment_.distance = std::max(moment_.distance, distance);
  moment_.gap = std::max(moment_.gap, gap);
  moment_.overlap = std::max(moment_.overlap, -gap);
  const bool as_stated = distance <= waivers_.limit("contacts", largest_distance);
  if (!as_stated || gap > waivers_.limit("contacts", widest_gap))
    return Complaint{
        "contacts",
        fmt::format(
            "{} are listed as touching, but their centres are {:.6g} apart and the radii add up "
            "to {:.6g}{}: are i and j their ids, and is the cell periodic as the archive says?",
            pair_of(contacts, c), apart, radii,
            as_stated ? "" : fmt::format(" while the archive states a distance of {:.6g}", stated)),
        true};
  if (-gap > waivers_.limit("overlap", deepest_overlap))
    return Complaint{
        "overlap",
        fmt::format(
            "{} overlap by {:.2g} of the smaller radius: their centres are {:.6g} apart and "
            "the radii add up to {:.6g}: are radii and ids read as they are meant? Where "
            "grains are that soft, or a bed is being filled, --accept-residual overlap={:.1g} "
            "imports it",
            pair_of(contacts, c), -gap, apart, radii, std::ceil(-gap * 10) / 10),
        true};
  return std::nullopt;
}

template <int D>
std::optional<Complaint> Verification<D>::double_rows(const Frame<D>& frame) const
{
  const auto& contacts = frame.contacts;
  std::vector<std::pair<std::pair<std::int32_t, std::int32_t>, std::size_t>> pairs;
  pairs.reserve(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c)
    pairs.push_back({std::minmax(contacts.i[c], contacts.j[c]), c});
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t k = 1; k < pairs.size(); ++k)
    if (pairs[k].first == pairs[k - 1].first)
      return Complaint{"contacts",
                       fmt::format("the contact of {} appears twice; each must be listed once",
                                   pair_of(contacts, pairs[k].second)),
                       false};
  return std::nullopt;
}

template <int D>
std::optional<Complaint> Verification<D>::pull(const Frame<D>& frame)
{
  const auto& contacts = frame.contacts;
  double pushing = 0, pulling = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double normal = contacts.force[c].dot(contacts.branch[c].normalized());
    (normal < 0 ? pulling : pushing) += std::abs(normal);
  }
  if (pulling > 0) moment_.pull = pulling / (pulling + pushing);
  if (moment_.pull <= waivers_.limit("pull", largest_pull)) return std::nullopt;
  return Complaint{"pull",
                   fmt::format("contacts pull: {:.0f} % of the normal force is attractive{}",
                               100 * moment_.pull, other_readings(frame)),
                   true};
}

template <int D>
auto Verification<D>::sums_as(const Frame<D>& frame, const Reading& reading) const -> Sums
{
  Sums sums;
  const auto of = [&](const ContactList<D>& contacts) {
    Forces forces(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      forces[c] = reading(contacts.force[c], contacts.branch[c].normalized());
      sums.largest = std::max(sums.largest, forces[c].norm());
    }
    return contact_sums(grains_.size(), contacts, forces);
  };
  if (before_ && frame.force.empty()) sums.before = of(before_->contacts);
  sums.largest = 0;
  sums.now = of(frame.contacts);
  return sums;
}

/// By how much a grain can have moved since the moment before, by its faster velocity, in radii.
template <int D>
double Verification<D>::longest_path(const Frame<D>& frame) const
{
  double longest = 0;
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    const double speed = std::max(frame.velocity[g].norm(), before_->velocity[g].norm());
    if (is_mobile(grains_, frame, g) && speed > 0)  // not where it was absent
      longest = std::max(longest, speed * (frame.time - before_->time) / grains_.radius[g]);
  }
  return longest;
}

template <int D>
auto Verification<D>::from_before(const Frame<D>& frame, const Sums& sums) const -> Distance
{
  if (!before_) return Distance::none;
  if (frame.step == before_->step + 1) return Distance::step;
  if (!frame.force.empty()) return Distance::far;
  const double change = change_of_sums(grains_, frame, sums.before, sums.now);
  const bool close = change <= close_together && longest_path(frame) <= close_together;
  return close ? Distance::close : Distance::far;
}

template <int D>
auto Verification<D>::defect_of(const Frame<D>& frame, const Sums& sums) const
    -> std::pair<Forces, double>
{
  const bool has_force = !frame.force.empty();
  double scale = sums.largest;
  Forces defect(grains_.size(), Vector<D>::Constant(NAN));  // also of what is absent, now or before
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, frame, g)) continue;
    const Vector<D> weight = grains_.mass[g] * gravity_;
    scale = std::max(scale, weight.norm());
    if (has_force)
      defect[g] = sums.now[g] + weight - frame.force[g];
    else if (!std::isnan(before_->position[g].y()))
      defect[g] = (sums.now[g] + sums.before[g]) / 2 + weight -
                  grains_.mass[g] * (frame.velocity[g] - before_->velocity[g]) /
                      (frame.time - before_->time);
  }
  return {std::move(defect), scale};
}

template <int D>
std::optional<Residual> Verification<D>::residual_with(const Frame<D>& frame,
                                                       const Sums& sums) const
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

/// A mean force over a short time differs from that of the two moments by half of their difference
/// at most. Over more steps a few grains may have collided meanwhile, but not the median one of those
/// in contact.
template <int D>
void Verification<D>::judge_by_velocities(const Frame<D>& frame, const Sums& sums,
                                          const Forces& defect, double scale,
                                          Residual& residual) const
{
  const bool each = frame.step == before_->step + 1;
  std::vector<double> sizes;
  residual.worst = 0;
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, g) || std::isnan(defect[g].y())) continue;
    const double change = (sums.now[g] - sums.before[g]).norm();
    const double size = std::max(0.0, defect[g].norm() - change / 2) / scale;
    residual.worst = std::max(residual.worst, size);
    if (each || sums.now[g].norm() > 0) sizes.push_back(size);
  }
  if (sizes.empty()) {
    residual.unexplained = 0;
    return;
  }
  const auto place =
      each ? sizes.end() - 1 : sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), place, sizes.end());
  residual.unexplained = *place;
}

template <int D>
std::optional<Complaint> Verification<D>::balance(const Frame<D>& frame)
{
  if (!residual_) return std::nullopt;
  moment_.balance = residual_->unexplained;
  moment_.balance_worst = residual_->worst;
  for (std::size_t g = 0; g < grains_.size(); ++g)
    moment_.balance_grains += is_mobile(grains_, frame, g);
  if (residual_->unexplained <= tolerance()) return std::nullopt;
  auto remedy = other_readings(frame);
  if (remedy.empty()) remedy = cause(frame);
  return Complaint{
      "balance",
      fmt::format("the forces on grain {} do not add up: {:.3g} of the largest force is missing "
                  "(tolerance {:g}){}{}{}",
                  grains_.id[residual_->grain], residual_->largest, tolerance(),
                  residual_->late
                      ? fmt::format(", and {:.3g} that damping evaluated half a step late does not "
                                    "explain",
                                    residual_->unexplained)
                      : "",
                  frame.force.empty()
                      ? ", its acceleration being the difference of velocities between two moments "
                        "that are close together"
                      : "",
                  remedy),
      true};
}

template <int D>
std::string Verification<D>::cause(const Frame<D>& frame) const
{
  const auto sums = sums_as(frame, [](const Vector<D>& force, const Vector<D>&) { return force; });
  const auto [defect, scale] = defect_of(frame, sums);
  return likely_cause<D>(grains_, box_, frame, {defect, tolerance() * scale}, axes_);
}

/// Another meaning of the rows with which the grains balance, if there is one.
template <int D>
std::string Verification<D>::other_readings(const Frame<D>& frame) const
{
  const auto normal = [](const Vector<D>& f, const Vector<D>& n) {
    return Vector<D>(f.dot(n) * n);
  };
  const std::pair<const char*, Reading> readings[] = {
      {"with the opposite sign, the force being that on j: exchange i and j",
       [](const Vector<D>& f, const Vector<D>&) { return Vector<D>(-f); }},
      {"with half of every force: is each contact in two rows?",
       [](const Vector<D>& f, const Vector<D>&) { return Vector<D>(f / 2); }},
      {"with the normal part alone",
       [&](const Vector<D>& f, const Vector<D>& n) { return normal(f, n); }},
      {"with the tangential part reversed",
       [&](const Vector<D>& f, const Vector<D>& n) { return Vector<D>(2 * normal(f, n) - f); }},
  };
  for (const auto& [what, reading] : readings) {
    const auto residual = residual_with(frame, sums_as(frame, reading));
    if (residual && residual->unexplained <= tolerance())
      return fmt::format("; they balance to {:.2g} {}", residual->unexplained, what);
  }
  return "";
}

template class Verification<2>;
template class Verification<3>;

}  // namespace grseg
