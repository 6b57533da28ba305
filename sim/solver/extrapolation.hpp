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
/// sqrt(1 + 4 w_k^2))/2, so that f_k grows towards 1; where the changes that a sweep makes grow, w
/// starts again from 1 (Nesterov 1983; restart by O'Donoghue & Candes, Found. Comput. Math. 15,
/// 2015). It begins with `first_weight`, not with 1, because a step's first guess is nearly its
/// solution (docs/studies/accuracy.md). Velocities are linear in impulses, so both are extrapolated
/// alike; the state in between need not obey Signorini and Coulomb, as the next sweep projects it
/// back.
///
/// Real is double or float.
template <class Real>
class ExtrapolationOf {
 public:
  static constexpr double first_weight = 2;

  /// To be called before the first sweep,
  void begin(std::span<const RunsOf<Real>> strips, std::span<const MotionOf<Real>> motion,
             int threads);
  /// and after every sweep; `change` is the sum of the squared changes that it made.
  void extrapolate(std::span<const RunsOf<Real>> strips, std::span<MotionOf<Real>> motion,
                   double change, int threads);

  /// The factor after the next sweep, if its change is not looked at.
  double next_factor();
  /// Extrapolates the impulses and the bodies of a strip by such a factor.
  void extrapolate_strip(std::span<const RunsOf<Real>> strips, std::size_t strip,
                         std::span<MotionOf<Real>> motion, double factor);
  /// Lets extrapolate() go on after such sweeps: the change of the last that was extrapolated.
  void set_last_change(double change) { last_change_ = change; }

 private:
  void remember(std::span<const RunsOf<Real>> strips, std::span<const MotionOf<Real>> motion,
                int threads);

  struct alignas(64) Impulses {
    typename BlockOf<Real>::Lanes n, t;
  };
  std::vector<std::vector<Impulses>> impulses_;  // after the sweep before, strip by strip
  std::vector<MotionOf<Real>, boost::alignment::aligned_allocator<MotionOf<Real>, 64>> motion_;
  double weight_ = 1, last_change_ = 0;
};

}  // namespace grseg
