// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/contact_balance.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

constexpr std::size_t enough_grains =
    8;  // for an acceleration that they share by chance to be unlikely

/// A `share` of the values is smaller; `values` must not be empty.
double quantile(std::vector<double> values, double share)
{
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double median(std::vector<double> values)
{
  return quantile(std::move(values), 0.5);
}

}  // namespace

ContactBalance::ContactBalance(const ArchiveGrains& grains, const std::optional<Vec3>& gravity)
    : grains_(grains), gravity_(grains.mass.empty() ? std::nullopt : gravity)
{
  none_moves_ = std::all_of(grains.velocity.begin(), grains.velocity.end(),
                            [](const Vec3& velocity) { return velocity.isZero(0); });
  row_of_.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) row_of_.emplace(grains.id[g], g);
}

std::optional<double> ContactBalance::residual(const ArchiveContacts& contacts) const
{
  if (grains_.force.empty()) return std::nullopt;
  auto left_over = grains_.force;
  std::vector<double> largest(grains_.size(), 0);
  const auto take_off = [&](std::int64_t id, const Vec3& force) {
    const auto row = row_of_.find(id);
    if (row == row_of_.end()) return false;
    left_over[row->second] -= force;
    largest[row->second] = std::max(largest[row->second], force.norm());
    return true;
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const bool at_wall = !contacts.wall.empty() && contacts.wall[c] >= 0;
    if (!take_off(contacts.i[c], contacts.force[c])) return std::nullopt;
    if (!at_wall && !take_off(contacts.j[c], -contacts.force[c])) return std::nullopt;
  }

  std::vector<std::size_t> touched;
  std::vector<double> scale, missing;
  for (std::size_t g = 0; g < grains_.size(); ++g)
    if (largest[g] > 0 && moves(g)) touched.push_back(g), scale.push_back(largest[g]);
  if (touched.size() < (gravity_ ? 1 : enough_grains)) return std::nullopt;
  const Vec3 g = gravity_ ? *gravity_ : shared_acceleration(touched, left_over);
  missing.reserve(touched.size());
  for (const auto grain : touched) missing.push_back((left_over[grain] - weight(grain) * g).norm());
  const double ratio =
      quantile(std::move(missing), gravity_ ? 0.5 : 0.75) / median(std::move(scale));
  return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

Vec3 ContactBalance::shared_acceleration(const std::vector<std::size_t>& touched,
                                         const std::vector<Vec3>& forces) const
{
  Vec3 shared;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> accelerations;
    accelerations.reserve(touched.size());
    for (const auto grain : touched) accelerations.push_back(forces[grain][axis] / weight(grain));
    shared[axis] = median(std::move(accelerations));
  }
  return shared;
}

/// Grains of a base do not balance.
bool ContactBalance::moves(std::size_t grain) const
{
  return none_moves_ || !grains_.velocity[grain].isZero(0);
}

/// The mass, or what grows like it.
double ContactBalance::weight(std::size_t grain) const
{
  if (!grains_.mass.empty()) return grains_.mass[grain];
  return grains_.radius.empty() ? 1 : std::pow(grains_.radius[grain], 3);
}

}  // namespace grseg
