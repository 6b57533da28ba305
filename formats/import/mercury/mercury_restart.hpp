// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <string>
#include <vector>

namespace grseg {

/// What MercuryDPM's .restart states beyond its .data and .fstat (DPMBase::write, versions 0.10
/// to 1.0): words and values in turn, a line per object.
struct MercuryRestart {
  struct Particle {
    std::int32_t species = 0;
    double radius = 0;
    double inverse_mass = 0;  // 0: fixed
  };
  int particle_dimensions = 3;  // 2: discs
  double step = 0;
  Vec3 gravity = Vec3::Zero();
  std::vector<double> density;  // by species
  std::vector<Particle> particles;
  std::array<bool, 3> periodic{};
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // along periodic axes
};

/// UsageError where the file is missing, FormatError naming the line where it is damaged or has a
/// periodic boundary that is not along an axis.
MercuryRestart read_mercury_restart(const std::string& path);

}  // namespace grseg
