// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/keys/keys.hpp"

#include "formats/cli/words.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/key_value.hpp"

#include <fmt/ranges.h>

#include <algorithm>

namespace grseg {
namespace {

namespace po = boost::program_options;
using namespace kinds;

Words<const Geometry*> geometry_words()
{
  Words<const Geometry*> words;
  for (const auto* geometry : geometries()) words.emplace_back(geometry->name, geometry);
  return words;
}

std::string geometry_help()
{
  std::vector<std::string> all;
  for (const auto* geometry : geometries())
    all.push_back(fmt::format("{} ({})", geometry->name, geometry->help));
  return fmt::format("boundaries of the flow: {}", fmt::join(all, ", "));
}

Words<std::string> accuracy_words()
{
  Words<std::string> words;
  for (const auto& accuracy : accuracies) words.emplace_back(accuracy.name, accuracy.name);
  return words;
}

template <class T>
auto of_solver(T SolverSettings::*member)
{
  return [member](auto& scene) -> auto&
  {
    return scene.solver.*member;
  };
}

using Conditions = std::vector<KeyCondition>;

Conditions operator+(Conditions all, const Conditions& more)
{
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Condition that the scene has one of the geometries for which `is_one` is true.
Conditions with_geometry(const std::function<bool(const Geometry&)>& is_one)
{
  std::vector<std::string> names;
  for (const auto* geometry : geometries())
    if (is_one(*geometry)) names.emplace_back(geometry->name);
  auto words = fmt::format("geometry = {}", names.back());
  if (names.size() > 1)
    words = fmt::format("geometry = {} or {}", fmt::join(names.begin(), names.end() - 1, ", "),
                        names.back());
  return {{words, [is_one](const Scene& scene) { return is_one(*scene.geometry); }}};
}

Conditions with_geometry(const Geometry& one)
{
  return with_geometry([&one](const Geometry& geometry) { return &geometry == &one; });
}

Conditions with_dimension(int dimension)
{
  return {{fmt::format("dimension = {}", dimension),
           [dimension](const Scene& scene) { return scene.dimension == dimension; }, true}};
}

/// Conditions of keys that do not act in every scene.
struct When {
  Conditions discs = with_dimension(2), spheres = with_dimension(3);
  Conditions drum = with_geometry(drum_geometry), shear = with_geometry(shear_geometry),
             column = with_geometry(column_geometry), hopper = with_geometry(hopper_geometry);
  Conditions no_drum = with_geometry([](const Geometry& one) { return &one != &drum_geometry; });
  Conditions gravity = with_geometry([](const Geometry& one) { return one.has_gravity; });
  Conditions grains_at_base{
      {"base = grains", [](const Scene& scene) { return scene.base == Scene::Base::grains; }}};
  Conditions free_base =
      with_geometry([](const Geometry& one) { return one.shapes_base; }) + grains_at_base;
  Conditions shaken{
      {"shake-amplitude above 0", [](const Scene& scene) { return scene.shake_amplitude > 0; }}};
  Conditions speculative{{"contact-law = speculative",
                          [](const Scene& scene) { return scene.law == ContactLaw::speculative; }}};
};

constexpr long most = 1000000000;

std::string set_by_accuracy(const char* help)
{
  return std::string(help) + " (default: by accuracy)";
}

// clang-format off
std::vector<SceneKey> bed_keys()
{
  const When when;
  using enum KeyRole;
  using enum InParameters;
  return {
    {"small-diameter", "5mm", length(&Scene::small_diameter, "1e-9m", "1e6m"), bed, yes,
     "nominal diameter d_S of the small grains"},
    {"size-ratio", "2", number(&Scene::size_ratio, 1, 100), bed, no,
     "diameter ratio d_L/d_S of large and small grains (nominal)"},
    {"spread", "0.08", number(&Scene::spread, 0, 0.9), bed, yes,
     "(d_max - d_min)/d of the diameters of a species, which are uniformly distributed"},
    {"density", "", number(&Scene::density, 1e-9, 1e12), bed, yes,
     "density of small grains and boundary grains, kg/m^2 (default: 1) or, of spheres, kg/m^3 "
     "(default: 2500, glass)"},
    {"density-ratio", "1", number(&Scene::density_ratio, 1e-3, 1e3), bed, yes,
     "density of large grains over density of small grains"},
    {"phi-large", "0.3", number(&Scene::phi_large, 0, 1), bed, yes,
     "share of large grains in the area (spheres: volume) of all mobile grains"},
    {"large-grains", "", whole_number(&Scene::large_grains, 0, most), bed, no,
     "number of large grains, instead of phi-large"},
    {"initial", "large-below", choice(&Scene::initial, Words<Scene::Initial>{
         {"large-below", Scene::Initial::large_below}, {"mixed", Scene::Initial::mixed},
         {"large-above", Scene::Initial::large_above}}), bed, yes,
     "place of the large grains in the deposited bed: below the small ones, among them (where there "
     "is little room, in layers of one species in random order), or above"},
    {"geometry", "bed", choice(&Scene::geometry, geometry_words()), bed, yes,
     geometry_help()},
    {"depth", "60dS", length(&Scene::depth, "1dS", "1e6dS"), bed, no,
     "height of the deposited bed, within 2 % (10 % where attempts are slow)", when.no_drum},
    {"length", "35dL", length(&Scene::length, "4dL", "1e6dL"), bed, no,
     "length of the cell along x; a drum has its diameter instead", when.no_drum},
    {"dimension", "2", choice(&Scene::dimension, Words<int>{{"2", 2}, {"3", 3}}), bed, no,
     "2: discs; 3: spheres, with densities in kg/m^3 and pressures in Pa", when.spheres},
    {"width", "10dL", length(&Scene::width, "4dL", "1e6dL"), bed, no,
     "width of the cell along z, in three dimensions", when.spheres},
    {"sides", "periodic", choice(&Scene::sides, Words<Scene::Lateral>{
         {"periodic", Scene::Lateral::periodic}, {"walls", Scene::Lateral::walls}}), bed, no,
     "walls at z = 0 and z = width, or a period (spheres only)", when.spheres},
  };
}

std::vector<SceneKey> flow_keys()
{
  const When when;
  using enum KeyRole;
  using enum InParameters;
  return {
    {"slope", "23", number(&Scene::slope, -90, 90, "ANGLE"), flow, yes,
     "slope of the base at t = 0, degrees", when.gravity},
    {"slope-rate", "0", number(&Scene::slope_rate, -1e9, 1e9), flow, yes,
     "rate at which the slope becomes steeper after t = 0, degrees/s", when.gravity},
    {"gravity", "9.8", number(&Scene::gravity, least_gravity, most_gravity), flow, no,
     "gravity, m/s^2. In a shear cell it acts during the deposition only; by default the pressure "
     "of the bed is then about plate-pressure"},
    {"friction", "0.5", number(&Scene::friction, 0, 1e3), flow, yes,
     "Coulomb's coefficient of friction, for all contacts"},
    {"restitution", "0.25", number(&Scene::restitution, 0, 1), flow, yes,
     "Newton's coefficient of restitution, for all contacts"},
    {"contact-law", "", choice(&Scene::law, Words<ContactLaw>{
         {"speculative", ContactLaw::speculative}, {"touch", ContactLaw::touch},
         {"centred", ContactLaw::centred}, {"predictive", ContactLaw::predictive}}), flow, yes,
     "pairs on which contact forces act in a step: speculative (pairs about to touch; they are "
     "slowed down before they overlap, and rebound in the next step), touch (pairs that touch at "
     "mid-step), centred (at the end of the step) or predictive (half a step later) (default: "
     "speculative; centred if restitution is above 0.9)"},
    {"horizon", "0.75", number(&Scene::horizon, 1e-3, 1), flow, yes,
     "number of steps that the speculative law looks ahead", when.speculative},
    {"rotation", "on", on_or_off(&Scene::rotation), bed, yes,
     "rotation of the grains"},
  };
}

std::vector<SceneKey> base_keys()
{
  const When when;
  using enum KeyRole;
  using enum InParameters;
  using Base = Scene::Base;
  using Lateral = Scene::Lateral;
  using Origin = Scene::Origin;
  return {
    {"base", "grains", choice(&Scene::base, Words<Base>{
         {"grains", Base::grains}, {"wall", Base::wall}}), bed, no,
     "base under the bed: grains (fixed grains; of discs one row, by default touching large ones; "
     "of spheres interlocked lines of large ones) or wall (flat)"},
    {"base-diameter", "1dL", length(&Scene::base_diameter, "0.1dS", "10dL"), bed, yes,
     "mean diameter of the discs in a bed's base", when.discs + when.free_base},
    {"base-diameter-spread", "0", number(&Scene::base_diameter_spread, 0, 1), bed, yes,
     "(d_max - d_min)/d of the discs in a bed's base, uniform; tops stay at one height",
     when.discs + when.free_base},
    {"base-height-spread", "0", length(&Scene::base_height_spread, "0", "10dL"), bed, yes,
     "range of the tops of the grains in a bed's base: each is lowered by a random distance from 0 "
     "to this value", when.free_base},
    {"base-spacing", "", length(&Scene::base_spacing, "0.1dS", "12.5dL"), bed, yes,
     "mean distance along x between centres of grains in a bed's base, enlarged until a whole "
     "number fills the cell. Below base-diameter the grains overlap (default: base-diameter)",
     when.discs + when.free_base},
    {"base-spacing-spread", "0", number(&Scene::base_spacing_spread, 0, 1), bed, yes,
     "(max - min)/mean of the distances between centres in a bed's base, uniform",
     when.discs + when.free_base},
    {"lateral", "periodic", choice(&Scene::lateral, Words<Lateral>{
         {"periodic", Lateral::periodic}, {"walls", Lateral::walls}}), bed, no,
     "ends of the cell along x"},
    {"origin", "top", choice(&Scene::origin, Words<Origin>{
         {"top", Origin::top}, {"centre", Origin::centre}}), bed, yes,
     "place of y = 0: top of the highest base grain, or half a base-diameter below (centre)",
     when.no_drum + when.grains_at_base},
  };
}

std::vector<SceneKey> geometry_keys()
{
  const When when;
  using enum KeyRole;
  using enum InParameters;
  return {
    {"drum-diameter", "100dS", length(&Scene::drum_diameter, "1dS", "1e6dL"), bed, no,
     "inner diameter of a drum; at least 4dL", when.drum},
    {"drum-rate", "0.5", number(&Scene::drum_rate, -1e6, 1e6), flow, no,
     "rotation rate of a drum, rad/s, counter-clockwise", when.drum},
    {"fill", "0.4", number(&Scene::fill, 0.01, 0.5), bed, no,
     "part of a drum's cross-section that the settled bed covers", when.drum},
    {"plate-speed", "1", number(&Scene::plate_speed, -1e6, 1e6), flow, no,
     "velocity of a shear cell's upper plate along x, m/s", when.shear},
    {"plate-pressure", "", number(&Scene::plate_pressure, 1e-12, 1e12), flow, no,
     "pressure of a shear cell's plate on the grains, N/m (default: 2) or, of spheres, Pa (default: "
     "5000)", when.shear},
    {"plate-mass", "", number(&Scene::plate_mass, 1e-60, 1e60), flow, no,
     "mass of a shear cell's plate, kg (default: mass of its grains), at most 256 layers of small "
     "grains", when.shear},
    {"column-width", "40dS", length(&Scene::column_width, "1dS", "1e12m"), bed, no,
     "width of a column before its gate opens; at least 1dL", when.column},
    {"outlet", "16dS", length(&Scene::outlet, "1dS", "1e12m"), bed, no,
     "width of a hopper's outlet; diameter of a round one", when.hopper},
    {"outlet-shape", "slot", choice(&Scene::outlet_shape, Words<Scene::Outlet>{
         {"slot", Scene::Outlet::slot}, {"round", Scene::Outlet::round}}), bed, no,
     "outlet of a hopper of spheres: a slot along z, or a round hole", when.hopper + when.spheres},
    {"shake-amplitude", "0", length(&Scene::shake_amplitude, "0", "1e12m"), flow, no,
     "amplitude of the vertical shaking of a bed's base", when.free_base},
    {"shake-frequency", "0", number(&Scene::shake_frequency, 0, 1e9), flow, no,
     "frequency of the vertical shaking of a bed's base, Hz", when.free_base + when.shaken},
  };
}

std::vector<SceneKey> run_keys()
{
  using enum KeyRole;
  using enum InParameters;
  return {
    {"duration", "150", number(&Scene::duration, 0, 1e12, "SECONDS"), extent, no,
     "duration of the flow after t = 0, s"},
    {"frame-interval", "0.05", number(&Scene::frame_interval, 1e-12, 1e12, "SECONDS"), flow, yes,
     "time from frame to frame, or from burst to burst, s"},
    {"burst", "1", whole_number(&Scene::burst, 1, most), flow, yes,
     "number of consecutive steps written as frames at each frame-interval"},
    {"keep-deposition", "off", flag(&Scene::keep_deposition), bed, no,
     "write the deposition too, as frames at t < 0"},
    {"seed", "1", whole_number(&Scene::seed, 1, 4294967295), bed, yes,
     "seed of the random numbers"},
    {"threads", "1", whole_number(&Scene::threads, 0, 1024), machine, no,
     "number of threads; 0 uses all cores. Only scenes of 30,000 grains or more gain. Results do "
     "not depend on it"},
    {"accuracy", "standard", choice(&Scene::accuracy, accuracy_words()), flow, yes,
     "sets step, tolerance, min-sweeps, max-sweeps and precision unless they are given. If masses "
     "of grains differ much: up to 16 times as many sweeps, and a tolerance smaller by the same "
     "factor"},
    {"step", "", number(&Scene::step, 1e-15, 1e12, "SECONDS"), flow, yes,
     set_by_accuracy("time step, s, at most 0.05 sqrt(d_S/g)")},
    {"tolerance", "", number(of_solver(&SolverSettings::tolerance), 1e-15, 1e3), flow, yes,
     set_by_accuracy("tolerance of the solver: largest accepted change of a relative velocity in "
                     "the last sweep, over the mean change of relative velocities by contact "
                     "forces")},
    {"min-sweeps", "", whole_number(of_solver(&SolverSettings::min_sweeps), 1, most), flow, yes,
     set_by_accuracy("least number of solver sweeps per step, unless a sweep changes nothing; with "
                     "too few the bed is soft")},
    {"max-sweeps", "", whole_number(of_solver(&SolverSettings::max_sweeps), 1, most), flow, yes,
     set_by_accuracy("largest number of solver sweeps per step")},
    {"precision", "", choice(of_solver(&SolverSettings::precision), Words<Precision>{
         {"mixed", Precision::mixed}, {"double", Precision::doubles}}), flow, yes,
     set_by_accuracy("precision of the solver; mixed: single precision for sweeps, double for the "
                     "rest")},
    {"acceleration", "on", on_or_off(of_solver(&SolverSettings::acceleration)), flow, yes,
     "Nesterov extrapolation of solver sweeps"},
    {"compression", "0", whole_number(&Scene::compression, 0, 9), extent, no,
     "deflate (gzip) level of the finished file; 0: no compression"},
    {"store", "float64", choice(&Scene::float32, Words<bool>{
         {"float64", false}, {"float32", true}}), extent, no,
     "floating-point type of numbers in the file"},
  };
}
// clang-format on

}  // namespace

const KeyCondition* SceneKey::missing_condition(const Scene& scene) const
{
  const auto missing = std::find_if(conditions.begin(), conditions.end(),
                                    [&](const auto& one) { return !one.holds(scene); });
  return missing == conditions.end() ? nullptr : &*missing;
}

std::string SceneKey::text(const Scene& scene) const
{
  const bool hidden = std::any_of(conditions.begin(), conditions.end(),
                                  [&](const auto& one) { return one.hides && !one.holds(scene); });
  return hidden ? "" : value.text(scene);
}

std::string SceneKey::with_unit(const std::string& text) const
{
  return value.kind == "length" ? text + "m" : text;
}

const std::vector<SceneKey>& scene_keys()
{
  static const auto keys = [] {
    std::vector<SceneKey> all;
    for (const auto& group : {bed_keys(), flow_keys(), base_keys(), geometry_keys(), run_keys()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return keys;
}

po::options_description scene_options()
{
  po::options_description options(
      "Keys of a scene file, which are also options (options take precedence).\nLengths need a "
      "unit: 5mm, 0.3m, 60dS, 35dL (diameters of small and of large grains)");
  for (const auto& key : scene_keys()) {
    auto help = key.help;
    if (key.value.is_flag) {
      options.add_options()(key.name, po::bool_switch(), help.c_str());
      continue;
    }
    const auto& words = key.value.words;
    if (!words.empty()) help += fmt::format(" [{}]", key.value.allowed);
    auto* value = words.empty() ? po::value<std::string>()->value_name(key.value.placeholder)
                                : word_option(nullptr, words);
    if (!key.default_text.empty()) value->default_value(key.default_text);
    options.add_options()(key.name, value, help.c_str());
  }
  return options;
}

}  // namespace grseg
