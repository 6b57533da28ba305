// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/run_facts.hpp"

#include "formats/cli/words.hpp"
#include "formats/import/facts/dimension.hpp"
#include "formats/import/facts/wall_planes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

bool good_mass(const ArchiveGrains& grains, std::size_t g)
{
  return !grains.mass.empty() && grains.mass[g] > 0 && std::isfinite(grains.mass[g]);
}

/// Area of a disc or volume of a sphere.
double content(double radius, bool discs)
{
  return discs ? std::numbers::pi * radius * radius
               : 4 * std::numbers::pi / 3 * radius * radius * radius;
}

/// Largest deviation of mass/content among the grains that have a mass, relative.
double spread_of_density(const ArchiveGrains& grains, bool discs)
{
  double low = INFINITY, high = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!good_mass(grains, g)) continue;
    const double density = grains.mass[g] / content(grains.radius[g], discs);
    low = std::min(low, density);
    high = std::max(high, density);
  }
  return high > 0 ? high / low - 1 : INFINITY;
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

/// Collects what neither archive nor command line states.
class Missing {
 public:
  template <class Value>
  Value take(const std::optional<Value>& value, const char* what)
  {
    if (!value) add(what);
    return value.value_or(Value{});
  }
  void add(const char* what) { list_.emplace_back(what); }
  void report() const
  {
    if (!list_.empty())
      throw UsageError(
          fmt::format("the archive does not state {}; pass them", fmt::join(list_, ", nor ")));
  }

 private:
  std::vector<std::string> list_;
};

/// The value on the command line, which must agree with the archive's, or else the archive's.
std::optional<double> either(const std::optional<double>& archive,
                             const std::optional<double>& given, const char* option)
{
  if (archive && given && std::abs(*archive - *given) > 1e-6 * std::abs(*archive))
    throw UsageError(fmt::format("{} is {:g}, but the archive says {:.10g}; leave the option out",
                                 option, *given, *archive));
  return given ? given : archive;
}

std::optional<bool> discs_or_spheres(const ArchiveFacts& archive, const ArchiveGrains& grains,
                                     const ImportSettings& settings)
{
  const auto by_mass = discs_by_mass(grains);
  const auto known = by_mass ? by_mass : archive.discs;
  if (!settings.grains) return known;
  const bool discs =
      choose<bool>(*settings.grains, "--grains-are", {{"discs", true}, {"spheres", false}});
  if (known && discs != *known)
    throw UsageError(fmt::format(
        "--grains-are {}, but {}: leave the option out, or {}", *settings.grains,
        by_mass ? (discs ? "masses grow as the cube of the radius" : "masses grow as its square")
                : "the archive says otherwise",
        discs ? "was density/disc not set in the run?" : "use --grains-are discs"));
  return discs;
}

std::optional<std::string> units_of(const ArchiveFacts& archive, const ImportSettings& settings)
{
  if (!archive.units) return settings.units;
  const bool known = *archive.units == "si" || *archive.units == "cgs";
  if (settings.units && known && *settings.units != *archive.units)
    throw UsageError(fmt::format("--units {}, but the archive says {}; leave the option out",
                                 *settings.units, *archive.units));
  if (!settings.units && !known)
    throw UsageError(
        fmt::format("the archive is in units {}: give them in m, s and kg with --units "
                    "LENGTH:TIME:MASS",
                    *archive.units));
  return settings.units ? settings.units : archive.units;
}

}  // namespace

RunFacts collect_facts(const ArchiveFacts& archive, const ArchiveMoment& first,
                       const ImportSettings& settings)
{
  const auto& grains = first.grains;
  if (grains.radius.empty())
    throw FormatError(
        "the grains of the archive have no radius or diameter, so they cannot be imported");
  Missing missing;
  const auto units = missing.take(units_of(archive, settings), "its units (--units si)");
  const double step =
      missing.take(either(archive.step, settings.step, "--step"), "the time step (--step)");
  std::optional<GravityText> gravity;
  if (settings.gravity)
    gravity = parse_gravity(*settings.gravity);
  else if (archive.gravity)
    gravity = GravityText{std::nullopt, archive.gravity};
  missing.take(gravity, "gravity (--gravity 3.8,-9.0,0, or --gravity 9.8 --slope 23)");
  const bool discs = missing.take(discs_or_spheres(archive, grains, settings),
                                  "whether grains are discs or spheres (--grains-are discs)");
  const auto density = either(archive.density, settings.density, "--density");
  if (grains.mass.empty() && !density) missing.add("masses (--density)");
  auto walls = archive.walls;
  for (const auto& wall : parse_walls(settings.walls)) walls.push_back(list_of({wall}));
  if (!settings.species.boundary && !settings.species.boundary_ids && grains.fixed.empty() &&
      walls.empty())
    missing.add(
        "which grains are the base (--boundary TYPES, --boundary-ids IDS, or --boundary none)");
  missing.report();
  if (!(step > 0)) throw UsageError(fmt::format("a time step of {:g} is not positive", step));
  const int dimension = dimension_of(first, settings.axes, discs, settings.dimension);
  return {step,
          dimension,
          orientation_of(settings.axes, *gravity, settings.slope, dimension),
          discs,
          walls,
          density,
          parse_units(units),
          units};
}

std::vector<double> masses_of(const ArchiveGrains& grains, const RunFacts& facts)
{
  std::vector<double> mass(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (good_mass(grains, g))
      mass[g] = grains.mass[g];
    else if (facts.density)
      mass[g] = *facts.density * content(grains.radius[g], facts.discs);
    else
      throw FormatError(fmt::format("grain {} has the mass {:g}; give its --density", grains.id[g],
                                    grains.mass[g]));
  }
  return mass;
}

}  // namespace grseg
