// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace grseg {

/// The standard normal distribution Phi(u), and its primitive, the integral of Phi from minus
/// infinity to u. The primitive equals u Phi(u) + phi(u), but is found without the cancellation of
/// this sum. Relative error of both at most 1e-15 for u >= -10; below, where Phi < 1e-23, at most
/// 1e-19 u^4.
///
/// Coarse graining by a Gaussian needs both at every edge of every layer. std::erfc and std::exp
/// took half its time. So for u >= -10 both functions are Taylor series about points 1/64 apart,
/// whose coefficients contain Hermite polynomials (Abramowitz & Stegun 1964, 26.2.31).
double normal_below(double u);
double normal_below_primitive(double u);

/// The coarse-graining function psi over the height y, a Gaussian: psi(u) = exp(-u^2/(2 w^2))/
/// (sqrt(2 pi) w). It is not cut off, but its integral beyond 8.5 w is less than round-off. The cell is periodic in x, and fields are
/// averaged over its length Lx, so that they depend on y alone:
///   density of a sum over grains   (1/Lx) sum_i a_i psi(y - y_i)
///   contact stress                 (1/Lx) sum_k force_k (x) branch_k A_k(y)
///   with the line integral         A(y) = int_0^1 psi(y - y_a - s (y_b - y_a)) ds
/// along a branch, or a grain's part of it, from height y_a to height y_b (Goldhirsch 2010,
/// Granular Matter 12:239; Weinhart, Thornton, Luding & Bokhove 2012, Granular Matter 14:289).
/// Since dA/dy = (psi(y - y_a) - psi(y - y_b))/(y_b - y_a), the divergence of this stress is the
/// density of the contact forces, exactly and at every y. Heights in m, psi in 1/m.
class Kernel {
 public:
  /// Throws UsageError unless the width w (m), the standard deviation, is positive.
  explicit Kernel(double width);

  double width() const { return width_; }
  /// Distance beyond which the integral of psi is less than round-off, m.
  double reach() const;

  /// psi(u), 1/m, and its integral from minus infinity to u, 0 to 1; u in m.
  double value(double u) const;
  double below(double u) const;

  /// The line integral A(y) above, 1/m, in closed form. It is accurate to round-off for branches of
  /// any length, also level ones, and in the tails of psi.
  double along(double y, double from, double to) const;
  /// Integral of A over all heights up to y, 0 to 1. Its integral above y is below_along(from + to
  /// - y, from, to), which loses no digits if it is small.
  double below_along(double y, double from, double to) const;

 private:
  double width_;
};

/// Calls book(layer, share) for each of `count` layers with the integral over the layer of
/// Kernel::along, the kernel spread from height `from` to height `to`. `from` = `to` gives the
/// kernel of a single grain. The shares add up to 1, because the first layer includes everything
/// below it and the last everything above it (as in layers.hpp). share/thickness is the mean of the
/// field over the layer. As the width tends to 0, the result tends to Layers::share_segment.
template <class Book>
void share_kernel(const Layers& layers, const Kernel& kernel, double from, double to,
                  std::size_t count, const Book& book)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double middle = from + (to - from) / 2;
  const double farthest = std::abs(to - from) / 2 + kernel.reach();
  const std::size_t first = std::min(layers.at(middle - farthest), count - 1);
  const std::size_t last = std::min(layers.at(middle + farthest), count - 1);
  // Tails are measured from the nearer end, so that small shares keep their digits.
  double bottom = -infinity, tail_at_bottom = 0;
  for (std::size_t n = first; n <= last; ++n) {
    const double top = n == last ? infinity : layers.top(n);
    const double tail_at_top =
        n == last ? 0 : kernel.below_along(middle - std::abs(top - middle), from, to);
    if (top <= middle)
      book(n, tail_at_top - tail_at_bottom);
    else if (bottom >= middle)
      book(n, tail_at_bottom - tail_at_top);
    else
      book(n, 1 - tail_at_bottom - tail_at_top);
    bottom = top;
    tail_at_bottom = tail_at_top;
  }
}

}  // namespace grseg
