// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <boost/align/aligned_allocator.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace grseg {

/// Nesterov's extrapolation of Gauss-Seidel sweeps. With x_k the state after sweep k, the next
/// sweep starts from x_k + f_k (x_k - x_(k-1)), where f_k = (w_k - 1)/w_(k+1) and w_(k+1) = (1 +
/// sqrt(1 + 4 w_k^2))/2, so that f_k grows towards 1. If a sweep changes more than the one before
/// it, w is reset to 1 (Nesterov 1983; restart by O'Donoghue & Candes, Found. Comput. Math. 15,
/// 2015). The first w is `first_weight`, not 1, because the first guess of a step is nearly its
/// solution (docs/studies/accuracy.md). Velocities are linear in impulses, so both are extrapolated
/// by the same factor. The extrapolated state need not obey Signorini and Coulomb, because the next
/// sweep projects it back. Real is double or float.
template <int D, class Real>
class ExtrapolationOf {
 public:
  static constexpr double first_weight = 2;

  /// To be called before the first sweep.
  void begin(std::span<const RunsOf<D, Real>> strips, std::span<const MotionOf<D, Real>> motion,
             int threads);
  /// To be called after every sweep; `change` is the sum of the squared changes of that sweep.
  void extrapolate(std::span<const RunsOf<D, Real>> strips, std::span<MotionOf<D, Real>> motion,
                   double change, int threads);

  /// Factor f_k after the next sweep, without a restart. Updates w.
  double next_factor();
  /// Extrapolates the impulses and velocities of a strip by `factor` of next_factor().
  void extrapolate_strip(std::span<const RunsOf<D, Real>> strips, std::size_t strip,
                         std::span<MotionOf<D, Real>> motion, double factor);
  /// To be called between extrapolate_strip() and extrapolate(), with the sum of the squared
  /// changes of the last sweep that was extrapolated.
  void set_last_change(double change) { last_change_ = change; }

 private:
  void remember(std::span<const RunsOf<D, Real>> strips, std::span<const MotionOf<D, Real>> motion,
                int threads);

  struct alignas(64) Impulses {
    LanesOf<Real> n;
    Turning<D, LanesOf<Real>> t;
  };
  std::vector<std::vector<Impulses>> impulses_;  // per strip, after the previous sweep
  std::vector<MotionOf<D, Real>, boost::alignment::aligned_allocator<MotionOf<D, Real>, 64>>
      motion_;
  double weight_ = 1, last_change_ = 0;  // w_k; change after the previous sweep
};

}  // namespace grseg
