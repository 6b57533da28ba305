// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <algorithm>
#include <map>
#include <vector>

/// Newton's law in the frames of an archive.
namespace grseg::archive_balance {

inline std::vector<ArchiveFrame> all_of(Archive& archive)
{
  std::vector<ArchiveFrame> frames;
  for (ArchiveFrame frame; archive.next(frame);) frames.push_back(frame);
  return frames;
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
inline std::vector<Vec3> contact_forces(const ArchiveFrame& frame)
{
  const auto entry = entries(frame.grains);
  std::vector<Vec3> sum(frame.grains.size(), Vec3::Zero());
  for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
    sum[entry.at(frame.contacts.i[c])] += frame.contacts.force[c];
    if (!at_wall(frame.contacts, c)) sum[entry.at(frame.contacts.j[c])] -= frame.contacts.force[c];
  }
  return sum;
}

/// Largest |contact forces + m g - force| of a grain that is not held, divided by the largest
/// contact force or weight.
inline double residual(const ArchiveFrame& frame, const Vec3& gravity)
{
  const auto& grains = frame.grains;
  const auto sum = contact_forces(frame);
  double worst = 0, scale = largest_force(frame.contacts);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!grains.fixed.empty() && grains.fixed[g]) continue;
    const Vec3 weight = grains.mass[g] * gravity;
    worst = std::max(worst, (sum[g] + weight - grains.force[g]).norm());
    scale = std::max(scale, weight.norm());
  }
  return worst / scale;
}

}  // namespace grseg::archive_balance
