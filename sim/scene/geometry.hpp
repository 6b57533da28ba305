// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/core/parameters.hpp"
#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <functional>
#include <vector>

namespace grseg {

/// What holds the grains of a scene while they are deposited.
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

/// Whether the user gave this key.
using KeyGiven = std::function<bool(const char* key)>;

/// What bounds the grains of a scene, how it moves, and what changes at t = 0. There is one object
/// for each value of the key `geometry`, in sim/scene/geometry. y = 0 is where Scene::origin puts
/// it; in a drum, at its lowest point.
class Geometry {
 public:
  /// `name`: value of the key. `help`: what moves or opens, in a few words.
  Geometry(const char* name, const char* help) : name_(name), help_(help) {}
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;
  virtual ~Geometry() = default;

  const char* name() const { return name_; }
  const char* help() const { return help_; }

  /// Checks what this geometry requires of other keys (SceneError), and sets the members of `scene`
  /// that follow from its own keys.
  virtual void resolve(Scene& scene, const KeyGiven& given) const = 0;
  /// Whether the base can be shaken.
  virtual bool can_shake(const Scene&) const { return false; }

  /// Whether the keys base-... may ask for another row of beads than the regular one.
  virtual bool can_shape_base(const Scene&) const { return false; }

  virtual Boundaries boundaries(const Scene& scene) const = 0;
  /// At height y, m, of the cell.
  virtual Room room_at(const Scene& scene, double y) const;
  /// m^2, under the surface of the settled bed, voids included.
  virtual double bed_area(const Scene& scene) const;
  /// Whether the deposition is repeated until the bed is as high as Scene::depth.
  virtual bool checks_height() const { return true; }

  /// The deposited grains at t = 0, after what held them is gone or what presses them has come.
  virtual Simulation release(const Simulation& deposited, const Scene& scene) const;
  /// Whether `release` neither adds nor removes grains, so that frames before and after t = 0 can
  /// be in one file.
  virtual bool keeps_grains() const { return true; }
  /// Whether one of `bodies` moves freely.
  virtual bool has_free_body() const { return false; }
  /// Boundary grains that move from t = 0 on; they are the last rows of `grains`.
  virtual std::vector<BoundaryBody> bodies(const Scene& scene, const Grains& grains) const;
  /// From t = 0 on.
  virtual Gravity<2> gravity(const Scene& scene) const;
  /// N/m, of the flow on its base, of which its weight makes `weight`.
  virtual double base_pressure(const Scene& scene, double weight) const;

  /// Adds what /parameters holds of this geometry beside the keys.
  virtual void describe(const Scene& scene, Parameters& parameters) const;

 private:
  const char *name_, *help_;
};

/// Scene::geometry's boundary grains that move; they are the last rows of `grains`.
std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains);

/// Whether any boundary grain moves.
bool moves_boundaries(const Scene& scene);

// Each in the file of its name.
const Geometry& bed_geometry();
const Geometry& drum_geometry();
const Geometry& shear_geometry();
const Geometry& column_geometry();
const Geometry& hopper_geometry();

/// All of them, in the order of --help.
const std::vector<const Geometry*>& geometries();

/// The scene at t = 0: what held the deposited grains until then is gone (the gate of a column, the
/// plug of a hopper), the plate of a shear cell lies on them and they are sheared; gravity is that
/// of the flow, and boundaries begin to move.
Simulation release(const Simulation& deposited, const Scene& scene);

/// Gives `simulation`, whose clock is set, the gravity and the moving boundaries of the flow.
void start_flow(Simulation& simulation, const Scene& scene);

}  // namespace grseg
