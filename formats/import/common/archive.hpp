// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Runs made with other programs, as they stand in their archives: three components, the
/// archive's own axes, ids, order of rows and units. What becomes of them (axes turned, species
/// told apart, branches found, balances verified, a trajectory written) is the same for every
/// format and lies outside its reader.
namespace grseg {

using Vec3 = Eigen::Vector3d;

/// The grains of one moment, in any order; entry g of each array is grain g. Arrays that the
/// archive does not fill stay empty, `id` and `position` are never empty.
struct ArchiveGrains {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> type;  // the archive's own word for a species
  std::vector<double> radius, mass;
  std::vector<Vec3> position;                      // of the centre; may lie outside a periodic cell
  std::vector<std::array<std::int32_t, 3>> image;  // periods to add to `position`
  std::vector<Vec3> velocity;
  std::vector<Vec3> angular_velocity;  // rad/s, right-handed about the archive's axes
  std::vector<Vec3> force;             // total force on the grain, gravity included
  std::vector<std::uint8_t> fixed;     // 1: the archive marks it as held in place

  std::size_t size() const { return id.size(); }
};

/// The contacts of one moment, each once, in any order.
struct ArchiveContacts {
  std::vector<std::int64_t> i, j;  // ids of grains; j is not used at a wall
  std::vector<std::int32_t> wall;  // -1: j is a grain; otherwise the number of a straight wall;
                                   // empty: no contact is one with a wall
  std::vector<Vec3> force;         // ON i FROM j
  std::vector<double> overlap;     // positive where the two overlap
  std::vector<double> distance;    // of the centres; where both are empty it is that of positions
  std::vector<Vec3> branch;  // x_i - x_j, at a wall x_i - contact point; empty: from positions,
                             // which needs contacts with grains alone

  std::size_t size() const { return i.size(); }
};

/// One moment of an archive: grains and contacts of the same time. Of step and time at least one is
/// told; the other follows by the length of a step, which the archive or the command line tells.
struct ArchiveMoment {
  std::optional<std::int64_t> step;
  std::optional<double> time;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // of the cell
  std::array<bool, 3> periodic{};
  ArchiveGrains grains;
  ArchiveContacts contacts;
  std::string place;  // "atoms.dump, line 12": for sentences about this moment
};

/// What an archive says once about its run. What it does not say stays empty and has to come from
/// the command line; nothing is guessed.
struct ArchiveFacts {
  std::optional<double> step;     // of the integration, in units of time
  std::optional<double> density;  // of the grains' matter, per area (discs) or volume (spheres)
  std::optional<Vec3> gravity;
  std::optional<bool> discs;         // false: spheres
  std::optional<std::string> units;  // the program's word for them: "si", "cgs", "lj"
  /// Contact forces are evaluated anew when the velocities have gone half a step further than those
  /// that moved the grains (late_damping.hpp).
  bool forces_are_late = false;
  /// Largest residual of a grain's balance, relative to the largest force of the moment and without
  /// what late damping explains, that faithful output of this program has (digits of its text,
  /// float32), and why.
  double tolerance = 0;
  std::string tolerance_reason;
};

/// Reads an archive moment by moment, in order of time, holding one moment in memory.
class Archive {
 public:
  virtual ~Archive() = default;
  /// Complete after the first `next`.
  virtual const ArchiveFacts& facts() const = 0;
  /// Fills the next moment for which grains and contacts are both there; false at the end.
  /// FormatError naming file, line and remedy where the archive is damaged.
  virtual bool next(ArchiveMoment& moment) = 0;

  /// How the columns of the contacts are read, as --columns would say it; "": the format says it.
  virtual std::string columns() const { return ""; }
  /// Other values of --columns that the contacts may be meant by; tried where `columns()` does not
  /// lead to balanced grains, to tell which does. To be asked for after `next`.
  virtual std::vector<std::string> other_columns() const { return {}; }
  /// What was left out on the way here, a sentence each: moments without partner, rows.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// The archive ends in the middle of a moment. All moments before were whole: with
/// --drop-incomplete the import ends there.
struct TruncatedArchive : FormatError {
  using FormatError::FormatError;
};

/// What a reader is given: files as named on the command line.
struct ArchiveFiles {
  std::vector<std::string> grains, contacts;  // may hold `*`; file_list.hpp
  std::string restart;                        // MercuryDPM's, with what its other files lack
  std::string columns;                        // contact_columns.hpp
};

}  // namespace grseg
