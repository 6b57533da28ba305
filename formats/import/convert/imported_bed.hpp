// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/facts/cell_and_walls.hpp"
#include "formats/import/facts/run_facts.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// Map from the archive's id of a grain to its row in the trajectory.
class RowsById {
 public:
  RowsById() = default;
  explicit RowsById(std::vector<std::int64_t> sorted_ids);
  /// The row of the grain with this id; -1 if there is none.
  std::int32_t find(std::int64_t id) const;

 private:
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> dense_;  // row by (id - first id); empty if ids have large gaps
};

/// A periodic direction of the cell, x or z of the flow.
struct Period {
  int direction = 0;    // 0: x, 2: z
  double length = 0;    // length of the period, in the archive's units
  int axis = 0;         // number of the archive's axis that is parallel to the direction
  bool forward = true;  // true: axis and direction point the same way; false: opposite ways
};

/// Properties that all frames of an imported run share: grains, cell and axes, in the archive's
/// units and the axes of the flow. They follow from a frame with all grains: the first of the
/// archive, or the artificial one of a Roster (scan.hpp). Rows are in order of increasing id.
struct ImportedBed {
  /// Throws UsageError if the command line contradicts the grains, FormatError if the grains have
  /// impossible values.
  ImportedBed(const ArchiveFrame& all, const RunFacts& facts, const ImportSettings& settings,
              bool come_and_go = false);

  bool is_boundary(std::size_t row) const { return grains.species[row] == Species::boundary; }
  /// Components of a vector in the axes of the flow; in two dimensions z is 0.
  Vec3 components(const Vec3& vector) const;
  Vec3 spin(const Vec3& angular_velocity) const;
  /// Converts a frame of the archive to a frame of a trajectory (formats/README.md), in the
  /// archive's units. Every frame must have all grains, unless `grains_come_and_go`: then missing
  /// grains are marked as absent. Grain i of a contact is mobile. Contacts of two boundary grains
  /// are left out; the others stay in their order. Throws FormatError naming the frame if grains or
  /// contacts have impossible values, or lack components in three dimensions. Throws OtherGrains if
  /// the frame has fewer or other grains.
  void build(const ArchiveFrame& raw, Frame<3>& frame) const;

  Axes axes;
  Vec3 gravity;
  double step;     // length of an integration step, in the archive's unit of time
  bool has_force;  // true: the archive has the total force on each grain
  bool has_angular_velocity;
  /// True if the archive states how often grains have crossed the periodic cell. Otherwise the
  /// images of frames are 0 for positions within the cell.
  bool counts_periods;
  bool grains_come_and_go;
  Grains grains;
  Box box;
  SpeciesFound species;
  RowsById rows;
  ArchiveGrains known;       // constant properties by row: id, radius, mass, type, fixed
  bool has_new_ids = false;  // true: grains are numbered 1, 2, 3, as the ids exceed 2^31
  std::string cell;          // text: length along x and z and its source, a line each
  /// Coordinates of the run as functions of the archive's: "x = x + 0.05, y = z - 0.1, z = -y".
  std::string coordinates() const;
  double origin = 0;             // height in the archive that becomes y = 0
  Vec3 shift = Vec3::Zero();     // vector to add to positions (components in the axes of the flow):
                                 // y begins at `origin`, and a period begins at 0
  std::vector<Period> periods;   // periodic directions of the cell: none, x, z, or both
  std::vector<WallPlane> walls;  // walls given by --wall

 private:
  void make_grains(const ArchiveFrame& first, const RunFacts& facts,
                   const SpeciesSettings& settings);
  void require_no_other_period(const ArchiveFrame& first) const;
  void make_box(const ArchiveFrame& first);
  double make_length(const ArchiveFrame& first, int direction);
  void find_origin(const ArchiveFrame& first, const std::string& text);
};

/// Text of the option --origin that sets y = 0 at the lowest point of the grains.
std::string proposed_origin(const ArchiveGrains& grains, const Axes& axes);

}  // namespace grseg
