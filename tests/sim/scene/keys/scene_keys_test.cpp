// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/bed.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/errors.hpp"
#include "sim/run/restart.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/keys.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;

po::variables_map parse(const std::vector<std::string>& words)
{
  po::variables_map values;
  po::store(po::command_line_parser(words).options(scene_options()).run(), values);
  po::notify(values);
  return values;
}

Scene scene_from(const std::vector<std::string>& words)
{
  return resolve_scene(parse(words));
}

class SceneFile : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / ("grseg_scene_test_" + std::to_string(getpid()) + ".ini"))
          .string();
  void TearDown() override { fs::remove(path); }
  std::string complaint(const std::string& content)
  {
    std::ofstream(path) << content;
    try {
      resolve_scene(path, parse({}));
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST(Scene, DefaultsAreThePapersFlow)
{
  const auto scene = scene_from({});
  EXPECT_DOUBLE_EQ(scene.small_diameter, 0.005);
  EXPECT_DOUBLE_EQ(scene.large_diameter, 0.01);
  EXPECT_DOUBLE_EQ(scene.depth, 0.3);
  EXPECT_DOUBLE_EQ(scene.length, 0.35);
  EXPECT_EQ(scene.slope, 23);
  EXPECT_EQ(scene.friction, 0.5);
  EXPECT_EQ(scene.restitution, 0.25);
  EXPECT_EQ(scene.duration, 150);
}

TEST(Scene, AWholeNumberOfStepsFitsIntoAFrameInterval)
{
  for (const auto* accuracy : {"draft", "standard", "reference"}) {
    const auto scene = scene_from({"--accuracy", accuracy, "--frame-interval", "0.0123"});
    const double steps = scene.frame_interval / scene.step;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
  EXPECT_THROW(scene_from({"--step", "0.0003"}), UsageError);
}

TEST(Scene, SweepsAreInSinglePrecisionWhereTheAccuracyAllowsIt)
{
  const auto precision = [](const std::vector<std::string>& words) {
    return scene_from(words).solver.precision;
  };
  EXPECT_EQ(precision({"--accuracy", "draft"}), Precision::mixed);
  EXPECT_EQ(precision({"--accuracy", "standard"}), Precision::mixed);
  EXPECT_EQ(precision({"--accuracy", "reference"}), Precision::doubles);
  EXPECT_EQ(precision({"--accuracy", "reference", "--precision", "mixed"}), Precision::mixed);
  EXPECT_EQ(precision({"--precision", "double"}), Precision::doubles);
  EXPECT_EQ(to_parameters(scene_from({})).texts.at("precision"), "mixed");
}

TEST(Scene, AFreePlateIsSolvedInDoublePrecision)
{
  EXPECT_EQ(scene_from({"--geometry", "shear"}).solver.precision, Precision::doubles);
  EXPECT_THROW(scene_from({"--geometry", "shear", "--precision", "mixed"}), UsageError);
}

TEST(Scene, StorageIsAsAsked)
{
  EXPECT_TRUE(scene_from({"--store", "float32"}).float32);
  EXPECT_EQ(scene_from({"--compression", "4"}).compression, 4);
}

TEST(Scene, GravityPointsDownTheSlopeAndIntoTheBase)
{
  const auto gravity = to_parameters(scene_from({"--slope", "30"})).numbers.at("gravity");
  EXPECT_NEAR(gravity[0], 4.9, 1e-12);
  EXPECT_NEAR(gravity[1], -9.8 * std::sqrt(3.0) / 2, 1e-12);
}

TEST(Scene, ASlopeThatTurnsIsStoredAndMustTurnSlowly)
{
  const auto scene = scene_from({"--slope", "0", "--slope-rate", "5"});
  EXPECT_EQ(to_parameters(scene).numbers.at("slope_rate").at(0), 5);
  const auto later = gravity_of<2>(scene).at(6);  // at 30 degrees
  EXPECT_NEAR(later.x(), 4.9, 1e-12);
  for (const auto& words : {std::vector<std::string>{"--slope-rate", "5000"},
                            {"--slope-rate", "5", "--geometry", "shear"}}) {
    try {
      scene_from(words);
      FAIL();
    } catch (const SceneError& error) {
      EXPECT_EQ(error.key, "slope-rate");
    }
  }
}

/// Key for which a scene is refused.
std::string refused_key(const std::vector<std::string>& words)
{
  try {
    scene_from(words);
  } catch (const SceneError& error) {
    return error.key;
  }
  return "none";
}

TEST(Scene, AShakenBaseHasTwentyStepsInAPeriod)
{
  const std::vector<std::string> shaken{"--shake-amplitude", "1e-6dS", "--shake-frequency", "2000"};
  EXPECT_NEAR(scene_from(shaken).step, 1 / (20 * 2000.0), 1e-12);
  auto with_step = shaken;
  with_step.insert(with_step.end(), {"--step", "2.5e-4"});
  EXPECT_EQ(refused_key(with_step), "step");
  with_step.back() = "2.5e-5";
  EXPECT_EQ(refused_key(with_step), "none");
}

TEST(Scene, ATurningDrumHasTwentyStepsInATurn)
{
  const std::vector<std::string> drum{"--geometry", "drum", "--lateral",  "walls",
                                      "--step",     "1e-4", "--drum-rate"};
  auto slow = drum, fast = drum;
  slow.push_back("3000");
  fast.push_back("3500");
  EXPECT_EQ(refused_key(slow), "none");
  EXPECT_EQ(refused_key(fast), "step");
}

// The distance that a load moves a grain in a step, a h^2/2, is the same for every acceleration a.
TEST(Scene, TheStepFollowsTheLargestAcceleration)
{
  const auto steps = [](std::vector<std::string> words, const char* key, const char* value) {
    words.insert(words.end(), {"--frame-interval", "50", "--duration", "100", key, value});
    return scene_from(words).step;
  };
  const double usual = scene_from({"--frame-interval", "50", "--duration", "100"}).step;
  // Gravity is 9.8 m/s^2; the drum's radius is 0.2 m, so that it has 9.8 m/s^2 at 7 rad/s.
  const std::vector<std::string> drum{"--geometry",      "drum", "--lateral", "walls",
                                      "--drum-diameter", "0.4m"};
  EXPECT_EQ(steps(drum, "--drum-rate", "-6.9"), usual);
  EXPECT_NEAR(steps(drum, "--drum-rate", "-14"), usual / 2, 1e-5 * usual);
  // An amplitude of 9.8 mm has 9.8 m/s^2 at (1000/s^2)^(1/2) = 5.03292 Hz.
  const std::vector<std::string> shaken{"--shake-amplitude", "9.8mm"};
  EXPECT_EQ(steps(shaken, "--shake-frequency", "5"), usual);
  EXPECT_NEAR(steps(shaken, "--shake-frequency", "15.09876"), usual / 3, 1e-5 * usual);
  // The plate presses with 9.8 m/s^2 times the mass of a bed of 1 m and 1 kg/m^2.
  const std::vector<std::string> shear{"--geometry", "shear", "--depth", "1m", "--gravity", "9.8"};
  EXPECT_EQ(steps(shear, "--plate-pressure", "9.7"), usual);
  EXPECT_NEAR(steps(shear, "--plate-pressure", "156.8"), usual / 4, 1e-5 * usual);
}

TEST(Scene, APlateIsTooHeavyForItsLoadToMoveItUnseenWithinAStep)
{
  EXPECT_EQ(refused_key({"--geometry", "shear"}), "none");
  EXPECT_EQ(refused_key({"--geometry", "shear", "--plate-mass", "1e-8"}), "plate-mass");
}

// With 16 times the sweeps, the most that presets make, 256 layers are carried as one is.
TEST(Scene, APlateIsAsHeavyAs256LayersOfSmallGrainsAtMost)
{
  const auto plate = [](double layers) {
    const double disc = std::numbers::pi / 4 * 1e-4;  // d_S = 1 cm; 100 of them in a layer of 1 m
    return refused_key({"--geometry", "shear", "--small-diameter", "1cm", "--length", "1m",
                        "--plate-mass", std::to_string(layers * 100 * disc)});
  };
  EXPECT_EQ(plate(255), "none");
  EXPECT_EQ(plate(257), "plate-mass");
}

// Spheres are of glass. A plate presses them 2500 times as much, so that the inertial number is that of
// the discs.
TEST(Scene, SpheresHaveTheDensityOfGlassUnlessTheyHaveAnother)
{
  EXPECT_EQ(scene_from({}).density, 1);
  const std::vector<std::string> spheres{"--dimension", "3", "--geometry", "shear"};
  EXPECT_EQ(scene_from(spheres).density, 2500);
  EXPECT_EQ(scene_from(spheres).plate_pressure, 5000);
  EXPECT_EQ(scene_from({"--dimension", "3", "--density", "1"}).density, 1);
  EXPECT_DOUBLE_EQ(scene_from(spheres).gravity, scene_from({"--geometry", "shear"}).gravity);
}

TEST(Scene, NearlyElasticGrainsReboundInTheStepInWhichTheyMeet)
{
  EXPECT_EQ(scene_from({"--restitution", "0.9"}).law, ContactLaw::speculative);
  EXPECT_EQ(scene_from({"--restitution", "0.98"}).law, ContactLaw::centred);
  EXPECT_EQ(scene_from({"--restitution", "1", "--contact-law", "speculative"}).law,
            ContactLaw::speculative);
}

TEST(Scene, AKeyWithoutEffectIsRefusedWithWhatWouldGiveItOne)
{
  using Words = std::vector<std::string>;
  for (const auto& [words, condition] :
       {std::pair<Words, std::string>{{"--drum-rate", "3"}, "geometry = drum"},
        {{"--geometry", "shear", "--slope", "10"}, "geometry = bed, drum, column or hopper"},
        {{"--geometry", "drum", "--lateral", "walls", "--depth", "7dL"},
         "geometry = bed, shear, column or hopper"},
        {{"--shake-frequency", "3"}, "shake-amplitude above 0"},
        {{"--base", "wall", "--shake-amplitude", "1mm"}, "base = grains"},
        {{"--restitution", "1", "--horizon", "0.5"}, "contact-law = speculative"},
        {{"--width", "6dL"}, "dimension = 3"},
        {{"--dimension", "3", "--base-spacing", "1dL"}, "dimension = 2"}})
    EXPECT_EQ(complaint_of<SceneError>([&] { scene_from(words); }),
              words.end()[-2].substr(2) + " has an effect only with " + condition +
                  "; leave it out, or change the scene");
}

TEST(Scene, AKeyWithoutEffectMayHaveTheValueThatTheSceneHasWithoutIt)
{
  EXPECT_EQ(refused_key({"--drum-rate", "0.5", "--shake-frequency", "0"}), "none");
  EXPECT_EQ(refused_key({"--geometry", "shear", "--slope", "0"}), "none");
  EXPECT_EQ(refused_key({"--geometry", "drum", "--lateral", "walls", "--drum-diameter", "40dL",
                         "--length", "42dL", "--depth", "16dL"}),
            "none");
}

/// Small scenes of all geometries.
const std::vector<std::vector<std::string>> one_of_each{
    {"--depth", "9dS"},
    {"--base", "wall", "--large-grains", "2"},
    {"--dimension", "3", "--contact-law", "touch"},
    {"--geometry", "drum", "--lateral", "walls"},
    {"--geometry", "shear"},
    {"--geometry", "column", "--lateral", "walls"},
    {"--geometry", "hopper", "--lateral", "walls"},
    {"--geometry", "hopper", "--lateral", "walls", "--dimension", "3", "--outlet-shape", "round"}};

TEST(Scene, ItsTextAsASceneFileIsAccepted)
{
  for (const auto& words : one_of_each) {
    const auto scene = scene_from(words);
    auto values = parse({});
    read_scene_text(to_text(scene), "the scene's text", {}, values);
    EXPECT_EQ(to_text(resolve_scene(values)), to_text(scene));
  }
}

/// Text in which every key without effect has another value than `scene`, as an old file may.
std::string with_other_idle_keys(const Scene& scene)
{
  const std::map<std::string, std::string> others{
      {"depth", "20dS"},         {"length", "30dL"},      {"slope", "11"},
      {"slope-rate", "0.1"},     {"horizon", "0.4"},      {"origin", "centre"},
      {"drum-diameter", "90dS"}, {"drum-rate", "2"},      {"fill", "0.3"},
      {"plate-speed", "3"},      {"plate-pressure", "7"}, {"plate-mass", "4"},
      {"column-width", "19dS"},  {"outlet", "9dS"},       {"shake-frequency", "12"}};
  std::istringstream lines(to_text(scene));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const auto name = line.substr(0, line.find(' '));
    for (const auto& key : scene_keys())
      if (key.name == name && others.contains(name) && key.missing_condition(scene) != nullptr) {
        Scene other = scene;
        key.value.read(name, others.at(name), other);
        line = name + " = " + key.value.text(other);
      }
    text += line + '\n';
  }
  return text;
}

// Files and checkpoints of version 1.0 may state any value of such keys.
TEST(Scene, AStoredSceneMayStateKeysWithoutEffectAndTheyHaveNone)
{
  for (const auto& words : one_of_each) {
    const auto scene = scene_from(words);
    const auto text = with_other_idle_keys(scene);
    EXPECT_NE(text, to_text(scene));
    const auto other = scene_of(text, "an old file");
    EXPECT_EQ(gravity_of<2>(other).at(3), gravity_of<2>(scene).at(3));
    EXPECT_EQ(bed_area(other), bed_area(scene));
    EXPECT_EQ(other.step, scene.step);
    EXPECT_EQ(law_parameters(other).margin, law_parameters(scene).margin);
    const auto all = scene.geometry->boundaries(scene), others = other.geometry->boundaries(other);
    EXPECT_EQ(others.position, all.position);
    EXPECT_EQ(others.radius, all.radius);
    EXPECT_EQ(others.walls.size(), all.walls.size());
    EXPECT_EQ(others.top, all.top);
    EXPECT_EQ(moves_boundaries(other), moves_boundaries(scene));
  }
}

TEST(Scene, BaseAndOrderOfTheDepositionAreStored)
{
  const auto parameters = to_parameters(scene_from(
      {"--base-height-spread", "0.5dS", "--base-spacing", "1.25dL", "--initial", "large-above"}));
  EXPECT_NEAR(parameters.numbers.at("base_height_spread").at(0), 0.0025, 1e-15);
  EXPECT_NEAR(parameters.numbers.at("base_spacing").at(0), 0.0125, 1e-15);
  EXPECT_NEAR(parameters.numbers.at("base_diameter").at(0), 0.01, 1e-15);
  EXPECT_EQ(parameters.numbers.at("base_diameter_spread").at(0), 0);
  EXPECT_EQ(parameters.numbers.at("base_spacing_spread").at(0), 0);
  EXPECT_EQ(parameters.texts.at("initial"), "large-above");
}

TEST(Scene, ItsTextMakesTheSameScene)
{
  const std::vector<std::string> one{"--phi-large", "0.45", "--slope",      "21.5",
                                     "--rotation",  "off",  "--slope-rate", "0.25"};
  const std::vector<std::string> tiny{"--small-diameter", "1e-7m", "--density",        "1e-3",
                                      "--duration",       "1e-3",  "--frame-interval", "1e-5"};
  for (const auto& words : {one, tiny}) {
    const auto scene = scene_from(words);
    auto values = parse({});
    read_scene_text(to_text(scene), "the scene's text", {}, values);
    EXPECT_EQ(to_text(resolve_scene(values)), to_text(scene));
  }
}

TEST(Scene, GrainsUnderMuchHeavierOnesGetMoreSweeps)
{
  const auto sweeps = [](const std::vector<std::string>& words) {
    return scene_from(words).solver.min_sweeps;
  };
  EXPECT_EQ(sweeps({"--size-ratio", "4"}), 8);
  EXPECT_EQ(sweeps({"--size-ratio", "4", "--density-ratio", "4"}), 2 * 8);
  EXPECT_EQ(sweeps({"--size-ratio", "2", "--density-ratio", "0.0625"}), 2 * 8);
  EXPECT_EQ(sweeps({"--size-ratio", "10", "--density-ratio", "1000"}), 16 * 8);
  EXPECT_EQ(sweeps({"--size-ratio", "10", "--density-ratio", "1000", "--phi-large", "0"}), 8);
  EXPECT_EQ(sweeps({"--size-ratio", "10", "--density-ratio", "1000", "--max-sweeps", "20"}), 20);
}

TEST(Scene, GrainsUnderAHeavyPlateGetMoreSweeps)
{
  // There is space under the plate for twenty small discs of 0.0785 kg.
  const auto sweeps = [](const std::vector<std::string>& words) {
    std::vector<std::string> all{"--geometry", "shear", "--phi-large",      "0",
                                 "--density",  "1000",  "--small-diameter", "0.01m",
                                 "--length",   "20dS",  "--plate-pressure", "100"};
    all.insert(all.end(), words.begin(), words.end());
    return scene_from(all).solver.min_sweeps;
  };
  EXPECT_EQ(sweeps({"--plate-mass", "1.5"}), 8);  // 0.95 masses per disc
  EXPECT_EQ(sweeps({}), 2 * 8);                   // 2 masses per disc: beads are twice as large
  EXPECT_EQ(sweeps({"--plate-mass", "14"}), 3 * 8);
}

TEST(Scene, ValuesOutOfRangeAreRefusedByName)
{
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"phi-large", "1.5"},
                                                        {"restitution", "-0.1"},
                                                        {"friction", "nan"},
                                                        {"depth", "0"},
                                                        {"depth", "60"},
                                                        {"length", "3dL"},
                                                        {"slope", "91"},
                                                        {"step", "0.1"},
                                                        {"rotation", "maybe"},
                                                        {"accuracy", "best"},
                                                        {"seed", "-1"},
                                                        {"threads", "-1"},
                                                        {"base", "sand"}}) {
    try {
      scene_from({"--" + key, value});
      FAIL() << key;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
  }
}

TEST_F(SceneFile, AnUnknownKeyIsNamedWithItsLineAndTheNearestKnownOne)
{
  EXPECT_EQ(complaint("# a chute\nslope = 23\nfrction = 0.5\n"),
            path + ":3: unknown key 'frction', did you mean 'friction'?");
}

TEST_F(SceneFile, AnEffectThatNoSceneHasIsAnsweredWithWhatThereIs)
{
  EXPECT_EQ(complaint("slope = 23\ncohesion = 1\n"),
            path +
                ":2: unknown key 'cohesion': in grseg-sim contacts do not attract; they have "
                "friction and restitution; docs/guide/limits.md names programs with more");
  EXPECT_NE(absent_effect("rolling_friction").find("do not resist rolling"), std::string::npos);
  for (const char* key : {"species", "third-diameter", "medium_diameter", "polydispersity"})
    EXPECT_NE(absent_effect(key).find("size-ratio, phi-large"), std::string::npos) << key;
  for (const auto& key : scene_keys()) EXPECT_EQ(absent_effect(key.name), "") << key.name;
}

TEST_F(SceneFile, ATableIsNamedAndNotRead)
{
  EXPECT_EQ(complaint("# program: grseg-micro 1.0.0\na\n1\n"),
            path + ": is a table of grseg-micro 1.0.0, not a scene file: grseg-derive reads it");
}

TEST_F(SceneFile, ALengthWithoutAUnitIsNamedWithItsLine)
{
  EXPECT_EQ(complaint("# a chute\ndepth = 60\n"),
            path + ":2: depth 60 has no unit: 60dS, 60dL or 60m?");
}

TEST_F(SceneFile, ALineThatIsNoKeyAndNoCommentIsNamedByItsNumber)
{
  EXPECT_EQ(complaint("slope = 23\n\n  # steeper?\nfriction 0.5\n").find(path + ":4: "), 0);
}

/// Boost.ProgramOptions would replace such a word by itself again and again.
TEST_F(SceneFile, APlaceholderOfTheParserIsRefused)
{
  for (const char* text : {"%invalid_line%\n", "%option% = 1\n", "slope = %value%\n"})
    EXPECT_NE(complaint(text).find("no key and no value may contain %"), std::string::npos) << text;
}

// "slope = 2", NUL, "1" would be a slope of 2 degrees.
TEST_F(SceneFile, ANulByteIsRefusedWithItsLine)
{
  const std::string text("slope = 23\nfriction = 0.5\nslope = 2\0001\n", 38);
  EXPECT_EQ(
      complaint(text),
      path + ":3: contains a NUL byte, which no text has; save the file as plain text (UTF-8)");
}

TEST_F(SceneFile, AKeyWithoutEffectIsNamedWithItsLine)
{
  EXPECT_EQ(complaint("# a chute\nfill = 0.3\n"),
            path +
                ":2: fill has an effect only with geometry = drum; leave it out, or change the "
                "scene");
}

TEST_F(SceneFile, AValueThatIsNotANumberIsNamedWithItsLine)
{
  EXPECT_EQ(complaint("# a chute\nslope = steep\n"), path + ":2: slope: 'steep' is not a number");
  EXPECT_EQ(complaint("burst = 1.5\n"), path + ":1: burst: '1.5' is not a whole number");
  EXPECT_EQ(complaint("base = sand\n"),
            path + ":1: unknown base 'sand'; choose one of grains, wall");
}

TEST_F(SceneFile, AValueOutOfRangeIsTheFilesFaultUnlessTheCommandLineGaveIt)
{
  std::ofstream(path) << "# a chute\nphi-large = 1.5\n";
  try {
    resolve_scene(path, parse({}));
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_EQ(std::string(error.what()),
              path + ":2: phi-large is 1.5: it must lie between 0 and 1");
  }
  EXPECT_NO_THROW(resolve_scene(path, parse({"--phi-large", "0.5"})));
  EXPECT_THROW(resolve_scene(path, parse({"--phi-large", "2"})), UsageError);
}

TEST_F(SceneFile, TheCommandLineWins)
{
  std::ofstream(path) << "slope = 21\nfriction = 0.3\n";
  auto values = parse({"--slope", "26"});
  read_scene_file(path, values);
  const auto scene = resolve_scene(values);
  EXPECT_EQ(scene.slope, 26);
  EXPECT_EQ(scene.friction, 0.3);
}

TEST_F(SceneFile, MayBeginWithAByteOrderMark)
{
  const std::string mark = "\xef\xbb\xbf";
  std::ofstream(path) << mark + "slope = 21\n";
  EXPECT_EQ(resolve_scene(path, parse({})).slope, 21);
  EXPECT_EQ(complaint(mark + "slope = steep\n"), path + ":1: slope: 'steep' is not a number");
}

TEST_F(SceneFile, ThatDoesNotExistIsAUsageError)
{
  auto values = parse({});
  EXPECT_THROW(read_scene_file("/nowhere/chute.ini", values), UsageError);
}

/// Text of docs/guide/scene-keys.md, generated from the table of keys.
std::string reference_of_keys()
{
  const std::map<KeyRole, std::string> restart{{KeyRole::bed, "no"},
                                               {KeyRole::flow, "yes"},
                                               {KeyRole::extent, "yes, same steps"},
                                               {KeyRole::machine, "yes, same results"}};
  std::ostringstream page;
  page
      << "# Keys of a scene\n\n"
         "Each key is a line `key = value` of a scene file and an option `--key value` of\n"
         "`grseg-sim`; the command line wins. Lengths carry a unit: `5mm`, `2cm`, `0.3m`,\n"
         "`60dS`, `35dL` (nominal diameters of the small and large grains). \"Restart\" says\n"
         "whether `--restart` may change the key. \"Acts\" says where the key has an effect, if not\n"
         "everywhere; elsewhere another value than the default is refused. The table is that of\n"
         "`sim/scene/keys/keys.cpp`; a test keeps this page equal to it.\n\n"
         "| key | default | values | restart | acts | meaning |\n"
         "| --- | --- | --- | --- | --- | --- |\n";
  const auto acts = [](const SceneKey& key) {
    std::string all;
    for (const auto& condition : key.conditions) all += (all.empty() ? "" : ", ") + condition.words;
    return all;
  };
  for (const auto& key : scene_keys())
    page << "| `" << key.name << "` | "
         << (key.default_text.empty() ? "" : "`" + key.default_text + "`") << " | "
         << key.value.kind << ": " << key.value.allowed << " | " << restart.at(key.role) << " | "
         << acts(key) << " | " << key.help << " |\n";
  return page.str();
}

TEST(SceneKeys, StandInTheGuideAsInTheTable)
{
  std::ifstream file(GRSEG_SCENE_KEYS_PAGE);
  std::ostringstream page;
  page << file.rdbuf();
  const auto made = fs::current_path() / "scene-keys.md";
  if (page.str() != reference_of_keys()) std::ofstream(made) << reference_of_keys();
  EXPECT_EQ(page.str(), reference_of_keys())
      << "cp " << made.string() << ' ' << GRSEG_SCENE_KEYS_PAGE << " brings the page up to date";
}

TEST(SceneKeys, HaveDefaultsThatTheyAccept)
{
  std::set<std::string> names;
  auto scene = scene_from({});
  for (const auto& key : scene_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name << " stands twice";
    if (!key.default_text.empty()) {
      EXPECT_NO_THROW(key.value.read(key.name, key.default_text, scene)) << key.name;
    }
    EXPECT_FALSE(key.help.empty()) << key.name;
  }
}

TEST(SceneKeys, OfASceneAreReadBackAsTheyAreWritten)
{
  const auto scene = scene_from({"--large-grains", "3", "--keep-deposition", "--slope", "-5",
                                 "--store", "float32", "--contact-law", "centred"});
  Scene again;
  for (const auto& key : scene_keys())
    if (const auto text = key.value.text(scene); !text.empty())
      key.value.read(key.name, key.with_unit(text), again);
  EXPECT_EQ(to_text(again), to_text(scene));
}

TEST(SceneKeys, ThatDifferAreFoundByWhatTheyBelongTo)
{
  EXPECT_EQ(
      differing_key(scene_from({}), scene_from({"--base-height-spread", "1mm"}), KeyRole::bed),
      "base-height-spread");
  EXPECT_EQ(differing_key(scene_from({}), scene_from({"--initial", "mixed"}), KeyRole::bed),
            "initial");
  const auto one = scene_from({}), other = scene_from({"--duration", "3", "--friction", "0.1"});
  EXPECT_EQ(differing_key(one, other, KeyRole::bed), "");
  EXPECT_EQ(differing_key(one, other, KeyRole::flow), "friction");
  EXPECT_EQ(differing_key(one, other, KeyRole::extent), "duration");
}

// The line "bed" of a table identifies a run; it omits keys that do not affect the motion.
TEST(SceneKeys, ThoseOfExtentAndMachineAndWhichFramesAreWrittenDoNotActOnTheMotion)
{
  const std::set<std::string> of_frames{"frame-interval", "burst", "keep-deposition"};
  for (const auto& key : scene_keys()) {
    const bool acts = key.role == KeyRole::bed || key.role == KeyRole::flow;
    EXPECT_EQ(acts_on_motion(key.name), acts && !of_frames.contains(key.name)) << key.name;
  }
}

}  // namespace
}  // namespace grseg
