// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/micro_view.hpp"

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

double ratio(double a, double b)
{
  return b > 0 ? a / b : nan;
}

/// One row being written.
struct View {
  const MicroRow& row;
  const MicroScale& scale;
  const ViewSettings& settings;
  std::vector<Cell> cells;

  const MicroSums& sums() const { return row.sums; }
  void add(std::string name, double value) { cells.push_back({std::move(name), value}); }
};

void add_composition(View& view)
{
  const auto& s = view.sums().species;
  view.add("nu", ratio(s[0].area + s[1].area, view.row.volume));
  view.add("phi_L", view.sums().phi_large());
  view.add("yL[m]", view.row.heights.large);
  view.add("yS[m]", view.row.heights.small);
  view.add("height[m]", view.row.heights.bed);
  view.add("yL/H", view.row.heights.large /
                       (view.settings.depth > 0 ? view.settings.depth : view.row.heights.bed));
  view.add("mixed_share", view.sums().mixed_share());
  view.add("neutral_share",
           neutral_mixed_share(view.sums().phi_large(),
                               view.scale.large_diameter / view.scale.small_diameter));
}

void add_coordination(View& view)
{
  view.add("z_S", view.sums().coordination(Species::small));
  view.add("z_L", view.sums().coordination(Species::large));
  const auto by_partner = [&](Species species, const char* own, const char* mixed,
                              const char* base) {
    const auto& s = view.sums().of(species);
    view.add(own, ratio(s.ends - s.mixed_ends - s.base_ends, s.grains));
    view.add(mixed, ratio(s.mixed_ends, s.grains));
    view.add(base, ratio(s.base_ends, s.grains));
  };
  by_partner(Species::small, "z_SS", "z_SL", "z_Sb");
  by_partner(Species::large, "z_LL", "z_LS", "z_Lb");
}

/// Height of the pressure that grains of a species feel: the layer's middle, or their centre of
/// mass.
double height_of(const View& view, Species species)
{
  if (!view.row.is_bed()) return (view.row.bottom + view.row.top) / 2;
  return species == Species::small ? view.row.heights.small : view.row.heights.large;
}

// In the neutral model forces do not know of sizes and the pressure in the grains is
// rho g cos(theta) (H - y), so that Pi = z f/(pi d) gives f = pi d rho g cos(theta) (H - y)/z.
void add_forces(View& view)
{
  const auto& scale = view.scale;
  const double depth = view.settings.depth > 0 ? view.settings.depth : view.row.bed_height;
  const double weight = scale.density * pi / 4 * scale.small_diameter * scale.small_diameter *
                        std::hypot(scale.gravity_x, scale.gravity_y);
  for (const auto species : {Species::small, Species::large}) {
    const bool small = species == Species::small;
    const double f = view.sums().mean_force(species, view.settings.measure);
    const double below = depth - height_of(view, species);
    const double pressure =
        below > 0 ? -scale.density * scale.gravity_y * below * scale.small_diameter : nan;
    const double neutral = pi * (small ? 1 : scale.large_diameter / scale.small_diameter) /
                           view.sums().coordination(species);
    const char* name = small ? "S" : "L";
    view.add(fmt::format("f_{}[N]", name), f);
    view.add(fmt::format("f_weight_{}", name), f / weight);
    view.add(fmt::format("f_weight_neutral_{}", name), neutral * pressure / weight);
    view.add(fmt::format("f_depth_{}", name), f / pressure);
    view.add(fmt::format("f_depth_neutral_{}", name), neutral);
  }
  for (std::size_t type = 0; type < pair_types; ++type) {
    const auto& pair = view.sums().pair[type];
    const bool normal = view.settings.measure.force == ContactForce::normal;
    view.add(fmt::format("f_{}[N]", pair_type_names[type]),
             ratio(normal ? pair.normal : pair.force, pair.contacts));
  }
}

void add_pressures(View& view)
{
  const auto stress = view.sums().stress(view.settings.rule);
  const double p = stress.total.trace() / 2, p_small = stress.small.trace() / 2,
               p_large = stress.large.trace() / 2;
  const auto estimate = estimate_pressure(view.sums(), view.settings.measure,
                                          view.scale.small_diameter, view.scale.large_diameter);
  const auto compare = [&](const char* name, double pressure, double estimated) {
    view.add(fmt::format("P{}[N/m]", name), pressure);
    view.add(fmt::format("Pi{}[N/m]", name), estimated);
    view.add(fmt::format("Pi{}_printed[N/m]", name), 2 * estimated);
    view.add(fmt::format("error{}", name), ratio(estimated, pressure) - 1);
    view.add(fmt::format("error{}_printed", name), ratio(2 * estimated, pressure) - 1);
  };
  compare("", p, estimate.total());
  compare("_S", p_small, estimate.small);
  compare("_L", p_large, estimate.large);

  const double phi = view.sums().phi_large();
  const double z =
      ratio(view.sums().coordination(Species::small), view.sums().coordination(Species::large));
  const double f = ratio(view.sums().mean_force(Species::small, view.settings.measure),
                         view.sums().mean_force(Species::large, view.settings.measure));
  view.add("z_S/z_L", z);
  view.add("f_S/f_L", f);
  const auto slope_and_b = [&](const char* of, double slope) {
    view.add(fmt::format("s_{}", of), slope);
    view.add(fmt::format("B_{}", of), local_b(slope, phi));
  };
  slope_and_b("Pi", view.scale.large_diameter / view.scale.small_diameter * z * f);
  slope_and_b("P", partition_slope(p_small, p_large, phi));
  slope_and_b("yy", partition_slope(stress.small(1, 1), stress.large(1, 1), phi));
}

void add_friction(View& view)
{
  const auto all = view.sums().between_grains();
  const auto add = [&](const char* name, const PairSums& pair) {
    view.add(fmt::format("mobilised_{}", name),
             ratio(pair.mobilised, view.scale.friction * pair.contacts));
    view.add(fmt::format("sliding_{}", name), ratio(pair.sliding, pair.contacts));
  };
  for (std::size_t type = 0; type < pair_types; ++type)
    add(pair_type_names[type], view.sums().pair[type]);
  add("all", all);
  for (const auto type : {PairType::SS, PairType::LS, PairType::LL}) {
    const auto& pair = view.sums().of(type);
    const char* name = pair_type_names[static_cast<std::size_t>(type)];
    view.add(fmt::format("strong_{}", name), ratio(pair.strong, pair.contacts));
    view.add(fmt::format("share_of_strong_{}", name), ratio(pair.strong, all.strong));
    view.add(fmt::format("share_of_weak_{}", name),
             ratio(pair.contacts - pair.strong, all.contacts - all.strong));
  }
  view.add("strong_all", ratio(all.strong, all.contacts));
}

void add_fabric(View& view)
{
  const auto add = [&](const char* name, const PairSums& pair) {
    const auto a = anisotropy(pair.fabric, pair.contacts, pair.normal);
    const auto stress = principal_stress(pair.stress);
    view.add(fmt::format("a_c_{}", name), a.a_c);
    view.add(fmt::format("a_n_{}", name), a.a_n);
    view.add(fmt::format("a_t_{}", name), a.a_t);
    view.add(fmt::format("theta_c_{}[deg]", name), a.theta_c);
    view.add(fmt::format("theta_n_{}[deg]", name), a.theta_n);
    view.add(fmt::format("theta_t_{}[deg]", name), a.theta_t);
    view.add(fmt::format("q/p_{}", name), ratio(stress.q, stress.p));
    view.add(fmt::format("theta_{}[deg]", name), pair.contacts > 0 ? stress.theta : nan);
    view.add(fmt::format("rothenburg_{}", name), a.rothenburg());
    view.add(fmt::format("rothenburg_full_{}", name), std::isnan(a.a_n) ? nan : a.stress_ratio());
  };
  for (std::size_t type = 0; type < pair_types; ++type)
    add(pair_type_names[type], view.sums().pair[type]);
  add("all", view.sums().between_grains());
}

}  // namespace

std::vector<Cell> derived(const MicroRow& row, const MicroScale& scale,
                          const ViewSettings& settings)
{
  View view{row, scale, settings, {}};
  add_composition(view);
  add_coordination(view);
  add_forces(view);
  add_pressures(view);
  add_friction(view);
  add_fabric(view);
  return std::move(view.cells);
}

}  // namespace grseg
