// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"
#include "sim/solver/solver.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

namespace grseg {

class Geometry;

constexpr double least_gravity = 1e-9, most_gravity = 1e9;  // m/s^2

/// Settings of a simulation of two species of grains within boundaries, in SI. Members are keys of
/// a scene file and options of the same name. sim/scene/keys/keys.cpp lists the keys with their
/// defaults, ranges and help; resolve_scene() sets the members from them.
struct Scene {
  double small_diameter = 0;         // m, nominal diameter d_S of small grains
  double size_ratio = 0;             // nominal d_L/d_S of large and small grains
  double large_diameter = 0;         // m, nominal d_L = size_ratio d_S; not a key
  double spread = 0;                 // (d_max - d_min)/d of the uniform diameters of each species
  double density = 0;                // kg/m^2 (spheres: kg/m^3), of small and boundary grains
  double density_ratio = 0;          // density of large grains over density of small ones
  double phi_large = 0;              // share of large grains in the area (spheres: volume) of all
                                     // mobile grains
  std::optional<long> large_grains;  // number of large grains, given instead
  enum class Initial { large_below, mixed, large_above } initial{};
  const Geometry* geometry = nullptr;
  double depth = 0;        // m, height H0 of the deposited bed above y = 0
  double length = 0;       // m, length of the cell along x
  int dimension = 2;       // 2: discs, 3: spheres
  double width = 0;        // m, of the cell along z, in three dimensions
  double slope = 0;        // degrees, slope of the base at t = 0
  double slope_rate = 0;   // degrees/s, rate of the slope after t = 0
  double gravity = 0;      // m/s^2; in a shear cell for the deposition and the time scale only
  double friction = 0;     // Coulomb's mu
  double restitution = 0;  // Newton's e
  bool rotation = false;
  ContactLaw law{};
  double horizon = 0;  // steps, LawParameters::horizon of the speculative law
  enum class Base { grains, wall } base{};
  double base_diameter = 0;         // m, mean; base_...: see sim/scene/base_row.hpp
  double base_diameter_spread = 0;  // (d_max - d_min)/mean of the diameters
  double base_height_spread = 0;    // m, range of heights
  double base_spacing = 0;          // m, mean distance of centres along x
  double base_spacing_spread = 0;   // (max - min)/mean of the distances
  enum class Lateral { periodic, walls } lateral{}, sides{};  // ends along x, and along z
  enum class Origin { top, centre } origin{};

  double drum_diameter = 0;   // m, inner diameter
  double drum_rate = 0;       // rad/s, angular velocity of the drum, counter-clockwise
  double fill = 0;            // part of the drum's cross-section that the settled bed covers
  double plate_speed = 0;     // m/s, of a shear cell
  double plate_pressure = 0;  // N/m (spheres: Pa), of a shear cell
  double plate_mass = 0;      // kg, of a shear cell
  double column_width = 0;    // m, width of the column before the gate opens
  double outlet = 0;          // m, width of a hopper's outlet
  enum class Outlet { slot, round } outlet_shape{};
  double shake_amplitude = 0;  // m, amplitude of the base's vertical motion
  double shake_frequency = 0;  // Hz

  double duration = 0;        // s, duration of the flow after t = 0
  double frame_interval = 0;  // s, from frame to frame or from burst to burst
  std::int64_t burst = 0;     // number of frames per burst, one per step
  bool keep_deposition = false;
  std::uint64_t seed = 0;
  int threads = 0;  // number of threads; frames do not depend on it

  std::string accuracy;  // draft, standard or reference
  double step = 0;       // s, duration of a time step
  SolverSettings solver;

  int compression = 0;
  bool float32 = false;

  std::int64_t steps_per_frame() const { return std::llround(frame_interval / step); }
  std::int64_t steps_in_all() const { return std::llround(duration / step); }
};

/// Length of the base, m, or its area, m^2.
inline double base_area(const Scene& scene)
{
  return scene.dimension == 3 ? scene.length * scene.width : scene.length;
}

/// Area, m^2, or volume, m^3, of a grain of this nominal diameter, m.
inline double nominal_volume(const Scene& scene, double diameter)
{
  if (scene.dimension == 3) return grain_volume<3>(diameter / 2);
  return std::numbers::pi / 4 * diameter * diameter;
}

/// Parameters of the contact law of a scene.
inline LawParameters law_parameters(const Scene& scene)
{
  return law_parameters(scene.law, scene.horizon, scene.step, scene.gravity, scene.small_diameter);
}

/// Error in the value of a key.
struct SceneError : UsageError {
  SceneError(const std::string& of, const std::string& sentence) : UsageError(sentence), key(of) {}
  std::string key;
};

/// Throws SceneError unless `valid`.
inline void require(bool valid, const std::string& key, const std::string& sentence)
{
  if (!valid) throw SceneError(key, sentence);
}
/// Throws SceneError unless low <= value <= high.
void require_within(double value, const std::string& key, double low, double high);

}  // namespace grseg
