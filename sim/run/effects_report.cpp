// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/effects_report.hpp"

#include "sim/scene/geometry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace grseg {

std::string effects_left_out(const Scene& scene)
{
  std::vector<std::string> all;
  const auto add = [&](bool left_out, const char* what) {
    if (left_out) all.emplace_back(what);
  };
  // A contact that rebounds a step later does so from a velocity that was remembered.
  const bool remembers = law_parameters(scene).horizon > 0;
  add(scene.friction == 0, "friction (its coefficient is 0)");
  add(!scene.rotation, "rotation (off)");
  add(scene.restitution == 0 && !remembers, "restitution (its coefficient is 0)");
  add(!remembers, "memory of approaches (contacts act at once)");
  add(gravity_of(scene).norm() == 0, "gravity (none)");
  add(scene.lateral == Scene::Lateral::walls, "periodicity (the cell has ends)");
  add(!moves_boundaries(scene), "moving boundaries (all stand still)");
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace grseg
