// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace grseg {

/// Tells by the forces on grains whether the columns of the contacts are read right. Where gravity or
/// masses are not known, it is the acceleration that most grains share once contacts are taken off.
class ContactBalance {
 public:
  ContactBalance(const ArchiveGrains& grains, const std::optional<Vec3>& gravity);
  /// | F - sum of contact forces - m g | relative to the median of the grains' largest contact force:
  /// its median over the moving grains with contacts (over all where none moves), since some may touch
  /// walls. A shared acceleration alone makes a half vanish: with it, the third quartile. Nothing where
  /// there are no forces on grains, no contact force, a row that names no grain, or too few grains.
  std::optional<double> residual(const ArchiveContacts& contacts) const;

 private:
  /// By components, of grains with `forces` that contacts leave over.
  Vec3 shared_acceleration(const std::vector<std::size_t>& touched,
                           const std::vector<Vec3>& forces) const;
  double weight(std::size_t grain) const;
  bool moves(std::size_t grain) const;

  const ArchiveGrains& grains_;
  std::optional<Vec3> gravity_;
  bool none_moves_;
  std::unordered_map<std::int64_t, std::size_t> row_of_;
};

}  // namespace grseg
