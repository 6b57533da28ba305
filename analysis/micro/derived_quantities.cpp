// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/derived_quantities.hpp"

#include "analysis/stress/partition_rule.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace grseg {

template <int D>
PressureEstimate estimate_pressure(const StructureSums<D>& sums, const ForceMeasure& measure,
                                   double small_diameter, double large_diameter)
{
  const double phi_large = sums.phi_large();
  const auto partial = [&](Species species, double phi, double diameter) {
    if (phi == 0) return 0.0;
    return phi * sums.coordination(species) * sums.mean_force(species, measure) /
           (std::numbers::pi * (D == 2 ? diameter : diameter * diameter));
  };
  return {partial(Species::small, 1 - phi_large, small_diameter),
          partial(Species::large, phi_large, large_diameter)};
}

template PressureEstimate estimate_pressure(const StructureSums<2>&, const ForceMeasure&, double,
                                            double);
template PressureEstimate estimate_pressure(const StructureSums<3>&, const ForceMeasure&, double,
                                            double);

double partition_slope(double stress_small, double stress_large, double phi_large)
{
  const double phi_small = 1 - phi_large;
  if (!(phi_large > 0 && phi_small > 0 && stress_large > 0)) return no_number;
  return stress_small * phi_large / (stress_large * phi_small);
}

double local_b(double slope, double phi_large)
{
  return (1 - slope) / (phi_large + slope * (1 - phi_large));
}

namespace {

constexpr double pi = std::numbers::pi;

/// The cells of a row of derived quantities, and the data from which they are derived.
template <int D>
struct Derivation {
  const SumsRow<D>& row;
  const RunConstants& constants;
  const DerivedSettings& settings;
  std::vector<Cell> cells;

  const StructureSums<D>& sums() const { return row.sums; }
  /// Height H of the surface, m.
  double depth(double height_of_bed) const
  {
    return settings.depth > 0 ? settings.depth : height_of_bed;
  }
  /// Ratio d_L/d_S of nominal diameters.
  double size_ratio() const { return constants.large_diameter / constants.small_diameter; }
  void add(std::string column, double value) { cells.push_back({std::move(column), value}); }
};

template <int D>
void add_composition(Derivation<D>& to)
{
  const auto& s = to.sums().species;
  to.add("nu", ratio(s[0].content + s[1].content, to.row.volume));
  to.add("phi_L", to.sums().phi_large());
  add_all(to.cells, cells(to.row.heights));
  to.add("yL/H", to.row.heights.large / to.depth(to.row.heights.bed));
  to.add("mixed_share", to.sums().mixed_share());
  to.add("neutral_share", neutral_mixed_share(to.sums().phi_large(), to.size_ratio()));
}

template <int D>
void add_coordination(Derivation<D>& to)
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

/// Height of the pressure by which forces on a species are divided, m: the layer's middle, or for
/// the whole bed the species' centre of mass.
template <int D>
double height_of(const Derivation<D>& of, Species species)
{
  if (!of.row.is_bed()) return (of.row.bottom + of.row.top) / 2;
  return species == Species::small ? of.row.heights.small : of.row.heights.large;
}

/// Perimeter of a disc or surface of a sphere, divided by pi: d or d^2.
template <int D>
double perimeter(double d)
{
  return D == 2 ? d : d * d;
}

template <int D>
double gravity_of(const RunConstants& run)
{
  const double in_plane = std::hypot(run.gravity_x, run.gravity_y);
  return D == 2 ? in_plane : std::hypot(in_plane, run.gravity_z);
}

// Mean forces of Staron & Phillips (2015) over m_S g and over the pressure at their height, here
// rho g cos(theta) (H - y) d_S (they leave out cos(theta) and d_S); d_S^2 in three dimensions. In
// the neutral model forces do not depend on grain size, and rho g cos(theta) (H - y) is the
// pressure in the grains. Then Pi = z f/(pi d) gives f = pi d rho g cos(theta) (H - y)/z; with d^2
// for spheres.
template <int D>
void add_forces(Derivation<D>& to)
{
  const auto& run = to.constants;
  const double depth = to.depth(to.row.bed_height);
  const double d = run.small_diameter;
  const double mass = D == 2 ? run.density * pi / 4 * d * d : run.density * pi / 6 * d * d * d;
  const double weight = mass * gravity_of<D>(run);
  for (const auto species : {Species::small, Species::large}) {
    const bool small = species == Species::small;
    const double f = to.sums().mean_force(species, to.settings.measure);
    const double below = depth - height_of(to, species);
    const double pressure =
        below > 0 ? -run.mean_density * run.gravity_y * below * perimeter<D>(d) : no_number;
    const double neutral =
        pi * perimeter<D>(small ? 1 : to.size_ratio()) / to.sums().coordination(species);
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

template <int D>
void add_pressures(Derivation<D>& to)
{
  const auto stress = to.sums().stress(to.settings.rule);
  const double p = stress.total.trace() / D, p_small = stress.small().trace() / D,
               p_large = stress.large().trace() / D;
  const auto estimate = estimate_pressure(to.sums(), to.settings.measure,
                                          to.constants.small_diameter, to.constants.large_diameter);
  constexpr bool printed = D == 2;  // Staron & Phillips (2015) print an equation for discs only
  const char* unit = D == 2 ? "[N/m]" : "[Pa]";
  const auto compare = [&](const char* name, double pressure, double estimated) {
    to.add(fmt::format("P{}{}", name, unit), pressure);
    to.add(fmt::format("Pi{}{}", name, unit), estimated);
    if (printed) to.add(fmt::format("Pi{}_printed{}", name, unit), 2 * estimated);
    to.add(fmt::format("error{}", name), ratio(estimated, pressure) - 1);
    if (printed) to.add(fmt::format("error{}_printed", name), ratio(2 * estimated, pressure) - 1);
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
  slope_and_b("Pi", perimeter<D>(to.size_ratio()) * z * f);
  slope_and_b("P", partition_slope(p_small, p_large, phi));
  slope_and_b("yy", partition_slope(stress.small()(1, 1), stress.large()(1, 1), phi));
}

template <int D>
void add_friction(Derivation<D>& to)
{
  const auto all = to.sums().between_grains();
  const auto add = [&](const char* name, const PairSums<D>& pair) {
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

/// Principal stress without contacts: p = q = 0, and NaN for the direction.
template <int D>
PrincipalStress<D> no_stress()
{
  if constexpr (D == 2)
    return {0, 0, no_number};
  else
    return {0, 0, no_number, Vec3::Constant(no_number)};
}

/// Adds the sizes and directions of a pair type's anisotropies, and its principal stress.
void add_anisotropy(std::vector<Cell>& cells, const char* name, const Anisotropy<2>& a,
                    const PrincipalStress<2>& stress)
{
  const auto add = [&](const char* column, double value) {
    cells.push_back({fmt::format(fmt::runtime(column), name), value});
  };
  add("a_c_{}", a.a_c);
  add("a_n_{}", a.a_n);
  add("a_t_{}", a.a_t);
  add("theta_c_{}[deg]", a.theta_c);
  add("theta_n_{}[deg]", a.theta_n);
  add("theta_t_{}[deg]", a.theta_t);
  add("q/p_{}", ratio(stress.q, stress.p));
  add("theta_{}[deg]", stress.theta);
}

void add_anisotropy(std::vector<Cell>& cells, const char* name, const Anisotropy<3>& a,
                    const PrincipalStress<3>& stress)
{
  const auto add = [&](const std::string& column, const char* unit, double value) {
    cells.push_back({fmt::format("{}_{}{}", column, name, unit), value});
  };
  const auto add_axis = [&](const char* of, const Vec3& axis) {
    const auto [theta, tilt] = axis_angles(axis);
    add(fmt::format("theta{}", of), "[deg]", theta);
    add(fmt::format("tilt{}", of), "[deg]", tilt);
  };
  add("a_c", "", a.a_c);
  add("a_n", "", a.a_n);
  add("a_t", "", a.a_t);
  add_axis("_c", major_axis(a.c));
  add_axis("_n", major_axis(a.n));
  add_axis("_t", major_axis(a.t));
  add("q/p", "", ratio(stress.q, stress.p));
  add("b", "", stress.b);
  add_axis("", stress.major);
}

template <int D>
void add_fabric(Derivation<D>& to)
{
  const auto none = no_stress<D>();
  const auto add = [&](const char* name, const PairSums<D>& pair) {
    const auto a = anisotropy(pair.fabric, pair.contacts, pair.normal);
    add_anisotropy(to.cells, name, a, pair.contacts > 0 ? principal_stress(pair.stress) : none);
    to.add(fmt::format("rothenburg_{}", name), a.rothenburg());
    to.add(fmt::format("rothenburg_full_{}", name),
           std::isnan(a.a_n) ? no_number : a.stress_ratio());
  };
  for (std::size_t type = 0; type < pair_types; ++type)
    add(pair_type_names[type], to.sums().pair[type]);
  add("all", to.sums().between_grains());
}

}  // namespace

template <int D>
std::vector<Cell> derived_quantities(const SumsRow<D>& row, const RunConstants& constants,
                                     const DerivedSettings& settings)
{
  Derivation<D> to{row, constants, settings, {}};
  add_composition(to);
  add_coordination(to);
  add_forces(to);
  add_pressures(to);
  add_friction(to);
  add_fabric(to);
  return std::move(to.cells);
}

template std::vector<Cell> derived_quantities(const SumsRow<2>&, const RunConstants&,
                                              const DerivedSettings&);
template std::vector<Cell> derived_quantities(const SumsRow<3>&, const RunConstants&,
                                              const DerivedSettings&);

}  // namespace grseg
