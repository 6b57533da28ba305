// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/provenance.hpp"
#include "sim/scene/base_row.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/keys.hpp"
#include "sim/scene/packing.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

namespace po = boost::program_options;

// Largest step: errors of restitution and geometry are O(h), and larger steps change the flow.
constexpr double largest_step = 0.05;  // in sqrt(d_S/g)
constexpr double most_steps = 1e15;    // so that a double represents their number exactly
constexpr double largest_turn = 1;     // degrees per step, which has the gravity of its middle
// Least number N of steps in a period of a shaken base or a turn of a ring: the velocities of the
// boundary are too large by (pi/N)^2/3, 0.8 % for 20 (boundary_body.hpp).
constexpr double cycle_steps = 20;
// Largest distance that its load may move a plate in a step, d_S; half of it may become overlap.
constexpr double farthest_by_load = 0.1;
// Largest mass of a large grain, in masses of a small one, for which the sweeps of `accuracy`
// suffice. Heavier grains sink into light ones, or are lifted by them (docs/studies/hard-cases.md).
constexpr double heaviest_large = 16;
// Largest mass of a plate, in masses of the row of small grains that fits under it, for which the
// sweeps of `accuracy` suffice. A heavier plate compresses the bed in several steps, and the bed
// throws it back (docs/studies/accuracy.md).
constexpr double heaviest_plate = 1;
constexpr double most_sweeps_factor = 16;
// Restitution above which the default law is `centred`: the speculative law would change the energy
// of a gas (docs/studies/accuracy.md).
constexpr double most_speculative_restitution = 0.9;

bool is_given(const po::variables_map& values, const char* key)
{
  return values.count(key) > 0 && !values[key].defaulted();
}

/// Scene with the value of every key that has one. Of keys that follow from others, contact law,
/// density and the pressure of a plate are set, too.
Scene stated(const po::variables_map& values)
{
  Scene scene;
  for (const auto& key : scene_keys()) {
    const auto& given = values[key.name];
    if (given.empty()) continue;  // it follows from other keys
    key.value.read(key.name,
                   key.value.is_flag ? (given.as<bool>() ? "on" : "off") : given.as<std::string>(),
                   scene);
  }
  scene.large_diameter = scene.small_diameter * scene.size_ratio;
  if (scene.threads == 0) scene.threads = omp_get_num_procs();
  if (values["contact-law"].empty()) scene.law = usual_law(scene.restitution);
  // Spheres are of glass; the default pressure gives them the inertial number of the discs.
  const double usual_density = scene.dimension == 3 ? 2500 : 1;
  if (values["density"].empty()) scene.density = usual_density;
  if (values["plate-pressure"].empty()) scene.plate_pressure = 2 * usual_density;
  return scene;
}

double mass_of_plate(const Scene& scene)
{
  if (scene.dimension == 3) {
    const auto lines = static_cast<double>(row_of_beads(scene).size());
    const auto beads = static_cast<double>(beads_in_line(scene, 0) + beads_in_line(scene, 1));
    return lines / 2 * beads * scene.density * nominal_volume(scene, scene.large_diameter);
  }
  const double beads = std::floor(scene.length / scene.large_diameter + 1e-9);
  return beads * scene.density * std::numbers::pi / 4 * scene.large_diameter * scene.large_diameter;
}

void check_shaking(const Scene& scene)
{
  if (scene.shake_amplitude == 0) return;
  require(scene.shake_frequency > 0, "shake-frequency",
          "shake-frequency is 0 but shake-amplitude is not; set both");
}

/// Frequency of a shaken base or a turning ring, Hz; 0 if there is none.
double cycles_per_second(const Scene& scene)
{
  double fastest = 0;
  for (const auto& body : bodies_of(scene, {}))
    fastest = std::max({fastest, body.angular_frequency, std::abs(body.spin)});
  return fastest / (2 * std::numbers::pi);
}

/// Sets the step: the given one, or the longest one that `accuracy` allows and that divides the
/// frame interval. The default follows the largest acceleration; a given one is limited by gravity.
void resolve_step(Scene& scene, const KeyGiven& given, const Accuracy& accuracy)
{
  const double natural = std::sqrt(scene.small_diameter / largest_acceleration(scene));
  const double least_rate = cycle_steps * cycles_per_second(scene);
  const double longest = std::min(accuracy.step * natural, 1 / least_rate);  // may be infinite
  if (!given("step")) {
    scene.step = scene.frame_interval / std::ceil(scene.frame_interval / longest);
    return;
  }
  require(least_rate * scene.step <= 1 + 1e-9, "step",
          fmt::format("step is {:.6g} s: a cycle of the moving boundary, {:.4g} s, has only {:.3g} "
                      "steps; choose a step of at most {:.4g} s, for {:g} steps in a cycle",
                      scene.step, cycle_steps / least_rate, cycle_steps / least_rate / scene.step,
                      1 / least_rate, cycle_steps));
  require_within(scene.step, "step", 0,
                 largest_step * std::sqrt(scene.small_diameter / scene.gravity));
  const double steps = scene.frame_interval / scene.step;
  require(std::abs(steps - std::round(steps)) <= 1e-6 * steps && steps >= 0.5, "step",
          fmt::format("frame-interval, {:.9g} s, is not a whole number of steps of {:.9g} s; "
                      "change one of them",
                      scene.frame_interval, scene.step));
}

/// Mass of a plate, in masses of a layer of small grains under it.
double layers_of_plate(const Scene& scene)
{
  const double small = scene.density * nominal_volume(scene, scene.small_diameter);
  const double under_it = base_area(scene) / std::pow(scene.small_diameter, scene.dimension - 1);
  return scene.plate_mass / (under_it * small);
}

/// Factor that multiplies sweeps and divides the tolerance if grains support much heavier ones, or
/// a heavy plate: in a sweep, a heavy body receives only an impulse that would stop a light one.
int more_sweeps(const Scene& scene)
{
  double contrast = 1;
  const bool two_species =
      scene.large_grains ? *scene.large_grains > 0 : scene.phi_large > 0 && scene.phi_large < 1;
  double masses = scene.density_ratio * scene.size_ratio * scene.size_ratio;
  if (scene.dimension == 3) masses *= scene.size_ratio;
  if (two_species) contrast = std::max(masses / heaviest_large, 1 / masses);
  if (scene.geometry->has_free_body)
    contrast = std::max(contrast, layers_of_plate(scene) / heaviest_plate);
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(contrast)), 1.0, most_sweeps_factor));
}

void resolve_accuracy(Scene& scene, const KeyGiven& given)
{
  const auto& accuracy =
      *std::find_if(accuracies.begin(), accuracies.end(),
                    [&](const Accuracy& one) { return one.name == scene.accuracy; });
  resolve_step(scene, given, accuracy);
  auto& solver = scene.solver;
  const int factor = more_sweeps(scene);
  if (!given("tolerance")) solver.tolerance = accuracy.tolerance / factor;
  if (!given("max-sweeps")) solver.max_sweeps = factor * accuracy.max_sweeps;
  if (!given("min-sweeps"))
    solver.min_sweeps = std::min(factor * accuracy.min_sweeps, solver.max_sweeps);
  require(solver.min_sweeps <= solver.max_sweeps, "min-sweeps",
          fmt::format("min-sweeps is {}, above max-sweeps, {}; set both", solver.min_sweeps,
                      solver.max_sweeps));
  const bool free_body = scene.geometry->has_free_body;
  if (!given("precision")) solver.precision = free_body ? Precision::doubles : accuracy.precision;
  require(!free_body || solver.precision == Precision::doubles, "precision",
          fmt::format("precision is mixed, but geometry {} has a body that moves freely and needs "
                      "double precision; leave it out",
                      scene.geometry->name));
}

void check_frames(const Scene& scene)
{
  for (const auto& [key, time] :
       {std::pair{"duration", scene.duration}, {"frame-interval", scene.frame_interval}})
    require(time / scene.step <= most_steps, key,
            fmt::format("{} is {:.6g} s: that is more than {:.0g} steps of {:.6g} s; choose a "
                        "shorter time",
                        key, time, most_steps, scene.step));
  require(scene.steps_in_all() > 0, "duration",
          fmt::format("duration is {:.6g} s, less than a step of {:.6g} s: the run would have no "
                      "frame; choose a longer one",
                      scene.duration, scene.step));
  require_within(static_cast<double>(scene.burst), "burst", 1,
                 static_cast<double>(scene.steps_per_frame()));
  require(!scene.keep_deposition || scene.geometry->keeps_grains, "keep-deposition",
          fmt::format("keep-deposition: geometry {} adds or removes grains at t = 0, and frames "
                      "before and after cannot be in one file; leave it out",
                      scene.geometry->name));
}

void check_plate(const Scene& scene)
{
  if (!scene.geometry->has_free_body) return;
  const double load = scene.plate_pressure * base_area(scene);
  const double way = load / scene.plate_mass * scene.step * scene.step / scene.small_diameter;
  require(way <= farthest_by_load, "plate-mass",
          fmt::format("plate-mass is {:.3g} kg: plate-pressure would move the plate by {:.2g} d_S "
                      "in a step, more than {:g}; choose at least {:.2g} kg, or a smaller step",
                      scene.plate_mass, way, farthest_by_load,
                      scene.plate_mass * way / farthest_by_load));
  const double layers = layers_of_plate(scene);
  const double heaviest = heaviest_plate * most_sweeps_factor * most_sweeps_factor;
  require(layers <= heaviest * (1 + 1e-9), "plate-mass",
          fmt::format("plate-mass is {:.4g} kg, that of {:.4g} layers of small grains: above {:g} "
                      "the plate would rebound as if from springs; choose at most {:.4g} kg",
                      scene.plate_mass, layers, heaviest, scene.plate_mass * heaviest / layers));
}

void check_turning(const Scene& scene)
{
  const double turn = std::abs(scene.slope_rate) * scene.step;
  require(turn <= largest_turn, "slope-rate",
          fmt::format("slope-rate turns gravity by {:.3g} degrees per step, above {}; choose a "
                      "smaller slope-rate or step",
                      turn, largest_turn));
}

Scene resolved(const po::variables_map& values)
{
  const KeyGiven given = [&](const char* key) { return is_given(values, key); };
  Scene scene = stated(values);
  if (scene.geometry->resolve) scene.geometry->resolve(scene, given);
  if (scene.dimension == 2)
    resolve_base_row(scene, given);
  else
    check_base_of_spheres(scene);
  if (!given("plate-mass")) scene.plate_mass = mass_of_plate(scene);
  check_shaking(scene);
  resolve_accuracy(scene, given);
  check_frames(scene);
  check_turning(scene);
  check_plate(scene);
  return scene;
}

/// `values` with the defaults of `keys`.
po::variables_map without(const std::vector<const SceneKey*>& keys, po::variables_map values)
{
  for (const auto* key : keys) {
    values.erase(key->name);
    if (!key->default_text.empty())
      values.emplace(key->name, po::variable_value(key->default_text, true));
  }
  return values;
}

/// Throws SceneError for a key of `own` that has no effect, unless its value is the one that the
/// scene has without it.
void refuse_keys_without_effect(const po::variables_map& values, const po::variables_map& own)
{
  const auto scene = stated(values);
  std::vector<const SceneKey*> idle;
  for (const auto& key : scene_keys())
    if (is_given(own, key.name) && key.missing_condition(scene) != nullptr) idle.push_back(&key);
  if (idle.empty()) return;
  const auto others = resolved(without(idle, values));
  for (const auto* key : idle)
    require(same_setting(key->value.text(scene), key->value.text(others)), key->name,
            fmt::format("{} has an effect only with {}; leave it out, or change the scene",
                        key->name, key->missing_condition(scene)->words));
}

}  // namespace

ContactLaw usual_law(double restitution)
{
  return restitution > most_speculative_restitution ? ContactLaw::centred : ContactLaw::speculative;
}

Scene resolve_scene(const po::variables_map& values, const po::variables_map& own)
{
  refuse_keys_without_effect(values, own);
  return resolved(values);
}

}  // namespace grseg
