// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/provenance.hpp"

#include "formats/core/version.hpp"
#include "sim/run/effects_report.hpp"
#include "sim/scene/keys/scene_text.hpp"
#include "sim/solver/sweep.hpp"

namespace grseg {

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
