// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/dump_archive.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

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

/// The value of --columns with which the forces on grains add up best, within the tolerance of the
/// format. Nothing where they do with `in_use` already, or with none. The first moments that tell are
/// read, from the files opened again; `gravity` is in the archive's axes.
std::optional<ColumnFit> fitting_columns(const std::vector<std::string>& grain_files,
                                         const std::vector<std::string>& contact_files,
                                         const DumpDialect& dialect, const std::string& in_use,
                                         const std::optional<Vec3>& gravity);

}  // namespace grseg
