// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace grseg {

/// Nesterov's extrapolation of Gauss-Seidel sweeps: each sweep starts from where the last one came
/// to, moved on along the way since the one before, by a factor that grows from sweep to sweep
/// until changes grow, too, and then begins anew (Nesterov 1983; restart by O'Donoghue & Candes,
/// Found. Comput. Math. 15, 2015). Velocities are linear in impulses, so both are moved on alike;
/// what the next sweep projects back need not obey Signorini and Coulomb in between.
class Extrapolation {
 public:
  /// Before the first sweep.
  void begin();
  /// After a sweep whose squared changes add up to `change`.
  void go_on(std::span<const BlockRuns> strips, std::span<Motion> motion, double change,
             int threads);

 private:
  void remember(std::span<const BlockRuns> strips, std::span<const Motion> motion, int threads);

  struct alignas(64) Impulses {
    ContactBlock::Lanes n, t;
  };
  std::vector<std::vector<Impulses>> impulses_;  // after the sweep before, strip by strip
  std::vector<Motion> motion_;
  double weight_ = 1, last_change_ = 0;
};

}  // namespace grseg
