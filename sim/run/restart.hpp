// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/checkpoint.hpp"
#include "sim/scene/scene.hpp"

#include <boost/program_options.hpp>

#include <cstdint>
#include <string>

namespace grseg {

/// Random displacements that make copies of one state diverge.
struct Perturbation {
  double size = 0;  ///< in d_S, of the largest displacement; 0 for none
  std::uint64_t seed = 1;
};
constexpr double largest_perturbation = 0.01;  // overlap is not pushed out again

/// The scene of `checkpoint`, read from the file `name`.
Scene scene_of(const Checkpoint& checkpoint, const std::string& name);
/// Scene of a checkpoint, with the keys that `given`, the command line, changes. A given accuracy
/// also sets the keys that follow from it.
Scene scene_of(const Checkpoint& checkpoint, const std::string& name,
               const boost::program_options::variables_map& given);

/// UsageError naming the key in which `now` asks for other grains or another cell than the scene
/// `before`, which a restart cannot give.
void require_same_bed(const Scene& before, const Scene& now);

/// True where a run under `now` takes the same steps as under `before`: the scenes differ at most
/// in how long the run lasts and how it is stored.
bool same_steps(const Scene& before, const Scene& now);

/// Simulation from a `checkpoint` of a run under the scene `before`, to go on under the scene
/// `now`; its flow is not started yet (start_flow). Where the step differs, the clock counts in new
/// steps and the impulses with which the solver begins become impulses of a new step. UsageError
/// where the time is not a whole number of new steps.
Simulation restored_simulation(const Checkpoint& checkpoint, const Scene& before, const Scene& now,
                               const Perturbation& perturbation);

}  // namespace grseg
