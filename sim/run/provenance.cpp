// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/provenance.hpp"

#include "formats/core/version.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/scene_text.hpp"
#include "sim/solver/sweep.hpp"

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

std::string program_of_run()
{
  return "grseg-sim " + version_with_hash();
}

Parameters provenance(const Scene& scene, const RunOptions& options)
{
  auto parameters = to_parameters(scene);
  parameters.texts["program"] = program_of_run();
  parameters.texts["instruction_set"] = instruction_set();
  parameters.texts["command_line"] = options.command_line;
  parameters.texts["history"] = options.command_line;
  parameters.texts["effects_left_out"] = effects_left_out(scene);
  return parameters;
}

Parameters provenance_of_restart(const Scene& scene, const RunOptions& options, double time,
                                 const std::string& history)
{
  auto parameters = provenance(scene, options);
  parameters.texts["history"] = history;
  parameters.numbers["restart_time"] = {time};
  if (options.perturbation.size > 0) {
    parameters.numbers["perturb"] = {options.perturbation.size};
    parameters.numbers["seed_perturbation"] = {static_cast<double>(options.perturbation.seed)};
  }
  return parameters;
}

}  // namespace grseg
