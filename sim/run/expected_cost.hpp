// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"

#include <optional>
#include <string>

namespace grseg {

/// Cost of a run before it begins, correct within a factor of about 1.5.
struct ExpectedCost {
  double grains = 0;              // in the bed and its boundary
  double memory = 0;              // bytes
  double file = 0;                // bytes of the trajectory, before compression
  std::optional<double> seconds;  // where it was measured
  bool of_rest = false;           // from a restart on
};

enum class Measure { where_long, always };

/// Cost of a run of `scene` from `begin`, s, to its end; with its deposition where `begin` is 0.
/// Time is measured, on a small bed of the same grains for less than a second; by default only
/// where it may be a minute or more.
ExpectedCost expected_cost(const Scene& scene, double begin = 0,
                           Measure measure = Measure::where_long);

/// "3,357 grains, 43 MB of memory, a file of 1.5 GB, about 3 minutes".
std::string to_text(const ExpectedCost& cost);

/// A table of one row: grains, memory[bytes], file[bytes], time[s].
std::string to_table(const ExpectedCost& cost);

/// UsageError where memory or the disk of `output` have less room than `cost` needs.
void require_room(const ExpectedCost& cost, const std::string& output);

}  // namespace grseg
