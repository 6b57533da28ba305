// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/run_facts.hpp"

#include "formats/cli/words.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/facts/cell_and_walls.hpp"
#include "formats/import/facts/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

bool good_mass(const ArchiveGrains& grains, std::size_t g)
{
  return !grains.mass.empty() && grains.mass[g] > 0 && std::isfinite(grains.mass[g]);
}

/// Area of a disc, or volume of a sphere.
double content(double radius, bool discs)
{
  return discs ? grain_volume<2>(radius) : grain_volume<3>(radius);
}

/// Largest relative difference of the densities (mass/content) of grains that have a mass.
double spread_of_density(const ArchiveGrains& grains, bool discs)
{
  Range density;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (good_mass(grains, g)) density.add(grains.mass[g] / content(grains.radius[g], discs));
  return density.high > 0 ? density.high / density.low - 1 : INFINITY;
}

std::optional<bool> discs_by_mass(const ArchiveGrains& grains)
{
  constexpr double same = 1e-3, different = 1e-2;
  const double as_discs = spread_of_density(grains, true);
  const double as_spheres = spread_of_density(grains, false);
  if (as_discs < same && as_spheres > different) return true;
  if (as_spheres < same && as_discs > different) return false;
  return std::nullopt;
}

/// The value on the command line, otherwise in the archive. Throws UsageError if the two differ.
std::optional<double> either(const std::optional<double>& archive,
                             const std::optional<double>& given, const char* option)
{
  if (archive && given && std::abs(*archive - *given) > 1e-6 * std::abs(*archive))
    throw UsageError(fmt::format("{} is {:g}, but the archive states {:.10g}; leave the option out",
                                 option, *given, *archive));
  return given ? given : archive;
}

/// True for discs; empty if neither --grains-are nor the archive states the shape. Throws
/// UsageError if they contradict each other.
std::optional<bool> discs_or_spheres(const ArchiveFacts& archive, const ImportSettings& settings)
{
  if (!settings.grains) return archive.discs;
  const bool discs = choose(*settings.grains, "--grains-are", grain_words);
  if (archive.discs && discs != *archive.discs)
    throw UsageError(fmt::format("--grains-are {}, but the archive states {}; leave the option out",
                                 *settings.grains, *archive.discs ? "discs" : "spheres"));
  return discs;
}

std::optional<std::string> units_of(const ArchiveFacts& archive, const ImportSettings& settings)
{
  if (!archive.units) return settings.units;
  const bool known = *archive.units == "si" || *archive.units == "cgs";
  if (settings.units && known && *settings.units != *archive.units)
    throw UsageError(fmt::format("--units {}, but the archive states {}; leave the option out",
                                 *settings.units, *archive.units));
  return settings.units || !known ? settings.units : archive.units;
}

/// Throws UsageError if the archive's masses correspond to another density than --density.
void require_density(const ArchiveGrains& grains, double density, bool discs)
{
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!good_mass(grains, g)) continue;
    const double found = grains.mass[g] / content(grains.radius[g], discs);
    if (std::abs(found - density) > 1e-3 * density)
      throw UsageError(
          fmt::format("--density is {:g}, but the masses in the archive correspond "
                      "to {:.6g} (grain {}); leave the option out",
                      density, found, grains.id[g]));
  }
}

/// Finds the facts of a run one by one, and asks questions for missing ones.
class FactFinder {
 public:
  FactFinder(const ArchiveFacts& archive, const FirstLook& look, const ImportSettings& settings,
             Questions& questions)
      : archive_(archive), look_(look), settings_(settings), questions_(questions)
  {
  }

  RunFacts find()
  {
    find_units();
    find_step();
    find_grains();
    const auto direction = gravity();
    find_axes(direction);
    find_base();
    facts_.dimension = dimension_of(look_.all, facts_.axes, facts_.discs, settings_.dimension);
    find_orientation(direction);
    // This error is thrown before open questions are asked, unless an answer may change the axes.
    const auto normal = facts_.orientation.axes.axis_of(1);
    if (normal && (settings_.axes || (direction && direction->vector)))
      require_open_normal(look_.all, *normal);
    return facts_;
  }

 private:
  void find_units()
  {
    const auto units = units_of(archive_, settings_);
    if (!units && archive_.units)
      questions_.ask({fmt::format("the size of its units '{}'", *archive_.units),
                      "--units LENGTH:TIME:MASS", "in m, s, kg"});
    else if (!units)
      questions_.ask(
          {"its units", "--units UNITS",
           fmt::format("si, cgs, or LENGTH:TIME:MASS in m, s, kg; grains are up to {:.4g} "
                       "wide",
                       2 * *std::max_element(look_.all.grains.radius.begin(),
                                             look_.all.grains.radius.end()))});
    facts_.units_as_given = units.value_or("si");
    facts_.units = parse_units(facts_.units_as_given);
  }

  void find_step()
  {
    const auto step = either(archive_.step, settings_.step, "--step");
    if (!step && !settings_.interval)
      questions_.ask({"the length of a time step", "--step DT", "in the archive's units"});
    facts_.step = step.value_or(settings_.interval.value_or(1));
    facts_.knows_step = step.has_value();
    if (!(facts_.step > 0))
      throw UsageError(fmt::format("a time step of {:g} is not positive", facts_.step));
  }

  void find_grains()
  {
    const auto& grains = look_.all.grains;
    auto discs = discs_or_spheres(archive_, settings_);
    if (!discs && plane_of(grains).empty()) discs = false;
    const auto by_mass = discs_by_mass(grains);
    if (!discs && by_mass == true) discs = true;
    if (discs && by_mass && discs != by_mass)
      facts_.doubt_of_masses = fmt::format(
          "grains are taken for {}, but their masses grow as the {} of the radius: their densities "
          "differ by a factor of {:.3g}, or they are {}",
          *discs ? "discs" : "spheres", *discs ? "cube" : "square",
          1 + spread_of_density(grains, *discs), *discs ? "spheres" : "discs");
    if (!discs)
      questions_.ask(
          {"the shape of the grains", by_mass ? "--grains-are spheres" : "--grains-are WHAT",
           by_mass ? "masses grow as the cube of the radius, as of "
                     "spheres (or of discs of two densities)"
                   : "discs or spheres: without density/disc LAMMPS simulates spheres, also in two "
                     "dimensions"});
    facts_.discs = discs.value_or(true);
    facts_.density = either(archive_.density, settings_.density, "--density");
    if (settings_.density && discs) require_density(grains, *settings_.density, *discs);
    if (grains.mass.empty() && !facts_.density)
      questions_.ask({"the masses of the grains", "--density RHO",
                      facts_.discs ? "per area of discs" : "per volume of spheres"});
  }

  void find_base()
  {
    for (const auto& wall : parse_walls(settings_.walls)) facts_.walls.push_back(list_of({wall}));
    facts_.walls.insert(facts_.walls.end(), archive_.walls.begin(), archive_.walls.end());
    if (settings_.species.boundary || settings_.species.boundary_ids ||
        !look_.all.grains.fixed.empty())
      return;
    // No grain rests; if there are no walls either, ask_for_the_bed() asks (scan.cpp).
    if (look_.resting.empty()) return;
    const auto question = question_of_base(look_.all.grains, look_.resting);
    // A flow between walls may have no base grains; ask only if some grains never move.
    if (facts_.walls.empty() || question.option != "--boundary none") questions_.ask(question);
  }

  /// Gravity by the command line or the archive; if both lack it, the proposed vector, if any.
  std::optional<GravityText> gravity()
  {
    if (settings_.gravity) return parse_gravity(*settings_.gravity);
    if (archive_.gravity) return GravityText{std::nullopt, archive_.gravity};
    const auto& grains = look_.frame.grains;
    const bool has_mass = !grains.mass.empty() || facts_.density;
    const auto suggested =
        suggested_gravity(look_.frame, has_mass ? masses_of(grains, facts_) : std::vector<double>(),
                          resting_grains(grains, nullptr));
    if (suggested)
      questions_.ask({"gravity", "--gravity " + gravity_option(*suggested),
                      "suggested by the forces on the grains; or its magnitude and --slope"});
    else
      questions_.ask({"gravity", "--gravity GX,GY,GZ", "or --gravity G --slope DEGREES"});
    if (!suggested) return std::nullopt;
    return GravityText{std::nullopt, suggested};
  }

  void find_axes(const std::optional<GravityText>& gravity)
  {
    if (settings_.axes) {
      facts_.axes = *settings_.axes;
      return;
    }
    const auto axes = question_of_axes(look_.all, settings_.dimension == 3,
                                       gravity ? gravity->vector : std::nullopt);
    if (!axes) return;
    questions_.ask(*axes);
    facts_.axes = axes->option.substr(axes->option.size() - 2);
  }

  /// Finds the axes of the flow, which are not rotated if gravity or the slope is unknown.
  void find_orientation(const std::optional<GravityText>& gravity)
  {
    auto slope = settings_.slope;
    if (gravity && gravity->magnitude && !slope)
      questions_.ask({"the inclination of the base", "--slope DEGREES",
                      "--gravity is a magnitude; or pass the vector, as in --gravity 3.8,-9.0,0"});
    if (!gravity || gravity->magnitude) slope = slope.value_or(0);
    facts_.orientation = orientation_of(facts_.axes, gravity.value_or(GravityText{1, std::nullopt}),
                                        slope, facts_.dimension);
    if (gravity && gravity->vector && !slope)
      require_towards_the_base(*gravity->vector, facts_.orientation, facts_.axes);
  }

  const ArchiveFacts& archive_;
  const FirstLook& look_;
  const ImportSettings& settings_;
  Questions& questions_;
  RunFacts facts_;
};

}  // namespace

RunFacts collect_facts(const ArchiveFacts& archive, const FirstLook& look,
                       const ImportSettings& settings, Questions& questions)
{
  if (look.all.grains.radius.empty())
    throw FormatError(
        "the grains of the archive have no radius or diameter, so they cannot be imported");
  return FactFinder(archive, look, settings, questions).find();
}

std::vector<double> masses_of(const ArchiveGrains& grains, const RunFacts& facts)
{
  std::vector<double> mass(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (good_mass(grains, g))
      mass[g] = grains.mass[g];
    else if (grains.mass.empty() && !facts.density)
      mass[g] = 1;  // meaningless: a question asks for the density
    else if (facts.density)
      mass[g] = *facts.density * content(grains.radius[g], facts.discs);
    else
      throw FormatError(fmt::format("grain {} has the mass {:g}; pass the density with --density",
                                    grains.id[g], grains.mass[g]));
  }
  return mass;
}

}  // namespace grseg
