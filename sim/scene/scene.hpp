// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"
#include "sim/solver/solver.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace grseg {

class Geometry;

/// Grains of two species and what bounds them, as the user asks for it, in SI. Members are keys of
/// a scene file and options of the same name; sim/scene/keys/keys.cpp lists the keys with their
/// defaults, ranges and help, and resolve_scene fills a scene from them.
struct Scene {
  double small_diameter = 0;         // m, nominal d_S
  double size_ratio = 0;             // nominal d_L/d_S
  double large_diameter = 0;         // m, nominal d_L: no key, size_ratio times d_S
  double spread = 0;                 // (d_max - d_min)/d of each species, uniform
  double density = 0;                // kg/m^2, of the small grains and of the boundary
  double density_ratio = 0;          // of the large grains over that
  double phi_large = 0;              // share of the large grains in the area of all grains
  std::optional<long> large_grains;  // their number, where it is given instead
  enum class Initial { large_below, mixed, large_above } initial{};
  const Geometry* geometry = nullptr;
  double depth = 0;       // m, height H0 of the deposited bed above y = 0
  double length = 0;      // m, of the cell
  double slope = 0;       // degrees, at t = 0
  double slope_rate = 0;  // degrees/s, from then on
  double gravity = 0;     // m/s^2; of a shear cell: of its deposition, and of its time scale
  double friction = 0;
  double restitution = 0;  // Newton's e
  bool rotation = false;
  ContactLaw law{};
  double horizon = 0;  // steps, of the speculative law
  enum class Base { grains, wall } base{};
  double base_diameter = 0;         // m, mean; all of the base: sim/scene/base_row.hpp
  double base_diameter_spread = 0;  // (d_max - d_min)/mean
  double base_height_spread = 0;    // m
  double base_spacing = 0;          // m, mean along x
  double base_spacing_spread = 0;   // (max - min)/mean
  enum class Lateral { periodic, walls } lateral{};
  enum class Origin { top, centre } origin{};

  double drum_diameter = 0;    // m, between the beads
  double drum_rate = 0;        // rad/s, counter-clockwise
  double fill = 0;             // share of the drum under the settled bed
  double plate_speed = 0;      // m/s
  double plate_pressure = 0;   // N/m
  double plate_mass = 0;       // kg
  double column_width = 0;     // m, before the gate opens
  double outlet = 0;           // m
  double shake_amplitude = 0;  // m, of the base, vertical
  double shake_frequency = 0;  // Hz

  double duration = 0;        // s after the tilt
  double frame_interval = 0;  // s
  std::int64_t burst = 0;     // consecutive frames, one per step, at each interval
  bool keep_deposition = false;
  std::uint64_t seed = 0;
  int threads = 0;  // frames do not depend on it

  std::string accuracy;  // draft, standard, reference
  double step = 0;       // s
  SolverSettings solver;

  int compression = 0;
  bool float32 = false;

  std::int64_t steps_per_frame() const { return std::llround(frame_interval / step); }
  std::int64_t steps_in_all() const { return std::llround(duration / step); }
};

/// Numbers of the contact law of a scene.
inline LawParameters law_parameters(const Scene& scene)
{
  return law_parameters(scene.law, scene.horizon, scene.step, scene.gravity, scene.small_diameter);
}

/// A key has a value that it cannot have.
struct SceneError : UsageError {
  SceneError(const std::string& of, const std::string& sentence) : UsageError(sentence), key(of) {}
  std::string key;
};

/// SceneError unless `valid`.
inline void require(bool valid, const std::string& key, const std::string& sentence)
{
  if (!valid) throw SceneError(key, sentence);
}
/// SceneError unless low <= value <= high.
void require_within(double value, const std::string& key, double low, double high);

}  // namespace grseg
