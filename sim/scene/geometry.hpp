// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <functional>
#include <vector>

namespace grseg {

/// Boundaries of a scene during deposition.
struct Boundaries {
  std::vector<Vec2> position;  // m, of boundary grains
  std::vector<double> radius;  // m
  std::vector<Wall> walls;
  double top = 0;  // m, of the base under the falling grains
};

/// Where grains may be at one height before they fall: from `left` to `right`, m.
struct Room {
  double left = 0, right = 0;
};

/// True where the user gave this key.
using KeyGiven = std::function<bool(const char* key)>;

/// Boundaries of a scene: where they are, how they move, and how they change at t = 0. Each value
/// of the key `geometry` has one such row, in sim/scene/geometry. y = 0 is where Scene::origin puts
/// it; in a drum, at its lowest point. A null function has no effect.
struct Geometry {
  const char* name;  ///< value of the key
  const char* help;  ///< what moves or opens, in a few words

  /// Checks what this geometry requires of other keys (SceneError), and sets the members of `scene`
  /// that follow from its own keys.
  void (*resolve)(Scene& scene, const KeyGiven& given) = nullptr;
  /// True where grains of the base can be shaken, and the keys base-... may ask for another row of
  /// beads than the regular one.
  bool shapes_base = false;

  Boundaries (*boundaries)(const Scene& scene);
  /// At height y, m, of the cell; null: over its whole length.
  Room (*room_at)(const Scene& scene, double y) = nullptr;
  /// m^2, under the surface of the settled bed, voids included; null: depth times width at y = 0.
  double (*bed_area)(const Scene& scene) = nullptr;
  /// True where the deposition is repeated until the bed is as high as Scene::depth.
  bool checks_height = true;

  /// The deposited grains at t = 0, after what held them is gone or what presses them has come.
  Simulation (*release)(const Simulation& deposited, const Scene& scene) = nullptr;
  /// True where `release` neither adds nor removes grains, so that frames before and after t = 0
  /// can be in one file.
  bool keeps_grains = true;
  /// True where one of `bodies` moves freely.
  bool has_free_body = false;
  /// Boundary grains that move from t = 0 on; they are the last rows of `grains`.
  std::vector<BoundaryBody> (*bodies)(const Scene& scene, const Grains& grains) = nullptr;
  /// From t = 0 on; false: none.
  bool has_gravity = true;
  /// N/m, of the flow on its base; null: what its weight makes.
  double (*base_pressure)(const Scene& scene) = nullptr;

  /// Adds what /parameters holds of this geometry beside the keys.
  void (*describe)(const Scene& scene, Parameters& parameters) = nullptr;
};

/// Geometry::room_at and Geometry::bed_area of Scene::geometry.
Room room_at(const Scene& scene, double y);
double bed_area(const Scene& scene);

/// Gravity of the flow, slope included. Of a shear cell: none, its plate presses instead.
Gravity<2> gravity_of(const Scene& scene);

/// Scene::geometry's boundary grains that move; they are the last rows of `grains`.
std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains);

/// True where any boundary grain moves.
bool moves_boundaries(const Scene& scene);

// Each in the file of its name.
extern const Geometry bed_geometry, drum_geometry, shear_geometry, column_geometry, hopper_geometry;

/// All of them, in the order of --help.
const std::vector<const Geometry*>& geometries();

/// The scene at t = 0: the gate of a column or the plug of a hopper is gone, the plate of a shear
/// cell lies on the grains, the gravity of the flow acts, and boundaries begin to move.
Simulation release(const Simulation& deposited, const Scene& scene);

/// Gives `simulation`, whose clock is set, the gravity and the moving boundaries of the flow.
void start_flow(Simulation& simulation, const Scene& scene);

}  // namespace grseg
