// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/core/gravity.hpp"
#include "formats/core/parameters.hpp"
#include "sim/contact/contact_law.hpp"
#include "sim/solver/solver.hpp"

#include <boost/program_options.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// Grains of two species and what bounds them, as the user asks for it, in SI. Defaults are the
/// chute of Staron & Phillips (2015). Every member is a key of a scene file and an option of the
/// same name.
struct Scene {
  double small_diameter = 0;  // m, nominal
  double size_ratio = 0;      // nominal d_L/d_S
  double large_diameter = 0;  // m, nominal: size_ratio times the small one
  double spread = 0;          // (d_max - d_min)/d of each species, uniform
  double density = 0;         // kg/m^2, of the grains
  double phi_large = 0;       // share of the large grains in the area of all grains
  long large_grains = -1;     // their number, where it is given instead
  double depth = 0;           // m, height H0 of the deposited bed above y = 0
  double length = 0;          // m, of the cell
  double slope = 0;           // degrees, at t = 0
  double slope_rate = 0;      // degrees/s, from then on
  double gravity = 0;         // m/s^2; of a shear cell: of its deposition, and of its time scale
  double friction = 0;
  double restitution = 0;  // Newton's e
  bool rotation = true;
  using Law = ContactLaw;
  Law law = Law::centred;
  double horizon = 0;  // steps, of the speculative law
  /// A bed on its base; in a drum that turns; sheared by a plate; a column that collapses; over an
  /// outlet.
  enum class Geometry { bed, drum, shear, column, hopper } geometry = Geometry::bed;
  enum class Base { grains, wall } base = Base::grains;
  enum class Lateral { periodic, walls } lateral = Lateral::periodic;
  enum class Origin { top, centre } origin = Origin::top;

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
  std::int64_t burst = 1;     // consecutive frames, one per step, at each
  bool keep_deposition = false;
  std::uint64_t seed = 1;
  int threads = 1;  // frames do not depend on it

  std::string accuracy;  // draft, standard, reference
  double step = 0;       // s
  SolverSettings solver;

  int compression = 0;
  bool float32 = false;

  std::int64_t steps_per_frame() const;
  std::int64_t steps_in_all() const;
};

/// Gravity of the flow: none in a shear cell, whose plate presses instead.
Gravity gravity_of(const Scene& scene);

/// m, within which a pair counts as touching where its law looks; of the speculative law, what
/// neighbours may add to an approach within a step.
double contact_margin(const Scene& scene);

/// The axis of a drum, m: y = 0 is its lowest point.
Vec2 drum_centre(const Scene& scene);

/// The keys of a scene, for Boost.ProgramOptions, with their defaults.
boost::program_options::options_description scene_options();

/// Adds the keys of the file at `path` to `values`; what is there already wins. UsageError where
/// the file is missing, FormatError naming file, line and remedy where a key is unknown or wrong.
void read_scene_file(const std::string& path, boost::program_options::variables_map& values);

/// The same for a scene given as text, which is called `name` in what is said of it. Keys of `text`
/// that `leave_out` names are passed over.
void read_scene_text(const std::string& text, const std::string& name,
                     const std::vector<std::string>& leave_out,
                     boost::program_options::variables_map& values);

/// A key whose value cannot be.
struct SceneError : UsageError {
  SceneError(const std::string& of, const std::string& sentence) : UsageError(sentence), key(of) {}
  std::string key;
};

/// Resolves `values` (lengths, presets, step) and checks every range; SceneError says which key is
/// out of which bounds.
Scene resolve_scene(const boost::program_options::variables_map& values);
/// The scene of the file at `path` where `given`, the command line, does not say otherwise; what is
/// wrong in the file is a FormatError with its line.
Scene resolve_scene(const std::string& path, const boost::program_options::variables_map& given);

/// The scene as a file that gives the same run: every key in SI but threads, which changes nothing.
std::string to_text(const Scene& scene);

/// What a trajectory says of the scene under /parameters.
Parameters to_parameters(const Scene& scene);

}  // namespace grseg
