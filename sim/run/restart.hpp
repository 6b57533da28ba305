// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/checkpoint.hpp"
#include "sim/scene/scene.hpp"

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
/// The same where `given`, the command line, does not say otherwise. A given accuracy sets step,
/// tolerance, min-sweeps and max-sweeps anew.
Scene scene_of(const Checkpoint& checkpoint, const std::string& name,
               const boost::program_options::variables_map& given);

/// UsageError naming the key in which `now` asks for other grains or another cell than `then`,
/// which a restart cannot give.
void require_same_bed(const Scene& then, const Scene& now);

/// Whether the steps of `now` follow on those of `then` as if nothing had happened between them:
/// what differs is at most how long the run goes on and how it is stored.
bool moves_alike(const Scene& then, const Scene& now);

/// The simulation that `checkpoint` holds, made under the scene `then`, under the scene `now`, not
/// yet tilted. Where the step differs the time goes on: the clock counts in new steps, and the
/// impulses with which the solver begins become those of a new step. UsageError where the time is
/// no whole number of new steps.
Simulation go_on(const Checkpoint& checkpoint, const Scene& then, const Scene& now,
                 const Perturbation& perturbation);

}  // namespace grseg
