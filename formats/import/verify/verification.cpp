// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/verification.hpp"

#include "formats/import/common/minimum_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace grseg {
namespace {

/// In units of the smaller radius: by how much a distance may differ from radii and overlap (digits
/// of the text), and how deep soft grains may overlap and how far apart they may be.
constexpr double distance_tolerance = 0.01, deepest = 0.3, furthest = 0.05;
/// Fraction of the normal force that may pull: damping of soft grains that separate.
constexpr double most_pull = 0.2;

std::size_t row(std::int32_t index)
{
  return static_cast<std::size_t>(index);
}

template <int D>
Residual residual_of(const Grains& grains, const std::vector<Vector<D>>& defect, double scale)
{
  std::vector<std::pair<double, std::size_t>> sizes;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g) && !std::isnan(defect[g].x()))
      sizes.emplace_back(defect[g].norm() / scale, g);
  if (sizes.empty()) return {};
  const auto largest = *std::max_element(sizes.begin(), sizes.end());
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return {largest.first, middle->first, largest.second, largest.first, std::nullopt};
}

}  // namespace

template <int D>
Verification<D>::Verification(const Grains& grains, const Box& box, const Vector<D>& gravity,
                              const OutputAccuracy& accuracy)
    : grains_(grains), box_(box), gravity_(gravity), accuracy_(accuracy)
{
}

template <int D>
std::optional<Complaint> Verification<D>::check(const Frame<D>& frame)
{
  residual_ = residual_with(frame, frame.contacts.force);
  auto complaint = geometry(frame);
  if (!complaint) complaint = double_rows(frame);
  if (!complaint) complaint = pull(frame);
  if (!complaint) complaint = balance(frame);
  if (frame.force.empty())
    before_ = {frame.time, frame.velocity, sums(frame.contacts, frame.contacts.force)};
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
std::optional<Complaint> Verification<D>::geometry(const Frame<D>& frame) const
{
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts.j[c] < 0 || contacts.force[c].norm() == 0) continue;
    const auto i = row(contacts.i[c]), j = row(contacts.j[c]);
    const double smaller = std::min(grains_.radius[i], grains_.radius[j]);
    const double radii = grains_.radius[i] + grains_.radius[j];
    const auto between = minimum_image<D>(box_, frame.position[i] - frame.position[j]);
    const double stated = radii + contacts.gap[c], distance = between.norm();
    const bool as_stated = std::abs(distance - stated) <= distance_tolerance * smaller &&
                           (contacts.branch[c] - between).norm() <= distance_tolerance * smaller;
    const bool touching =
        contacts.gap[c] >= -deepest * smaller && contacts.gap[c] <= furthest * smaller;
    if (as_stated && touching) continue;
    return Complaint{
        fmt::format(
            "{} are listed as touching, but their centres are {:.6g} apart and the radii add up "
            "to {:.6g}{}: are i and j their ids, and is the cell periodic as the archive says?",
            pair_of(contacts, c), distance, radii,
            as_stated ? "" : fmt::format(" while the archive states a distance of {:.6g}", stated)),
        true};
  }
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
      return Complaint{fmt::format("the contact of {} appears twice; each must be listed once",
                                   pair_of(contacts, pairs[k].second)),
                       false};
  return std::nullopt;
}

template <int D>
std::optional<Complaint> Verification<D>::pull(const Frame<D>& frame) const
{
  const auto& contacts = frame.contacts;
  double pushing = 0, pulling = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double normal = contacts.force[c].dot(contacts.branch[c].normalized());
    (normal < 0 ? pulling : pushing) += std::abs(normal);
  }
  if (pulling <= most_pull * (pulling + pushing)) return std::nullopt;
  return Complaint{fmt::format("contacts pull: {:.0f} % of the normal force is attractive{}",
                               100 * pulling / (pulling + pushing), other_readings(frame)),
                   true};
}

template <int D>
std::vector<Vector<D>> Verification<D>::sums(const ContactList<D>& contacts,
                                             const std::vector<Vector<D>>& forces) const
{
  std::vector<Vector<D>> sum(grains_.size(), Vector<D>::Zero());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    sum[row(contacts.i[c])] += forces[c];
    if (contacts.j[c] >= 0) sum[row(contacts.j[c])] -= forces[c];
  }
  return sum;
}

template <int D>
std::optional<Residual> Verification<D>::residual_with(const Frame<D>& frame,
                                                       const std::vector<Vector<D>>& forces) const
{
  const bool has_force = !frame.force.empty();
  if (!has_force && !before_) return std::nullopt;
  const auto sum = sums(frame.contacts, forces);
  double scale = 0;
  for (const auto& force : forces) scale = std::max(scale, force.norm());
  std::vector<Vector<D>> defect(grains_.size(), Vector<D>::Zero());
  // That of a grain which is absent, now or before, is NaN.
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    if (!is_mobile(grains_, g)) continue;
    const Vector<D> weight = grains_.mass[g] * gravity_;
    scale = std::max(scale, weight.norm());
    if (has_force)
      defect[g] = sum[g] + weight - frame.force[g];
    else
      defect[g] = (sum[g] + before_->sums[g]) / 2 + weight -
                  grains_.mass[g] * (frame.velocity[g] - before_->velocity[g]) /
                      (frame.time - before_->time);
  }
  if (!(scale > 0)) return std::nullopt;
  auto residual = residual_of(grains_, defect, scale);
  if (has_force && accuracy_.late_forces) {
    residual.late =
        subtract_late_damping(grains_, frame, accuracy_.step, accuracy_.inertia, defect);
    residual.unexplained = residual_of(grains_, defect, scale).largest;
  }
  return residual;
}

template <int D>
std::optional<Complaint> Verification<D>::balance(const Frame<D>& frame) const
{
  if (!residual_ || residual_->unexplained <= accuracy_.tolerance) return std::nullopt;
  return Complaint{
      fmt::format("the forces on grain {} do not add up: {:.3g} of the largest force is missing "
                  "(tolerance {:g}){}{}{}",
                  grains_.id[residual_->grain], residual_->largest, accuracy_.tolerance,
                  residual_->late
                      ? fmt::format(", and {:.3g} that damping evaluated half a step late does not "
                                    "explain",
                                    residual_->unexplained)
                      : "",
                  frame.force.empty()
                      ? ", its acceleration being the difference of velocities between "
                        "two moments, which need to be close together"
                      : "",
                  other_readings(frame)),
      true};
}

/// Another meaning of the rows with which the grains balance, if there is one.
template <int D>
std::string Verification<D>::other_readings(const Frame<D>& frame) const
{
  using Reading =
      std::pair<const char*, std::function<Vector<D>(const Vector<D>& force, const Vector<D>& n)>>;
  const auto normal = [](const Vector<D>& f, const Vector<D>& n) {
    return Vector<D>(f.dot(n) * n);
  };
  const Reading readings[] = {
      {"with the opposite sign, the force being that on j: exchange i and j",
       [](const Vector<D>& f, const Vector<D>&) { return Vector<D>(-f); }},
      {"with half of every force: is each contact in two rows?",
       [](const Vector<D>& f, const Vector<D>&) { return Vector<D>(f / 2); }},
      {"with the normal part alone",
       [&](const Vector<D>& f, const Vector<D>& n) { return normal(f, n); }},
      {"with the tangential part reversed",
       [&](const Vector<D>& f, const Vector<D>& n) { return Vector<D>(2 * normal(f, n) - f); }},
  };
  const auto& contacts = frame.contacts;
  std::vector<Vector<D>> forces(contacts.size());
  for (const auto& [what, reading] : readings) {
    for (std::size_t c = 0; c < contacts.size(); ++c)
      forces[c] = reading(contacts.force[c], contacts.branch[c].normalized());
    const auto residual = residual_with(frame, forces);
    if (residual && residual->unexplained <= accuracy_.tolerance)
      return fmt::format("; they balance to {:.2g} {}", residual->unexplained, what);
  }
  return "";
}

template class Verification<2>;
template class Verification<3>;

}  // namespace grseg
