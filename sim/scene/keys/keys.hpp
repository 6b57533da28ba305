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

/// Value of a key: its text form, and its place in a Scene.
struct KeyValue {
  std::string kind;                  ///< "length", "number", "whole number", "switch" or "choice"
  std::string placeholder;           ///< name of the value in --help, such as "LENGTH"
  std::string allowed;               ///< range, or list of words, for --help and messages
  std::vector<std::string> words{};  ///< allowed words of a choice or switch
  /// Sets the value in the scene from the user's text. Throws SceneError if it is not allowed.
  std::function<void(const std::string& key, const std::string& text, Scene&)> read;
  /// Text of the value in SI, without unit; "" if it is not set. read() needs the unit of a length:
  /// see with_unit().
  std::function<std::string(const Scene&)> text;
  /// Value as a number, 1 for on; null function for a choice.
  std::function<double(const Scene&)> number;
  /// True if the option has no value on the command line and means on.
  bool is_flag = false;
};

/// Part of the scene that a key describes. It decides whether a restart may change the key.
enum class KeyRole {
  bed,     ///< the deposited bed: a restart cannot change it
  flow,    ///< motion of grains, choice of frames: a restart with a change begins a new trajectory
  extent,  ///< duration of the run, storage of its file: the steps of a run do not depend on it
  machine  ///< use of the machine: results do not depend on it, and files do not include it
};

enum class InParameters { no, yes };

/// Part of a scene without which a key has no effect.
struct KeyCondition {
  std::string words;  ///< such as "geometry = drum"
  std::function<bool(const Scene&)> holds;
  /// True: the text of a scene leaves the key out if the condition does not hold.
  bool hides = false;
};

/// A key of scene files, which is also an option of grseg-sim.
struct SceneKey {
  const char* name;
  std::string default_text;  ///< the default; "" if it follows from other keys (resolve.cpp)
  KeyValue value;
  KeyRole role;
  /// yes: /parameters of the trajectory has an entry with the name of the key, _ for -. All keys
  /// except KeyRole::machine are also in the text /parameters/scene.
  InParameters stored;
  std::string help;
  std::vector<KeyCondition> conditions = {};  ///< the key has an effect if all of them hold

  /// First condition that does not hold; null if the key has an effect.
  const KeyCondition* missing_condition(const Scene& scene) const;
  /// KeyValue::text of the scene; "" also if a condition hides the key.
  std::string text(const Scene& scene) const;
  /// `text`, a result of KeyValue::text, as in a scene file: a length gets its "m".
  std::string with_unit(const std::string& text) const;
};

/// Table of all keys, in the order of scene files. Options, --help, scene files, range checks,
/// /parameters, comparisons in a restart and docs/guide/scene-keys.md are derived from it.
const std::vector<SceneKey>& scene_keys();

/// Answer to a key of an effect that no scene has, such as "in grseg-sim contacts do not attract ...";
/// "" for any other word.
std::string absent_effect(std::string key);

/// All keys as options for Boost.ProgramOptions.
boost::program_options::options_description scene_options();

/// Scene with the values of the keys in `values`, which were parsed with scene_options(). Checks
/// all ranges, and sets keys without a value if they follow from other keys (step and solver from
/// accuracy, the mass of a plate). Throws SceneError, which names the wrong key. A key among `own`,
/// the values that the user gave himself, is also wrong if it has no effect in this scene, unless it
/// has the value that the scene has without it. The text of a stored scene states all keys, with or
/// without effect.
Scene resolve_scene(const boost::program_options::variables_map& values,
                    const boost::program_options::variables_map& own);
inline Scene resolve_scene(const boost::program_options::variables_map& own)
{
  return resolve_scene(own, own);
}

/// Contact law of scenes that do not name one: the speculative law would change the energy of a gas
/// whose restitution is above 0.9.
ContactLaw usual_law(double restitution);

/// Values of other keys that a word of the key `accuracy` sets, unless the user gives them.
struct Accuracy {
  const char* name;
  double step;                 // largest step, in sqrt(d_S/g)
  double tolerance;            // SolverSettings::tolerance
  int min_sweeps, max_sweeps;  // least and largest number per step
  Precision precision;         // precision of the sweeps, if no body moves freely
};

constexpr std::array<Accuracy, 3> accuracies{{
    {"draft", 0.01771, 1, 8, 100, Precision::mixed},
    {"standard", 0.01107, 0.5, 8, 500, Precision::mixed},
    {"reference", 0.00443, 0.1, 8, 5000, Precision::doubles},
}};

/// Names of the keys that `accuracy` sets.
constexpr std::array<const char*, 5> keys_of_accuracy{"step", "tolerance", "min-sweeps",
                                                      "max-sweeps", "precision"};

// Conversion of a scene from and to text (scene_text.cpp).

/// Text of a scene file with the same results: every key except KeyRole::machine, in SI.
std::string to_text(const Scene& scene);

/// Entries of the scene in /parameters of a trajectory.
Parameters to_parameters(const Scene& scene);

/// Scene `now`, with each value of `before` that differs by round-off only: 70 d_S of 5 mm and 350
/// mm differ in the last bit.
Scene without_round_off(Scene now, const Scene& before);

/// First key of `role` in which the scenes differ, or "".
std::string differing_key(const Scene& a, const Scene& b, KeyRole role);

/// Adds the keys of the file at `path` to `values`, but does not change values that are already
/// there. Throws UsageError if the file is missing, FormatError with file, line and remedy if a key
/// is unknown.
void read_scene_file(const std::string& path, boost::program_options::variables_map& values);

/// Adds the keys of a scene given as text, except the keys `leave_out`; messages call it `name`.
void read_scene_text(const std::string& text, const std::string& name,
                     const std::vector<std::string>& leave_out,
                     boost::program_options::variables_map& values);

/// Scene of the file at `path`; values of the command line, `given`, take precedence. Throws
/// FormatError with the line of an error in the file.
Scene resolve_scene(const std::string& path, const boost::program_options::variables_map& given);

}  // namespace grseg
