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
  double size = 0;  ///< largest displacement, in d_S; 0 for none
  std::uint64_t seed = 1;
};
constexpr double largest_perturbation = 0.01;  // in d_S; overlap would stay, see contact_law.hpp

/// Scene of a checkpoint, whose text Checkpoint::scene was read from the file `name`.
Scene scene_of(const std::string& text, const std::string& name);
/// Scene of a checkpoint with the changes of the command line, `given`. A given accuracy also sets
/// the keys of keys_of_accuracy.
Scene scene_of(const std::string& text, const std::string& name,
               const boost::program_options::variables_map& given);

/// Throws UsageError, which names the key, if `now` requires other grains or another cell than
/// `before`: a restart cannot change them.
void require_same_bed(const Scene& before, const Scene& now);

/// True if runs of both scenes have the same steps: they differ at most in duration and storage.
bool same_steps(const Scene& before, const Scene& now);

/// Simulation that continues `checkpoint`, of a run of the scene `before`, with the scene `now`.
/// Its flow is not started yet (start_flow()). If the duration of a step changes, the number of
/// steps done and the first guesses of impulses are converted. Throws UsageError if the time is not
/// a whole number of new steps.
template <int D>
Simulation<D> restored_simulation(const Checkpoint<D>& checkpoint, const Scene& before,
                                  const Scene& now, const Perturbation& perturbation);

}  // namespace grseg
