// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/solver/solver.hpp"

#include <array>

namespace grseg {

/// What a value of the key `accuracy` stands for, where the keys below are not given.
struct Accuracy {
  const char* name;
  double step;                 // in sqrt(d_S/g)
  double tolerance;            // of the solver
  int min_sweeps, max_sweeps;  // per step
  Precision precision;         // of the sweeps, where no body moves freely
};

constexpr std::array<Accuracy, 3> accuracies{{
    {"draft", 0.01771, 1, 8, 100, Precision::mixed},
    {"standard", 0.01107, 0.5, 8, 500, Precision::mixed},
    {"reference", 0.00443, 0.1, 8, 5000, Precision::doubles},
}};

/// The keys that `accuracy` sets.
constexpr std::array<const char*, 5> keys_of_accuracy{"step", "tolerance", "min-sweeps",
                                                      "max-sweeps", "precision"};

}  // namespace grseg
