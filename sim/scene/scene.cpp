// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/scene.hpp"

#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// What an accuracy stands for: the step in units of sqrt(d_S/g) and the solver's stop.
struct Accuracy {
  const char* name;
  double step;
  double tolerance;
  int min_sweeps, max_sweeps;
};

constexpr std::array<Accuracy, 3> accuracies{{
    {"draft", 0.01771, 1, 8, 100},
    {"standard", 0.01107, 0.5, 8, 500},
    {"reference", 0.00443, 0.1, 8, 5000},
}};

// Restitution and geometry err by O(h); beyond this step a scene is a different one.
constexpr double largest_step = 0.05;  // in sqrt(d_S/g)

bool parse_switch(const std::string& text, const std::string& key)
{
  if (text == "on") return true;
  if (text == "off") return false;
  throw SceneError(key, fmt::format("{} is '{}': it is on or off", key, text));
}

template <class Choice, std::size_t N>
Choice parse_choice(const std::string& text, const std::string& key,
                    const std::array<std::pair<const char*, Choice>, N>& choices)
{
  std::vector<std::string> words;
  for (const auto& [name, choice] : choices) {
    if (text == name) return choice;
    words.emplace_back(name);
  }
  throw SceneError(key, unknown_word(key, text, words));
}

constexpr std::array<std::pair<const char*, Scene::Geometry>, 5> geometries{
    {{"bed", Scene::Geometry::bed},
     {"drum", Scene::Geometry::drum},
     {"shear", Scene::Geometry::shear},
     {"column", Scene::Geometry::column},
     {"hopper", Scene::Geometry::hopper}}};
constexpr std::array<std::pair<const char*, Scene::Base>, 2> bases{
    {{"grains", Scene::Base::grains}, {"wall", Scene::Base::wall}}};
constexpr std::array<std::pair<const char*, Scene::Lateral>, 2> laterals{
    {{"periodic", Scene::Lateral::periodic}, {"walls", Scene::Lateral::walls}}};
constexpr std::array<std::pair<const char*, Scene::Origin>, 2> origins{
    {{"top", Scene::Origin::top}, {"centre", Scene::Origin::centre}}};
constexpr std::array<std::pair<const char*, Scene::Law>, 4> laws{
    {{"speculative", Scene::Law::speculative},
     {"touch", Scene::Law::touch},
     {"centred", Scene::Law::centred},
     {"predictive", Scene::Law::predictive}}};
constexpr std::array<std::pair<const char*, bool>, 2> stores{
    {{"float64", false}, {"float32", true}}};

/// Reads keys from `values` and checks ranges; one place for the wording.
class Keys {
 public:
  explicit Keys(const po::variables_map& values) : values_(values) {}

  std::string text(const std::string& key) const { return values_[key].as<std::string>(); }
  bool given(const std::string& key) const
  {
    return values_.count(key) > 0 && !values_[key].defaulted();
  }
  double number(const std::string& key, double low, double high) const
  {
    return within(values_[key].as<double>(), key, low, high);
  }
  long whole_number(const std::string& key, long low, long high) const
  {
    const long value = values_[key].as<long>();
    within(static_cast<double>(value), key, static_cast<double>(low), static_cast<double>(high));
    return value;
  }
  double length(const std::string& key, LengthUnits units, double low, double high) const
  {
    double value = 0;
    try {
      value = parse_length(text(key), key, units);
    } catch (const UsageError& wrong) {
      throw SceneError(key, wrong.what());
    }
    return within(value, key, low, high);
  }

 private:
  static double within(double value, const std::string& key, double low, double high)
  {
    if (!(value >= low && value <= high))
      throw SceneError(key, fmt::format("{} is {:.6g}: it must lie between {:.6g} and {:.6g}", key,
                                        value, low, high));
    return value;
  }
  const po::variables_map& values_;
};

void resolve_grains(const Keys& keys, Scene& scene)
{
  scene.small_diameter = keys.length("small-diameter", {}, 1e-9, 1e6);
  scene.size_ratio = keys.number("size-ratio", 1, 100);
  scene.large_diameter = scene.small_diameter * scene.size_ratio;
  scene.spread = keys.number("spread", 0, 0.9);
  scene.density = keys.number("density", 1e-9, 1e12);
  scene.phi_large = keys.number("phi-large", 0, 1);
  if (keys.given("large-grains"))
    scene.large_grains = keys.whole_number("large-grains", 0, 1000000000);
  scene.friction = keys.number("friction", 0, 1e3);
  scene.restitution = keys.number("restitution", 0, 1);
  scene.rotation = parse_switch(keys.text("rotation"), "rotation");
  scene.law = parse_choice(keys.text("contact-law"), "contact-law", laws);
  scene.horizon = keys.number("horizon", 1e-3, 1);
}

void resolve_geometry(const Keys& keys, Scene& scene)
{
  const LengthUnits units{scene.small_diameter, scene.large_diameter};
  scene.depth = keys.length("depth", units, scene.small_diameter, 1e6 * scene.small_diameter);
  scene.length = keys.length("length", units, 4 * scene.large_diameter, 1e6 * scene.large_diameter);
  scene.slope = keys.number("slope", -90, 90);
  scene.slope_rate = keys.number("slope-rate", -1e9, 1e9);
  scene.gravity = keys.number("gravity", 1e-9, 1e9);
  scene.geometry = parse_choice(keys.text("geometry"), "geometry", geometries);
  scene.base = parse_choice(keys.text("base"), "base", bases);
  scene.lateral = parse_choice(keys.text("lateral"), "lateral", laterals);
  scene.origin = parse_choice(keys.text("origin"), "origin", origins);
}

void require(bool fine, const std::string& key, const std::string& sentence)
{
  if (!fine) throw SceneError(key, sentence);
}

void resolve_drum(const Keys& keys, Scene& scene, LengthUnits units)
{
  scene.drum_diameter =
      keys.length("drum-diameter", units, 4 * scene.large_diameter, 1e6 * scene.large_diameter);
  scene.drum_rate = keys.number("drum-rate", -1e6, 1e6);
  scene.fill = keys.number("fill", 0.01, 0.5);
  if (scene.geometry != Scene::Geometry::drum) return;
  require(scene.lateral == Scene::Lateral::walls, "lateral",
          "lateral is periodic: a drum has an inside; say walls");
  scene.length = scene.drum_diameter + 2 * scene.large_diameter;
  scene.depth = scene.fill * scene.drum_diameter;
}

void resolve_plate(const Keys& keys, Scene& scene)
{
  scene.plate_speed = keys.number("plate-speed", -1e6, 1e6);
  scene.plate_pressure = keys.number("plate-pressure", 1e-12, 1e12);
  const double beads = std::floor(scene.length / scene.large_diameter + 1e-9);
  scene.plate_mass = keys.given("plate-mass") ? keys.number("plate-mass", 1e-15, 1e15)
                                              : beads * scene.density * std::numbers::pi / 4 *
                                                    scene.large_diameter * scene.large_diameter;
  if (scene.geometry != Scene::Geometry::shear) return;
  require(scene.lateral == Scene::Lateral::periodic, "lateral",
          "lateral is walls: plates of a shear cell go round; say periodic");
  require(scene.base == Scene::Base::grains, "base",
          "base is wall: plates of a shear cell are rough; say grains");
  if (!keys.given("gravity")) scene.gravity = scene.plate_pressure / (scene.density * scene.depth);
}

void resolve_openings(const Keys& keys, Scene& scene, LengthUnits units)
{
  scene.column_width = keys.length("column-width", units, scene.large_diameter, 1e12);
  scene.outlet = keys.length("outlet", units, scene.small_diameter, 1e12);
  const bool column = scene.geometry == Scene::Geometry::column,
             hopper = scene.geometry == Scene::Geometry::hopper;
  require(!(column || hopper) || scene.lateral == Scene::Lateral::walls, "lateral",
          "lateral is periodic: columns and hoppers stand between walls; say walls");
  require(!column || scene.column_width < scene.length, "column-width",
          "column-width is not below length: the column needs room to fall into");
  require(!hopper || scene.base == Scene::Base::grains, "base",
          "base is wall: the outlet of a hopper lies between grains; say grains");
  require(!hopper || scene.outlet < scene.length, "outlet",
          "outlet is not below length: nothing would hold the bed");
}

void resolve_shaking(const Keys& keys, Scene& scene, LengthUnits units)
{
  scene.shake_amplitude = keys.length("shake-amplitude", units, 0, 1e12);
  scene.shake_frequency = keys.number("shake-frequency", 0, 1e9);
  if (scene.shake_amplitude == 0) return;
  require(scene.geometry == Scene::Geometry::bed && scene.base == Scene::Base::grains,
          "shake-amplitude", "shake-amplitude moves the base of a bed; say base = grains");
  require(scene.shake_frequency > 0, "shake-frequency",
          "shake-frequency is 0 but shake-amplitude is not; give both");
}

void resolve_accuracy(const Keys& keys, Scene& scene)
{
  scene.accuracy = keys.text("accuracy");
  const Accuracy* preset = nullptr;
  for (const auto& accuracy : accuracies)
    if (scene.accuracy == accuracy.name) preset = &accuracy;
  if (preset == nullptr)
    throw SceneError(
        "accuracy",
        fmt::format("accuracy is '{}': choose draft, standard or reference", scene.accuracy));

  const double natural = std::sqrt(scene.small_diameter / scene.gravity);
  scene.frame_interval = keys.number("frame-interval", 1e-12, 1e12);
  scene.duration = keys.number("duration", 0, 1e12);
  if (keys.given("step")) {
    scene.step = keys.number("step", 1e-15, largest_step * natural);
    const double steps = scene.frame_interval / scene.step;
    if (std::abs(steps - std::round(steps)) > 1e-6 * steps || steps < 0.5)
      throw SceneError(
          "step",
          fmt::format(
              "frame-interval {:.9g} s is no whole number of steps of {:.9g} s; change one of them",
              scene.frame_interval, scene.step));
  } else {
    scene.step = scene.frame_interval / std::ceil(scene.frame_interval / (preset->step * natural));
  }
  scene.burst = keys.whole_number("burst", 1, scene.steps_per_frame());
  scene.solver.tolerance =
      keys.given("tolerance") ? keys.number("tolerance", 1e-15, 1e3) : preset->tolerance;
  scene.solver.acceleration = parse_switch(keys.text("acceleration"), "acceleration");
  scene.solver.max_sweeps = keys.given("max-sweeps")
                                ? static_cast<int>(keys.whole_number("max-sweeps", 1, 1000000000))
                                : preset->max_sweeps;
  scene.solver.min_sweeps = keys.given("min-sweeps")
                                ? static_cast<int>(keys.whole_number("min-sweeps", 1, 1000000000))
                                : std::min(preset->min_sweeps, scene.solver.max_sweeps);
  if (scene.solver.min_sweeps > scene.solver.max_sweeps)
    throw SceneError("min-sweeps", fmt::format("min-sweeps is {}, above max-sweeps, {}; give both",
                                               scene.solver.min_sweeps, scene.solver.max_sweeps));
}

void resolve_turning(const Scene& scene)
{
  constexpr double most = 1;  // degree: a step feels the gravity of its middle
  require(scene.slope_rate == 0 || scene.geometry != Scene::Geometry::shear, "slope-rate",
          "slope-rate turns gravity, and a shear cell has none");
  const double turn = std::abs(scene.slope_rate) * scene.step;
  require(turn <= most, "slope-rate",
          fmt::format("slope-rate turns gravity by {:.3g} degrees per step, above {}; choose a "
                      "smaller one or a smaller step",
                      turn, most));
}

}  // namespace

std::int64_t Scene::steps_per_frame() const
{
  return std::llround(frame_interval / step);
}

std::int64_t Scene::steps_in_all() const
{
  return std::llround(duration / step);
}

Gravity gravity_of(const Scene& scene)
{
  if (scene.geometry == Scene::Geometry::shear) return {};
  const double slope = scene.slope * std::numbers::pi / 180;
  return {{scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope)},
          scene.slope_rate * std::numbers::pi / 180};
}

double contact_margin(const Scene& scene)
{
  return law_parameters(scene.law, scene.horizon, scene.step, scene.gravity, scene.small_diameter)
      .margin;
}

Vec2 drum_centre(const Scene& scene)
{
  return {scene.length / 2, scene.drum_diameter / 2};
}

po::options_description scene_options()
{
  const auto text = [](const char* standard) {
    return po::value<std::string>()->default_value(standard);
  };
  const auto number = [](double standard) {
    return po::value<double>()->default_value(standard, fmt::format("{}", standard));
  };
  po::options_description keys(
      "Keys of a scene file, and options (the command line wins).\nLengths are metres or carry a "
      "unit: 5mm, 60dS, 35dL");
  auto add = keys.add_options();
  add("small-diameter", text("5mm"), "nominal diameter d_S of the small grains");
  add("size-ratio", number(2), "nominal d_L/d_S");
  add("spread", number(0.08), "(d_max - d_min)/d within a species, uniform");
  add("density", number(1), "of the grains, kg/m^2");
  add("phi-large", number(0.3), "share of the large grains in the area of all grains");
  add("large-grains", po::value<long>(), "number of large grains, instead of phi-large");
  add("geometry", text("bed"),
      "bed (on its base), drum (turning), shear (under a plate, without gravity), column (its gate "
      "opens at t = 0) or hopper (its outlet does)");
  add("depth", text("60dS"), "height of the deposited bed, within 2 %");
  add("length", text("35dL"), "of the cell");
  add("slope", number(23), "degrees");
  add("slope-rate", number(0), "degrees/s by which the slope becomes steeper from t = 0 on");
  add("gravity", number(9.8),
      "m/s^2; of a shear cell that of the deposition alone, by default such that the bed presses "
      "on "
      "its base about as the plate is going to");
  add("friction", number(0.5), "Coulomb's coefficient, all contacts");
  add("restitution", number(0.25), "Newton's coefficient, all contacts");
  add("rotation", text("on"), "on or off: whether grains rotate");
  add("contact-law", text("speculative"),
      "which pairs act in a step: centred (those that touch by its end), touch (at its middle), "
      "predictive (half a step after its end) or speculative (slowed down short of overlap, they "
      "rebound in the step after)");
  add("horizon", number(0.75), "steps ahead that the speculative law looks, at most 1");
  add("base", text("grains"), "grains (a row of fixed large grains) or wall (straight)");
  add("lateral", text("periodic"), "periodic or walls: what bounds the cell along x");
  add("origin", text("top"), "y = 0 at the top or at the centre of the base grains");
  add("drum-diameter", text("100dS"), "of a drum, between its beads");
  add("drum-rate", number(0.5), "of a drum, rad/s, counter-clockwise");
  add("fill", number(0.4), "of a drum: share of its area under the settled bed");
  add("plate-speed", number(1), "of a shear cell's plate, m/s");
  add("plate-pressure", number(2), "of a shear cell's plate on the grains, N/m");
  add("plate-mass", po::value<double>(), "of a shear cell's plate, kg (default: its grains)");
  add("column-width", text("40dS"), "of a column before its gate opens");
  add("outlet", text("16dS"), "of a hopper");
  add("shake-amplitude", text("0"), "of a bed's base, vertical");
  add("shake-frequency", number(0), "of a bed's base, Hz");
  add("duration", number(150), "simulated time after the tilt, s");
  add("frame-interval", number(0.05), "s between frames, or between bursts of them");
  add("burst", po::value<long>()->default_value(1), "frames of consecutive steps at a time");
  add("keep-deposition", po::bool_switch(), "write the deposition too, at t < 0");
  add("seed", po::value<long>()->default_value(1), "of the random numbers");
  add("threads", po::value<long>()->default_value(1),
      "for wide scenes; 0 takes all cores. Frames do not depend on it");
  add("accuracy", text("standard"), "draft, standard or reference: sets the four below");
  add("step", po::value<double>(), "time step, s");
  add("tolerance", po::value<double>(),
      "of the solver: largest change of a relative velocity in the last sweep, over the mean one "
      "that forces make");
  add("min-sweeps", po::value<long>(),
      "of the solver, per step, unless one changes nothing; too few and a bed at rest trembles");
  add("max-sweeps", po::value<long>(), "of the solver, per step");
  add("acceleration", text("on"), "on or off: whether sweeps are extrapolated (Nesterov)");
  add("compression", po::value<int>()->default_value(0),
      "deflate level of the file, 0 (none) to 9");
  add("store", text("float64"), "float64 or float32, of the file");
  return keys;
}

Scene resolve_scene(const po::variables_map& values)
{
  const Keys keys(values);
  Scene scene;
  resolve_grains(keys, scene);
  resolve_geometry(keys, scene);
  const LengthUnits units{scene.small_diameter, scene.large_diameter};
  resolve_drum(keys, scene, units);
  resolve_plate(keys, scene);
  resolve_openings(keys, scene, units);
  resolve_shaking(keys, scene, units);
  resolve_accuracy(keys, scene);
  resolve_turning(scene);
  scene.keep_deposition = values["keep-deposition"].as<bool>();
  require(
      !scene.keep_deposition ||
          (scene.geometry != Scene::Geometry::shear && scene.geometry != Scene::Geometry::hopper),
      "keep-deposition",
      "keep-deposition: a plate or a plug makes other grains of a shear cell or hopper at t = 0; "
      "leave it out");
  scene.seed = static_cast<std::uint64_t>(keys.whole_number("seed", 1, 4294967295));
  scene.threads = static_cast<int>(keys.whole_number("threads", 0, 1024));
  if (scene.threads == 0) scene.threads = omp_get_num_procs();
  scene.compression = values["compression"].as<int>();
  if (scene.compression < 0 || scene.compression > 9)
    throw SceneError("compression", "compression is a deflate level from 0 (none) to 9");
  scene.float32 = parse_choice(keys.text("store"), "store", stores);
  return scene;
}

std::string to_text(const Scene& scene)
{
  std::string text;
  const auto add = [&](const char* key, const auto& value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  add("small-diameter", scene.small_diameter);
  add("size-ratio", scene.size_ratio);
  add("spread", scene.spread);
  add("density", scene.density);
  add("phi-large", scene.phi_large);
  if (scene.large_grains >= 0) add("large-grains", scene.large_grains);
  add("geometry", geometries[static_cast<std::size_t>(scene.geometry)].first);
  add("depth", scene.depth);
  add("length", scene.length);
  add("slope", scene.slope);
  add("slope-rate", scene.slope_rate);
  add("gravity", scene.gravity);
  add("friction", scene.friction);
  add("restitution", scene.restitution);
  add("contact-law", laws[static_cast<std::size_t>(scene.law)].first);
  add("horizon", scene.horizon);
  add("rotation", scene.rotation ? "on" : "off");
  add("base", bases[static_cast<std::size_t>(scene.base)].first);
  add("lateral", laterals[static_cast<std::size_t>(scene.lateral)].first);
  add("origin", origins[static_cast<std::size_t>(scene.origin)].first);
  add("drum-diameter", scene.drum_diameter);
  add("drum-rate", scene.drum_rate);
  add("fill", scene.fill);
  add("plate-speed", scene.plate_speed);
  add("plate-pressure", scene.plate_pressure);
  add("plate-mass", scene.plate_mass);
  add("column-width", scene.column_width);
  add("outlet", scene.outlet);
  add("shake-amplitude", scene.shake_amplitude);
  add("shake-frequency", scene.shake_frequency);
  add("duration", scene.duration);
  add("frame-interval", scene.frame_interval);
  add("burst", scene.burst);
  add("keep-deposition", scene.keep_deposition ? "on" : "off");
  add("seed", scene.seed);
  add("accuracy", scene.accuracy);
  add("step", scene.step);
  add("tolerance", scene.solver.tolerance);
  add("min-sweeps", scene.solver.min_sweeps);
  add("max-sweeps", scene.solver.max_sweeps);
  add("acceleration", scene.solver.acceleration ? "on" : "off");
  add("compression", scene.compression);
  add("store", scene.float32 ? "float32" : "float64");
  return text;
}

Parameters to_parameters(const Scene& scene)
{
  Parameters parameters;
  auto& n = parameters.numbers;
  const auto gravity = gravity_of(scene).start;
  n["gravity"] = {gravity.x(), gravity.y()};
  n["slope"] = {scene.slope};
  n["slope_rate"] = {scene.slope_rate};
  n["step"] = {scene.step};
  n["frame_interval"] = {scene.frame_interval};
  n["burst"] = {static_cast<double>(scene.burst)};
  n["small_diameter"] = {scene.small_diameter};
  n["large_diameter"] = {scene.large_diameter};
  n["spread"] = {scene.spread};
  n["density"] = {scene.density};
  n["phi_large"] = {scene.phi_large};
  n["friction"] = {scene.friction};
  n["restitution"] = {scene.restitution};
  n["rotation"] = {scene.rotation ? 1.0 : 0.0};
  n["horizon"] = {scene.horizon};
  n["contact_margin"] = {contact_margin(scene)};
  n["tolerance"] = {scene.solver.tolerance};
  n["acceleration"] = {scene.solver.acceleration ? 1.0 : 0.0};
  n["min_sweeps"] = {static_cast<double>(scene.solver.min_sweeps)};
  n["max_sweeps"] = {static_cast<double>(scene.solver.max_sweeps)};
  n["seed"] = {static_cast<double>(scene.seed)};
  if (scene.geometry == Scene::Geometry::drum) {
    const auto centre = drum_centre(scene);
    n["drum_centre"] = {centre.x(), centre.y()};
    n["drum_diameter"] = {scene.drum_diameter};
  }
  parameters.texts["scene"] = to_text(scene);
  parameters.texts["geometry"] = geometries[static_cast<std::size_t>(scene.geometry)].first;
  parameters.texts["accuracy"] = scene.accuracy;
  parameters.texts["contact_law"] = laws[static_cast<std::size_t>(scene.law)].first;
  parameters.texts["origin"] = origins[static_cast<std::size_t>(scene.origin)].first;
  return parameters;
}

}  // namespace grseg
