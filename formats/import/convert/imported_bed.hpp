// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/convert/rows_by_id.hpp"
#include "formats/import/facts/run_facts.hpp"
#include "formats/import/facts/wall_planes.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Along x or z the cell is periodic.
struct Period {
  int direction = 0;    // 0: x, 2: z
  double length = 0;    // in the archive's units
  int axis = 0;         // of the archive
  bool forward = true;  // along it; otherwise against it
};

/// What all frames of an imported run share: its grains, cell and axes, found from a moment with all
/// grains (the first of the archive, or a Roster's), in the archive's units and the axes of the
/// flow. Rows are grains by increasing id.
struct ImportedBed {
  /// UsageError where the command line does not fit the grains, FormatError where the grains are
  /// impossible.
  ImportedBed(const ArchiveMoment& all, const RunFacts& facts, const ImportSettings& settings);

  bool is_boundary(std::size_t row) const { return grains.species[row] == Species::boundary; }

  Axes axes;
  Grains grains;
  Box box;
  SpeciesFound species;
  RowsById rows;
  ArchiveGrains known;       // by row, what a grain keeps: id, radius, mass, type, fixed
  bool has_new_ids = false;  // those of the archive do not fit a trajectory: 1, 2, 3 in their order
  std::string cell;          // how long it is along x and z and who says so, a line each
  double origin = 0;         // height in the archive that is y = 0
  Vec3 shift = Vec3::Zero();     // to be added to components of positions
  std::vector<Period> periods;   // of the cell: none, along x, along z, or along both
  std::vector<WallPlane> walls;  // of --wall

 private:
  void make_grains(const ArchiveMoment& first, const RunFacts& facts,
                   const SpeciesSettings& settings);
  void require_no_other_period(const ArchiveMoment& first) const;
  void make_box(const ArchiveMoment& first);
  double make_length(const ArchiveMoment& first, int direction);
  void find_origin(const ArchiveMoment& first, const std::string& text);
};

/// The option that puts y = 0 at the lowest point of the grains.
std::string proposed_origin(const ArchiveGrains& grains, const Axes& axes);

}  // namespace grseg
