// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/scene/scene.hpp"
#include "sim/solver/solver.hpp"

#include <boost/program_options.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace grseg {

/// How the value of a key is written, and where a Scene holds it.
struct KeyValue {
  std::string kind;                  ///< "length", "number", "whole number", "switch" or "choice"
  std::string placeholder;           ///< what --help calls the value: "LENGTH"
  std::string allowed;               ///< the range or the words
  std::vector<std::string> words{};  ///< of a choice or switch
  /// Sets the scene's value from what the user wrote; SceneError where the key cannot have it.
  std::function<void(const std::string& key, const std::string& text, Scene&)> read;
  /// The scene's value in SI, without a unit; "" where it has none. read() of a length asks for a
  /// unit: with_unit().
  std::function<std::string(const Scene&)> text;
  /// The scene's value as a number, 1 for on; of a choice, empty.
  std::function<double(const Scene&)> number;
  /// True where the option stands alone on the command line and means on.
  bool is_flag = false;
};

/// Part of the scene that a key describes, which decides what a restart may do with it.
enum class KeyRole {
  bed,     ///< the deposited bed: a restart cannot change it
  flow,    ///< how grains move and which frames are written: a restart that changes it begins a
           ///< new trajectory
  extent,  ///< how long the run lasts and how its file is stored: steps stay the same
  machine  ///< what it runs on: results do not depend on it, and files do not state it
};

enum class InParameters { no, yes };

/// A key of scene files, which is also an option of grseg-sim.
struct SceneKey {
  const char* name;
  std::string default_text;  ///< the default; "" where it follows from other keys (resolve.cpp)
  KeyValue value;
  KeyRole role;
  /// Form in which /parameters holds the key under its own name, with _ for -. All keys except
  /// KeyRole::machine are also in /parameters/scene.
  InParameters stored;
  std::string help;

  /// The value `text`, made by KeyValue::text, as a scene file states it: a length with its "m".
  std::string with_unit(const std::string& text) const;
};

/// The table of all keys: options, --help, scene files, range checks, /parameters, what a restart
/// compares and docs/guide/scene-keys.md follow from it. In the order of scene files.
const std::vector<SceneKey>& scene_keys();

/// The keys as options for Boost.ProgramOptions.
boost::program_options::options_description scene_options();

/// The scene that `values`, parsed with scene_options(), state: reads every key of the table,
/// checks its range, and sets what follows from other keys where the user gives none (step and
/// solver by accuracy, the mass of a plate). SceneError names the key that is wrong.
Scene resolve_scene(const boost::program_options::variables_map& values);

/// Values that a word of the key `accuracy` stands for, where the keys below are not given.
struct Accuracy {
  const char* name;
  double step;                 // in sqrt(d_S/g)
  double tolerance;            // of the solver
  int min_sweeps, max_sweeps;  // per step
  Precision precision;         // of the sweeps, where no body moves freely
};

constexpr std::array<Accuracy, 3> accuracies{{
    {"draft", 0.01771, 1, 8, 100, Precision::mixed},
    {"standard", 0.01107, 0.5, 8, 500, Precision::mixed},
    {"reference", 0.00443, 0.1, 8, 5000, Precision::doubles},
}};

/// The keys that `accuracy` sets.
constexpr std::array<const char*, 5> keys_of_accuracy{"step", "tolerance", "min-sweeps",
                                                      "max-sweeps", "precision"};

// A scene as text (scene_text.cpp).

/// The scene as a file that gives the same run: every key except KeyRole::machine, in SI.
std::string to_text(const Scene& scene);

/// Parameters of the scene in /parameters of a trajectory.
Parameters to_parameters(const Scene& scene);

/// `now` with the values of `before` where both are the same up to round-off: 70 d_S of 5 mm are
/// 350 mm, but for the last bit.
Scene without_round_off(Scene now, const Scene& before);

/// The first key of `role` in which the scenes differ, or "".
std::string differing_key(const Scene& a, const Scene& b, KeyRole role);

/// Adds the keys of the file at `path` to `values`; what is there already wins. UsageError where
/// the file is missing, FormatError with file, line and remedy where a key is unknown.
void read_scene_file(const std::string& path, boost::program_options::variables_map& values);

/// Reads a scene given as text, which messages call `name`. Keys of `text` that `leave_out` names
/// are passed over.
void read_scene_text(const std::string& text, const std::string& name,
                     const std::vector<std::string>& leave_out,
                     boost::program_options::variables_map& values);

/// The scene of the file at `path` where `given`, the command line, does not say otherwise; what is
/// wrong in the file is a FormatError with its line.
Scene resolve_scene(const std::string& path, const boost::program_options::variables_map& given);

}  // namespace grseg
