// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// A vector of the numbers from `first` on.
inline Vec3 three(const std::vector<double>& numbers, std::size_t first)
{
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// The content of a .restart of MercuryDPM. Three versions are in use:
///   MercuryDPM, with any version of the program (since 2018), and restart_version 1.0 (before):
///       words and values in turn, a line per object (DPMBase::write); the last block, Interactions,
///       holds the contacts. Written at the beginning of a time step: forces belong to the positions,
///       and to velocities half a step before.
///   restart_version 3 and 2 (until 2013): grains as rows of numbers, without ids and contacts.
struct MercuryRestart {
  struct Particle {
    std::int64_t id = 0;  // its row in versions 3 and 2
    std::int32_t species = 0;
    double radius = 0;
    double inverse_mass = 0;  // 0: fixed
    Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();
    Vec3 force = Vec3::Zero();  // with gravity; not in versions 3 and 2
  };
  /// A contact of a particle with another, or with a wall.
  struct Interaction {
    std::int64_t i = 0, j = 0;  // ids
    bool wall = false;          // j is one
    Vec3 force = Vec3::Zero();  // on i
    std::optional<Vec3> point;  // r_i - overlap/2 from the centre of i; not until 2015
  };
  struct Wall {
    std::string kind;  // "InfiniteWall"
    Vec3 position = Vec3::Zero();
    std::optional<Vec3> normal;  // into the wall; stated until 2015
  };
  int positional = 0;           // version 3 or 2 of them; 0: words and values
  int particle_dimensions = 3;  // 2: discs
  double step = 0, time = 0;
  Vec3 gravity = Vec3::Zero();
  Vec3 domain_low = Vec3::Zero(), domain_high = Vec3::Zero();
  std::vector<double> density;         // by species
  std::map<std::int64_t, Wall> walls;  // by id
  std::vector<Particle> particles;     // in the order of rows of .data
  std::vector<Interaction> interactions;
  std::array<bool, 3> periodic{};
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // along periodic axes
  bool removes_grains = false;                   // there is a boundary that deletes them

  /// Rows are ids where no grain has ever been removed.
  bool ids_are_rows() const;
  bool discs() const { return particle_dimensions == 2; }
  /// Mass of a particle; of a fixed one by its density.
  double mass_of(const Particle& particle) const;
};

enum class MercuryBlocks { up_to_particles, all };

/// Objects of an unknown kind (walls, boundaries that are not periodic, species) are passed over.
/// UsageError where the file is missing, TruncatedArchive where it ends early, FormatError naming
/// the line where it is damaged, or has grains or periods that cannot be imported.
MercuryRestart read_mercury_restart(const std::string& path, MercuryBlocks blocks);

/// True where the file begins as a .restart does.
bool is_mercury_restart(const std::string& path);

}  // namespace grseg
