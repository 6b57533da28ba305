// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"

#include <optional>
#include <string>

namespace grseg {

/// Cost of a run, estimated before it begins: memory within a factor of about 1.5, time within 2, or 3
/// at large friction or restitution (docs/studies/hard-cases.md).
struct ExpectedCost {
  double grains = 0;              // number of grains, including boundary grains
  double memory = 0;              // bytes of memory
  double file = 0;                // bytes of the trajectory, before compression; an upper bound
  double disk = 0;                // bytes that must be free at the start, with copies at the end
  std::optional<double> seconds;  // s, wall-clock time, if it was estimated
  bool of_rest = false;           // true if only the rest of a run, after a restart, is included
};

enum class Measure { where_long, always };

/// Cost of a run of `scene` from the time `begin`, s, to its end, including the deposition if
/// `begin` is 0. The time is estimated from a small bed of the same grains, which is simulated for a
/// few seconds at most; by default only if the run may last a minute or more.
ExpectedCost expected_cost(const Scene& scene, double begin = 0,
                           Measure measure = Measure::where_long);

/// Text such as "3357 grains, 43 MB of memory, a file of 1.5 GB, about 3 minutes".
std::string to_text(const ExpectedCost& cost);

/// Table of one row: grains, memory[bytes], file[bytes], time[s].
std::string to_table(const ExpectedCost& cost);

/// Throws UsageError if free memory, or free space on the disk of `output`, is less than `cost`, RunError
/// if a quota or a limit on file sizes is in the way.
void require_room(const ExpectedCost& cost, const std::string& output);

}  // namespace grseg
