// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// A run of LMGC90, as its files contain it. Bodies and contactors are numbered from 1.

/// A rigid body: a grain, or a wall of one or more contactors.
struct Lmgc90Body {
  double radius = 0;            // m; 0 for a wall
  std::int32_t first_wall = 0;  // of a wall: number of its first contactor among all walls
  int contactors = 0;
  double mass = 0;               // kg; 0 if the files do not tell it
  Vec3 position = Vec3::Zero();  // outputs contain displacements from here
  bool fixed = false;            // true: its velocity is prescribed as 0
  std::string material;
};

struct Lmgc90Bodies {
  std::vector<Lmgc90Body> all;  // body number n is all[n - 1]
  int dimension = 2;            // 3: RBDY3 (spheres), 2: RBDY2 (discs)
  std::vector<std::string> walls;
  std::optional<Vec3> gravity;
  bool know_masses = true;  // of all grains
  std::string path;         // BODIES.DAT
};

/// Reads BODIES.DAT and, if they are beside it, BULK_BEHAV.DAT (densities, gravity) and DRV_DOF.DAT
/// (prescribed velocities). A grain is a body of one disc (DISKx) or sphere (SPHER); JONCx, xKSID,
/// PLANx and DNLYC are walls. Throws FormatError naming file, line and body for others.
Lmgc90Bodies read_lmgc90_bodies(const std::string& path);

struct Lmgc90Step {
  struct Body {
    Vec3 displacement, velocity;  // at the end of the step
    Vec3 spin;                    // rad/s, about the axes of the run
    bool visible = true;          // false: the body does not take part
  };
  /// A pair that LMGC90 watches: a candidate (a grain) and an antagonist.
  struct Pair {
    std::int64_t candidate = 0, antagonist = 0;  // bodies
    std::int64_t contactor = 1;                  // contactor of the antagonist
    Vec3 normal;                                 // unit vector from antagonist to candidate
    Vec3 force;      // force on the candidate: impulse of the step over its length
    double gap = 0;  // gap where contacts of this step were looked for
  };
  double time = 0;     // end of the step, s
  double length = 0;   // s
  double theta = 0.5;  // contacts are looked for at positions x - theta * length * v
  std::vector<Body> bodies;
  std::vector<Pair> pairs;
  std::string place;  // for messages
};

/// The written steps, in order of time.
struct Lmgc90Steps {
  std::vector<std::int64_t> numbers;
  std::function<Lmgc90Step(std::size_t)> read;  // step numbers[k]; FormatError if it is damaged
};

/// Opens an HDF5 file of LMGC90, of its version 0.0 to 0.3.
Lmgc90Steps open_lmgc90_hdf5(const std::string& path);
/// Opens texts DOF.OUT.n, each with Vloc_Rloc.OUT.n in the same folder. They do not tell theta: 1/2.
Lmgc90Steps open_lmgc90_texts(const std::vector<std::string>& paths);

}  // namespace grseg
