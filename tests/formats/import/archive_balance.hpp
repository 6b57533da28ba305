// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <algorithm>
#include <map>
#include <vector>

/// Newton's law in the frames of an archive.
namespace grseg::archive_balance {

inline std::vector<ArchiveMoment> all_of(Archive& archive)
{
  std::vector<ArchiveMoment> moments;
  for (ArchiveMoment moment; archive.next(moment);) moments.push_back(moment);
  return moments;
}

/// Entry of each grain, by its id.
inline std::map<std::int64_t, std::size_t> entries(const ArchiveGrains& grains)
{
  std::map<std::int64_t, std::size_t> entry;
  for (std::size_t g = 0; g < grains.size(); ++g) entry[grains.id[g]] = g;
  return entry;
}

inline bool at_wall(const ArchiveContacts& contacts, std::size_t c)
{
  return !contacts.wall.empty() && contacts.wall[c] >= 0;
}

inline double largest_force(const ArchiveContacts& contacts)
{
  double largest = 0;
  for (const auto& force : contacts.force) largest = std::max(largest, force.norm());
  return largest;
}

/// Sum of the contact forces on each grain.
inline std::vector<Vec3> contact_forces(const ArchiveMoment& moment)
{
  const auto entry = entries(moment.grains);
  std::vector<Vec3> sum(moment.grains.size(), Vec3::Zero());
  for (std::size_t c = 0; c < moment.contacts.size(); ++c) {
    sum[entry.at(moment.contacts.i[c])] += moment.contacts.force[c];
    if (!at_wall(moment.contacts, c))
      sum[entry.at(moment.contacts.j[c])] -= moment.contacts.force[c];
  }
  return sum;
}

/// Largest |contact forces + m g - force| of a grain that is not held, divided by the largest
/// contact force or weight.
inline double residual(const ArchiveMoment& moment, const Vec3& gravity)
{
  const auto& grains = moment.grains;
  const auto sum = contact_forces(moment);
  double worst = 0, scale = largest_force(moment.contacts);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!grains.fixed.empty() && grains.fixed[g]) continue;
    const Vec3 weight = grains.mass[g] * gravity;
    worst = std::max(worst, (sum[g] + weight - grains.force[g]).norm());
    scale = std::max(scale, weight.norm());
  }
  return worst / scale;
}

}  // namespace grseg::archive_balance
