// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/base_row.hpp"

#include "sim/scene/random_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace grseg {
namespace {

// Widest accepted gap, in diameters of the smallest grain. A grain's weight wedges it into a gap:
// on two beads of twice its size, it pushes on each with twice its weight if the gap is 0.9, and
// with six times its weight if the gap is 0.99.
constexpr double widest_gap_that_holds = 0.9;
constexpr double fewest_beads = 4;       // so that no bead touches its own periodic image
constexpr double error_of_count = 1e-9;  // round-off of a number of beads
// Bit in which the seed of the base differs from the seed of the grains.
constexpr std::uint64_t own_stream = 1U << 31;

double mean_spacing(const Scene& scene, double at_least)
{
  return scene.length / static_cast<double>(beads_at_spacing(scene, at_least));
}

/// Diameter of the smallest mobile grain that the keys allow, m.
double smallest_grain(const Scene& scene)
{
  const bool only_large = !scene.large_grains && scene.phi_large == 1;
  return (only_large ? scene.large_diameter : scene.small_diameter) * (1 - scene.spread / 2);
}

/// `count` values from -1/2 to 1/2, evenly spaced, in random order.
std::vector<double> evenly_spaced(std::size_t count, RandomNumbers& random)
{
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k)
    values[k] = static_cast<double>(k) / static_cast<double>(count - 1) - 0.5;
  random.shuffle(values);
  return values;
}

/// First key whose value differs from the regular row (base_row.hpp); null if there is none.
const char* key_of_other_base(const Scene& scene)
{
  if (scene.base_diameter != scene.large_diameter) return "base-diameter";
  if (scene.base_diameter_spread != 0) return "base-diameter-spread";
  if (scene.base_height_spread != 0) return "base-height-spread";
  if (scene.base_spacing != mean_spacing(scene, scene.large_diameter)) return "base-spacing";
  if (scene.base_spacing_spread != 0) return "base-spacing-spread";
  return nullptr;
}

void check_room(const Scene& scene)
{
  const double widest = scene.base_diameter * (1 + scene.base_diameter_spread / 2);
  for (const auto& [key, what, value] :
       {std::tuple{"base-diameter", "wide", widest}, {"base-spacing", "apart", scene.base_spacing}})
    require(value <= scene.length / fewest_beads, key,
            fmt::format("{}: base grains would be {:.4g} m {}, more than a quarter of the length "
                        "of {:.4g} m; choose a smaller {} or a longer cell",
                        key, value, what, scene.length, key));
}

void check_that_it_holds(const Scene& scene, const char* key)
{
  const double gap = widest_gap(scene), most = widest_gap_that_holds * smallest_grain(scene);
  require(gap <= most, key,
          fmt::format(
              "{}: grains would fall through the base: its gaps may be as wide as {:.4g} m, and "
              "the smallest grains need gaps of at most {:.4g} m; choose a smaller base-spacing "
              "or smaller spreads",
              key, gap, most));
}

/// Diameter d, in d_L, of the widest hole of a base. Its lines of touching beads are 0.866 d_L
/// apart. A sphere of this diameter touches three beads, or two beads and the wall at the ends of x,
/// when its centre is in the plane of the beads' centres. Walls along z leave no hole (add_bead).
/// Lowered beads are further apart, at most by the factor `apart`.
double widest_hole_of_lines(const Scene& scene)
{
  const double apart = std::hypot(1, scene.base_height_spread / scene.large_diameter);
  const bool ends = scene.lateral == Scene::Lateral::walls && scene.geometry != &drum_geometry;
  // A wall and beads at (0.433, -0.5) and (0.433, 0.5): (0.433 - d/2)^2 + 0.25 = (1 + d)^2/4.
  return (ends ? 1.201 : 2 / std::sqrt(3)) * apart - 1;
}

/// True if the geometry allows a flat base.
bool may_be_flat(const Scene& scene)
{
  const bool kind = scene.geometry == &bed_geometry || scene.geometry == &column_geometry;
  return kind && scene.shake_amplitude == 0;
}

}  // namespace

long beads_at_spacing(const Scene& scene, double spacing)
{
  return std::lround(std::floor(scene.length / spacing + error_of_count));
}

double widest_gap(const Scene& scene)
{
  const double spacing = scene.base_spacing * (1 + scene.base_spacing_spread / 2);
  const double diameter = scene.base_diameter * (1 - scene.base_diameter_spread / 2);
  const double between = std::hypot(spacing, scene.base_height_spread) - diameter;
  if (scene.lateral == Scene::Lateral::periodic) return between;
  const double to_wall = scene.base_spacing * (1 + scene.base_spacing_spread) / 2 - diameter / 2;
  return std::max(between, to_wall);
}

void resolve_base_row(Scene& scene, const KeyGiven& given)
{
  if (!given("base-spacing")) scene.base_spacing = scene.base_diameter;
  const bool free_to_choose = scene.geometry->shapes_base && scene.base == Scene::Base::grains;
  if (free_to_choose) check_room(scene);
  scene.base_spacing = mean_spacing(scene, scene.base_spacing);
  if (const char* key = key_of_other_base(scene)) check_that_it_holds(scene, key);
}

void check_base_of_spheres(const Scene& scene)
{
  if (scene.base == Scene::Base::wall) return;
  const double hole = widest_hole_of_lines(scene) * scene.large_diameter;
  const double most = widest_gap_that_holds * smallest_grain(scene);
  const bool lowered = scene.base_height_spread > 0;
  require(hole <= most, lowered ? "base-height-spread" : "size-ratio",
          fmt::format("size-ratio is {:g}: grains would fall through the boundary of large grains, "
                      "whose holes are {:.4g} m wide; the smallest grains need holes of at most "
                      "{:.4g} m; choose a smaller {}{}",
                      scene.size_ratio, hole, most,
                      lowered ? "base-height-spread, size-ratio or spread" : "size-ratio or spread",
                      may_be_flat(scene) ? ", or base = wall" : ""));
}

void lower_spheres(Boundaries& base, const Scene& scene)
{
  if (scene.base_height_spread == 0) return;
  RandomNumbers random(scene.seed ^ own_stream);
  const auto height = evenly_spaced(base.position.size(), random);
  for (std::size_t k = 0; k < height.size(); ++k)
    base.position[k].y() -= scene.base_height_spread * (0.5 - height[k]);
}

void add_base_row(Boundaries& to, const Scene& scene)
{
  to.top = scene.origin == Scene::Origin::top ? 0 : scene.base_diameter / 2;
  const auto count = static_cast<std::size_t>(std::lround(scene.length / scene.base_spacing));
  RandomNumbers random(scene.seed ^ own_stream);
  const auto spacing = evenly_spaced(count, random), diameter = evenly_spaced(count, random),
             height = evenly_spaced(count, random);
  double displaced = 0;  // deviation of x from even spacing, in mean spacings
  for (std::size_t k = 0; k < count; ++k) {
    const double radius = scene.base_diameter / 2 * (1 + scene.base_diameter_spread * diameter[k]);
    const double lowered = scene.base_height_spread * (0.5 - height[k]);
    const double x = (static_cast<double>(k) + 0.5 + displaced) * scene.base_spacing;
    to.position.emplace_back(x, to.top - lowered - radius, 0);
    to.radius.push_back(radius);
    displaced += scene.base_spacing_spread * spacing[k];
  }
}

}  // namespace grseg
