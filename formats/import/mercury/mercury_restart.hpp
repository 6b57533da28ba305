// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The vector of the three numbers numbers[first] to numbers[first + 2].
inline Vec3 three(const std::vector<double>& numbers, std::size_t first)
{
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// The content of a .restart of MercuryDPM. Three versions of the file are in use:
///   MercuryDPM, followed by the program's version (since 2018), and restart_version 1.0 (before):
///       alternating words and values, a line per object (DPMBase::write); the last block,
///       Interactions, contains the contacts. Written at the beginning of a time step: forces
///       belong to the positions, and to the velocities of half a step earlier.
///   restart_version 3 and 2 (until 2013): grains as rows of numbers, without ids and contacts.
struct MercuryRestart {
  struct Particle {
    std::int64_t id = 0;  // id; in versions 3 and 2 the number of the row
    std::int32_t species = 0;
    double radius = 0;
    double inverse_mass = 0;  // 1/mass; 0: the particle is fixed
    Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();
    Vec3 force = Vec3::Zero();  // total force, gravity included; not in versions 3 and 2
  };
  /// A contact of a particle with another, or with a wall.
  struct Interaction {
    std::int64_t i = 0, j = 0;  // ids of the particles, or of particle and wall
    bool wall = false;          // true: j is a wall
    Vec3 force = Vec3::Zero();  // force on i
    std::optional<Vec3> point;  // contact point, r_i - overlap/2 from the centre of i; since 2016
  };
  struct Wall {
    std::string kind;  // kind of the wall: "InfiniteWall"
    Vec3 position = Vec3::Zero();
    std::optional<Vec3> normal;  // normal, pointing into the wall; only in files until 2015
  };
  int positional = 0;           // version 3 or 2 (rows of numbers); 0: words and values
  int particle_dimensions = 3;  // 2: discs, 3: spheres
  double step = 0, time = 0;
  Vec3 gravity = Vec3::Zero();
  Vec3 domain_low = Vec3::Zero(), domain_high = Vec3::Zero();
  std::vector<double> density;         // density by species
  std::map<std::int64_t, Wall> walls;  // walls by id
  std::vector<Particle> particles;     // particles in the order of the rows of .data
  std::vector<Interaction> interactions;
  std::array<bool, 3> periodic{};
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // bounds of the cell along periodic axes
  bool removes_grains = false;                   // true: a boundary deletes grains

  /// True if each particle's id is the number of its row. Removal of a grain makes it false.
  bool ids_are_rows() const;
  bool discs() const { return particle_dimensions == 2; }
  /// Mass of a particle; for a fixed particle it follows from the density.
  double mass_of(const Particle& particle) const;
};

enum class MercuryBlocks { up_to_particles, all };

/// Reads a .restart file. Objects of unknown kinds (walls, boundaries that are not periodic,
/// species) are ignored. Throws UsageError if the file is missing, TruncatedArchive if it ends
/// early, FormatError naming the line if it is damaged, or has grains or periodic boundaries that
/// cannot be imported.
MercuryRestart read_mercury_restart(const std::string& path, MercuryBlocks blocks);

/// True if the file begins like a .restart.
bool is_mercury_restart(const std::string& path);

}  // namespace grseg
