// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/derived_quantities.hpp"

#include "analysis/frames/ratio.hpp"
#include "analysis/micro/pressure_estimate.hpp"
#include "analysis/stress/neutral_contacts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

/// A row of derived quantities in the making and what it is derived from.
struct Derivation {
  const SumsRow& row;
  const RunConstants& constants;
  const DerivedSettings& settings;
  std::vector<Cell> cells;

  const StructureSums& sums() const { return row.sums; }
  /// H, m.
  double depth(double height_of_bed) const
  {
    return settings.depth > 0 ? settings.depth : height_of_bed;
  }
  /// d_L/d_S, nominal.
  double size_ratio() const { return constants.large_diameter / constants.small_diameter; }
  void add(std::string column, double value) { cells.push_back({std::move(column), value}); }
};

void add_composition(Derivation& to)
{
  const auto& s = to.sums().species;
  to.add("nu", ratio(s[0].area + s[1].area, to.row.volume));
  to.add("phi_L", to.sums().phi_large());
  for (auto& cell : cells(to.row.heights)) to.cells.push_back(std::move(cell));
  to.add("yL/H", to.row.heights.large / to.depth(to.row.heights.bed));
  to.add("mixed_share", to.sums().mixed_share());
  to.add("neutral_share", neutral_mixed_share(to.sums().phi_large(), to.size_ratio()));
}

void add_coordination(Derivation& to)
{
  to.add("z_S", to.sums().coordination(Species::small));
  to.add("z_L", to.sums().coordination(Species::large));
  const auto by_partner = [&](Species species, const char* own, const char* mixed,
                              const char* base) {
    const auto& s = to.sums().of(species);
    to.add(own, ratio(s.ends - s.mixed_ends - s.base_ends, s.grains));
    to.add(mixed, ratio(s.mixed_ends, s.grains));
    to.add(base, ratio(s.base_ends, s.grains));
  };
  by_partner(Species::small, "z_SS", "z_SL", "z_Sb");
  by_partner(Species::large, "z_LL", "z_LS", "z_Lb");
}

/// Height at which the pressure on a species is taken: the layer's middle, or of the whole bed the
/// species' centre of mass.
double height_of(const Derivation& of, Species species)
{
  if (!of.row.is_bed()) return (of.row.bottom + of.row.top) / 2;
  return species == Species::small ? of.row.heights.small : of.row.heights.large;
}

// The paper's mean forces over m_S g and over the pressure at their height, here rho g cos(theta)
// (H - y) d_S (the paper leaves out cos(theta) and d_S). In the neutral model forces ignore grain
// size and that is the pressure in the grains, so that Pi = z f/(pi d) gives f = pi d rho g
// cos(theta) (H - y)/z.
void add_forces(Derivation& to)
{
  const auto& run = to.constants;
  const double depth = to.depth(to.row.bed_height);
  const double weight = run.density * pi / 4 * run.small_diameter * run.small_diameter *
                        std::hypot(run.gravity_x, run.gravity_y);
  for (const auto species : {Species::small, Species::large}) {
    const bool small = species == Species::small;
    const double f = to.sums().mean_force(species, to.settings.measure);
    const double below = depth - height_of(to, species);
    const double pressure =
        below > 0 ? -run.density * run.gravity_y * below * run.small_diameter : nan;
    const double neutral = pi * (small ? 1 : to.size_ratio()) / to.sums().coordination(species);
    const char* name = small ? "S" : "L";
    to.add(fmt::format("f_{}[N]", name), f);
    to.add(fmt::format("f_weight_{}", name), f / weight);
    to.add(fmt::format("f_weight_neutral_{}", name), neutral * pressure / weight);
    to.add(fmt::format("f_depth_{}", name), f / pressure);
    to.add(fmt::format("f_depth_neutral_{}", name), neutral);
  }
  for (std::size_t type = 0; type < pair_types; ++type) {
    const auto& pair = to.sums().pair[type];
    const bool normal = to.settings.measure.force == ContactForce::normal;
    to.add(fmt::format("f_{}[N]", pair_type_names[type]),
           ratio(normal ? pair.normal : pair.force, pair.contacts));
  }
}

void add_pressures(Derivation& to)
{
  const auto stress = to.sums().stress(to.settings.rule);
  const double p = stress.total.trace() / 2, p_small = stress.small().trace() / 2,
               p_large = stress.large().trace() / 2;
  const auto estimate = estimate_pressure(to.sums(), to.settings.measure,
                                          to.constants.small_diameter, to.constants.large_diameter);
  const auto compare = [&](const char* name, double pressure, double estimated) {
    to.add(fmt::format("P{}[N/m]", name), pressure);
    to.add(fmt::format("Pi{}[N/m]", name), estimated);
    to.add(fmt::format("Pi{}_printed[N/m]", name), 2 * estimated);
    to.add(fmt::format("error{}", name), ratio(estimated, pressure) - 1);
    to.add(fmt::format("error{}_printed", name), ratio(2 * estimated, pressure) - 1);
  };
  compare("", p, estimate.total());
  compare("_S", p_small, estimate.small);
  compare("_L", p_large, estimate.large);

  const double phi = to.sums().phi_large();
  const double z =
      ratio(to.sums().coordination(Species::small), to.sums().coordination(Species::large));
  const double f = ratio(to.sums().mean_force(Species::small, to.settings.measure),
                         to.sums().mean_force(Species::large, to.settings.measure));
  to.add("z_S/z_L", z);
  to.add("f_S/f_L", f);
  const auto slope_and_b = [&](const char* of, double slope) {
    to.add(fmt::format("s_{}", of), slope);
    to.add(fmt::format("B_{}", of), local_b(slope, phi));
  };
  slope_and_b("Pi", to.size_ratio() * z * f);
  slope_and_b("P", partition_slope(p_small, p_large, phi));
  slope_and_b("yy", partition_slope(stress.small()(1, 1), stress.large()(1, 1), phi));
}

void add_friction(Derivation& to)
{
  const auto all = to.sums().between_grains();
  const auto add = [&](const char* name, const PairSums& pair) {
    to.add(fmt::format("mobilised_{}", name),
           ratio(pair.mobilised, to.constants.friction * pair.contacts));
    to.add(fmt::format("sliding_{}", name), ratio(pair.sliding, pair.contacts));
  };
  for (std::size_t type = 0; type < pair_types; ++type)
    add(pair_type_names[type], to.sums().pair[type]);
  add("all", all);
  for (const auto type : {PairType::SS, PairType::LS, PairType::LL}) {
    const auto& pair = to.sums().of(type);
    const char* name = pair_type_names[static_cast<std::size_t>(type)];
    to.add(fmt::format("strong_{}", name), ratio(pair.strong, pair.contacts));
    to.add(fmt::format("share_of_strong_{}", name), ratio(pair.strong, all.strong));
    to.add(fmt::format("share_of_weak_{}", name),
           ratio(pair.contacts - pair.strong, all.contacts - all.strong));
  }
  to.add("strong_all", ratio(all.strong, all.contacts));
}

void add_fabric(Derivation& to)
{
  const auto add = [&](const char* name, const PairSums& pair) {
    const auto a = anisotropy(pair.fabric, pair.contacts, pair.normal);
    const auto stress = principal_stress(pair.stress);
    to.add(fmt::format("a_c_{}", name), a.a_c);
    to.add(fmt::format("a_n_{}", name), a.a_n);
    to.add(fmt::format("a_t_{}", name), a.a_t);
    to.add(fmt::format("theta_c_{}[deg]", name), a.theta_c);
    to.add(fmt::format("theta_n_{}[deg]", name), a.theta_n);
    to.add(fmt::format("theta_t_{}[deg]", name), a.theta_t);
    to.add(fmt::format("q/p_{}", name), ratio(stress.q, stress.p));
    to.add(fmt::format("theta_{}[deg]", name), pair.contacts > 0 ? stress.theta : nan);
    to.add(fmt::format("rothenburg_{}", name), a.rothenburg());
    to.add(fmt::format("rothenburg_full_{}", name), std::isnan(a.a_n) ? nan : a.stress_ratio());
  };
  for (std::size_t type = 0; type < pair_types; ++type)
    add(pair_type_names[type], to.sums().pair[type]);
  add("all", to.sums().between_grains());
}

}  // namespace

std::vector<Cell> derived_quantities(const SumsRow& row, const RunConstants& constants,
                                     const DerivedSettings& settings)
{
  Derivation to{row, constants, settings, {}};
  add_composition(to);
  add_coordination(to);
  add_forces(to);
  add_pressures(to);
  add_friction(to);
  add_fabric(to);
  return std::move(to.cells);
}

}  // namespace grseg
