// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/end_of_flow.hpp"

#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"

#include <cmath>

namespace grseg {

template <int D>
MeanMotion motion_of(const Simulation<D>& simulation)
{
  const auto& grains = simulation.world().grains;
  double mass = 0, momentum = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.fixed[g]) continue;
    mass += grains.mass[g];
    momentum += grains.mass[g] * simulation.velocity(g).x();
  }
  return {simulation.time(), momentum / mass};
}

template <int D>
EndOfFlow end_of_flow(const Simulation<D>& simulation, const Scene& scene,
                      const MeanMotion& earlier)
{
  const double base = scene.geometry->boundaries(scene).top;
  const double height = bed_height(simulation, base);
  const double down = -simulation.world().gravity.y();
  const bool is_chute = scene.geometry == &bed_geometry && scene.shake_amplitude == 0;
  if (!is_chute || !(height > 0) || !(down > 0)) return {};
  const auto& grains = simulation.world().grains;
  double mass = 0, of_surface = 0, momentum_of_surface = 0, volume = 0, diameters = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.fixed[g]) continue;
    const double own = grains.mass[g], along = own * simulation.velocity(g).x();
    mass += own;
    volume += grain_volume<D>(grains.radius[g]);
    diameters += own * 2 * grains.radius[g];
    if (simulation.position(g).y() < base + height - 2 * scene.small_diameter) continue;
    of_surface += own;
    momentum_of_surface += along;
  }
  EndOfFlow end;
  const auto now = motion_of(simulation);
  end.mean_velocity = now.mean_velocity;
  end.slope = simulation.world().gravity.x() / down;
  end.stress_ratio = (simulation.world().gravity.x() -
                      (now.mean_velocity - earlier.mean_velocity) / (now.time - earlier.time)) /
                     down;
  end.surface_velocity = momentum_of_surface / of_surface;
  end.solid_fraction = volume / (base_area(scene) * height);
  end.inertial_number = 5 * std::abs(end.mean_velocity) * (diameters / mass) /
                        (2 * height * std::sqrt(end.solid_fraction * down * height));
  return end;
}

template MeanMotion motion_of(const Simulation<2>&);
template MeanMotion motion_of(const Simulation<3>&);
template EndOfFlow end_of_flow(const Simulation<2>&, const Scene&, const MeanMotion&);
template EndOfFlow end_of_flow(const Simulation<3>&, const Scene&, const MeanMotion&);

}  // namespace grseg
