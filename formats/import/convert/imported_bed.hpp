// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/facts/cell_and_walls.hpp"
#include "formats/import/facts/run_facts.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// Rows of the trajectory by ids of the archive.
class RowsById {
 public:
  RowsById() = default;
  explicit RowsById(std::vector<std::int64_t> sorted_ids);
  /// -1 where no grain has this id.
  std::int32_t find(std::int64_t id) const;

 private:
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> dense_;  // rows by id - first id, where ids are close together
};

/// Along x or z the cell is periodic.
struct Period {
  int direction = 0;    // 0: x, 2: z
  double length = 0;    // in the archive's units
  int axis = 0;         // of the archive
  bool forward = true;  // along it; otherwise against it
};

/// The common properties of all frames of an imported run: grains, cell and axes, found from a
/// moment with all grains (the first of the archive, or a Roster's), in the archive's units and the
/// axes of the flow. Rows are grains by increasing id.
struct ImportedBed {
  /// UsageError where the command line does not fit the grains, FormatError where the grains are
  /// impossible.
  ImportedBed(const ArchiveMoment& all, const RunFacts& facts, const ImportSettings& settings,
              bool come_and_go = false);

  bool is_boundary(std::size_t row) const { return grains.species[row] == Species::boundary; }
  /// A vector of the archive in the axes of the flow; in two dimensions the part in its plane.
  Vec3 components(const Vec3& vector) const;
  Vec3 spin(const Vec3& angular_velocity) const;
  /// Makes a moment of the archive a frame of a trajectory (formats/README.md), in the archive's
  /// units. Every moment must have all grains, unless they come and go: then a grain that a moment
  /// lacks is absent in its frame. Grain i of a contact is mobile; contacts between two boundary
  /// grains are left out; the order of contacts is kept. FormatError naming the moment where grains
  /// or contacts are impossible, or lack components in three dimensions; OtherGrains where a moment
  /// has not all grains, or others.
  void build(const ArchiveMoment& moment, Frame<3>& frame) const;

  Axes axes;
  Vec3 gravity;
  double step;     // of the integration
  bool has_force;  // on grains
  /// True where images of frames come from the archive. Where it does not tell how often grains
  /// have crossed a period, images are 0 for positions within the cell.
  bool counts_periods;
  bool grains_come_and_go;
  Grains grains;
  Box box;
  SpeciesFound species;
  RowsById rows;
  ArchiveGrains known;           // by row, what a grain keeps: id, radius, mass, type, fixed
  bool has_new_ids = false;      // 1, 2, 3 in order, as the archive's ids do not fit a trajectory
  std::string cell;              // how long it is along x and z and who says so, a line each
  double origin = 0;             // height in the archive that is y = 0
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
