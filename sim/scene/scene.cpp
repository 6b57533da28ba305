// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/scene.hpp"

#include "sim/scene/geometry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace grseg {

std::int64_t Scene::steps_per_frame() const
{
  return std::llround(frame_interval / step);
}

std::int64_t Scene::steps_in_all() const
{
  return std::llround(duration / step);
}

Gravity<2> gravity_of(const Scene& scene)
{
  if (!scene.geometry->has_gravity) return {};
  const double slope = scene.slope * std::numbers::pi / 180;
  return {{scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope)},
          scene.slope_rate * std::numbers::pi / 180};
}

LawParameters law_parameters(const Scene& scene)
{
  return law_parameters(scene.law, scene.horizon, scene.step, scene.gravity, scene.small_diameter);
}

void require(bool valid, const std::string& key, const std::string& sentence)
{
  if (!valid) throw SceneError(key, sentence);
}

void require_within(double value, const std::string& key, double low, double high)
{
  require(
      value >= low && value <= high, key,
      fmt::format("{} is {:.6g}: it must lie between {:.6g} and {:.6g}", key, value, low, high));
}

}  // namespace grseg
