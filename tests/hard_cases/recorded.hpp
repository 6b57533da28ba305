// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "sim/run/recorder.hpp"

#include <unistd.h>

#include <filesystem>
#include <string>

namespace grseg::hard_cases {

/// Runs `steps` steps with a recorder, as grseg-sim does, and writes a frame every `every` steps.
/// Returns the message with which a run out of bounds is stopped, or nothing.
inline std::string words_of_a_run(Simulation<2> simulation, double small_diameter, int steps,
                                  int every = 1)
{
  const auto path = (std::filesystem::temp_directory_path() /
                     ("grseg_hard_case_" + std::to_string(getpid()) + ".h5"))
                        .string();
  std::string words;
  try {
    const auto& world = simulation.world();
    TrajectoryWriter writer(path, {world.grains, world.box, {}, Recorder::observables(2)});
    Recorder recorder(writer, small_diameter);
    Frame<2> frame;
    for (int k = 1; k <= steps; ++k) {
      const bool due = k % every == 0;
      recorder.add(due ? simulation.advance(frame) : simulation.advance());
      if (due) recorder.write(frame, simulation);
    }
  } catch (const RunError& error) {
    words = error.what();
  }
  std::filesystem::remove(path);
  return words;
}

}  // namespace grseg::hard_cases
