// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <limits>

namespace grseg {

/// How a bed flows when its run ends. All NaN in other geometries, in shaken beds, without gravity
/// onto the base, and without grains.
struct EndOfFlow {
  double mean_velocity = std::numeric_limits<double>::quiet_NaN();  // m/s, along x, by mass
  /// m/s, along x, by mass, of grains less than 2 d_S below the surface of a flat bed (bed_height).
  double surface_velocity = mean_velocity;
  /// Shear stress on base and walls over the pressure on the base, since an earlier time, by the balance
  /// of momentum: tan(slope) minus the acceleration over g cos(slope); and tan(slope).
  double stress_ratio = mean_velocity, slope = mean_velocity;
  double solid_fraction = mean_velocity;  // volume (area) of grains over the volume of a flat bed
  /// Inertial number of a steady chute with this mean velocity U: 5 U d/(2 H sqrt(nu g cos(theta) H)),
  /// d: mean diameter by mass, H: height, nu: solid fraction (Jop, Forterre & Pouliquen, Nature 441,
  /// 727, 2006, with Bagnold's profile).
  double inertial_number = mean_velocity;

  /// True below the inertial number 1e-3, where flows are quasi-static (GDR MiDi, Eur. Phys. J. E 14,
  /// 341, 2004).
  bool is_jammed() const { return inertial_number < 1e-3; }
  /// True if less than 95 % of gravity along the slope is balanced. The bound is a convention.
  bool accelerates() const { return stress_ratio < 0.95 * slope; }
};

/// MeanMotion of the bed at one time.
struct MeanMotion {
  double time = 0, mean_velocity = 0;  // s; m/s along x, by mass
};
template <int D>
MeanMotion motion_of(const Simulation<D>& simulation);

template <int D>
EndOfFlow end_of_flow(const Simulation<D>& simulation, const Scene& scene,
                      const MeanMotion& earlier);

}  // namespace grseg
