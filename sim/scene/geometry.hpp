// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <functional>
#include <vector>

namespace grseg {

struct Packing;

/// Boundaries of a scene during deposition.
struct Boundaries {
  std::vector<Vec3> position;  // m, of boundary grains; z is 0 for discs
  std::vector<double> radius;  // m, of boundary grains
  std::vector<Wall<3>> walls;
  double top = 0;  // m, y of the top of the base
};

/// Range of x in which falling grains may be placed at one height: from `left` to `right`, m.
struct Room {
  double left = 0, right = 0;
};

/// Function that is true for keys whose value the user gave.
using KeyGiven = std::function<bool(const char* key)>;

/// Boundaries of a scene: their positions, their motion, and their changes at t = 0. Each value of
/// the key `geometry` has one Geometry, in sim/scene/geometry. Scene::origin defines y = 0, except
/// in a drum, where it is the lowest point. Functions that are null have no effect.
struct Geometry {
  const char* name;  ///< value of the key `geometry`
  const char* help;  ///< words for --help: what moves or opens

  /// Checks other keys (throws SceneError); sets members that follow from the geometry's keys.
  void (*resolve)(Scene& scene, const KeyGiven& given) = nullptr;
  /// True if the base can be shaken, and the keys base-... apply to it (base_row.hpp).
  bool shapes_base = false;

  Boundaries (*boundaries)(const Scene& scene);
  /// Room for falling grains at height y, m; null: the whole length of the cell.
  Room (*room_at)(const Scene& scene, double y) = nullptr;
  /// Area or volume of the settled bed including voids, m^2 or m^3; null: depth times the cell at y
  /// = 0.
  double (*bed_area)(const Scene& scene) = nullptr;
  /// True if the deposition is repeated until the height of the bed is Scene::depth.
  bool checks_height = true;

  /// Removes or adds boundaries at t = 0: opens a gate or an outlet, or adds a plate.
  void (*release)(Packing& packing, const Scene& scene) = nullptr;
  /// True if `release` neither adds nor removes grains, so that frames before and after t = 0 can
  /// be in one file.
  bool keeps_grains = true;
  /// True if one of `bodies` moves freely along y (BoundaryBody::free).
  bool has_free_body = false;
  /// Boundary grains that move from t = 0 on; they are the last rows of `grains`.
  std::vector<BoundaryBody> (*bodies)(const Scene& scene, const Grains& grains) = nullptr;
  /// True if gravity acts after t = 0.
  bool has_gravity = true;
  /// Pressure of the flow on its base, N/m (spheres: Pa); null: measured from the contacts with the
  /// base.
  double (*base_pressure)(const Scene& scene) = nullptr;

  /// Adds values to /parameters of the trajectory that are not keys.
  void (*describe)(const Scene& scene, Parameters& parameters) = nullptr;
};

/// Results of Geometry::room_at and Geometry::bed_area for a scene, or the default if its geometry
/// has no such function.
Room room_at(const Scene& scene, double y);
double bed_area(const Scene& scene);

/// Gravity of the flow, including its slope; zero in a shear cell, which a plate presses instead.
template <int D>
Gravity<D> gravity_of(const Scene& scene);

/// Moving boundary grains of Scene::geometry; they are the last rows of `grains`.
std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains);

/// Largest acceleration in a flow, m/s^2: Scene::gravity, the acceleration of a moving boundary, or
/// the load of a plate over the mass of a bed without voids.
double largest_acceleration(const Scene& scene);

/// True if any boundary grain moves.
bool moves_boundaries(const Scene& scene);

// Each is defined in the file of its name in sim/scene/geometry.
extern const Geometry bed_geometry, drum_geometry, shear_geometry, column_geometry, hopper_geometry;

/// All geometries, in the order of --help.
const std::vector<const Geometry*>& geometries();

/// Simulation at t = 0: the gate of a column or the plug of a hopper is removed, the plate of a
/// shear cell is added on top of the grains, gravity_of() acts, and boundaries begin to move.
template <int D>
Simulation<D> release(const Simulation<D>& deposited, const Scene& scene);

/// Sets the gravity and the moving boundaries of the flow; the clock must be set before.
template <int D>
void start_flow(Simulation<D>& simulation, const Scene& scene);

}  // namespace grseg
