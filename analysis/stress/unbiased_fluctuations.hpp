// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layers.hpp"
#include "analysis/frames/mean_velocity.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// Products of fluctuations in one frame (dv (x) dv of Staron & Phillips 2015, eq. 5) without the
/// bias of a mean that holds the grain itself.
///
/// V, the mean of n grains of masses m (M in all), moves with each of them, so that
/// (v_i - V) (x) (v_i - V) falls short of the variance of v_i: of equal grains by the factor 1 - 1/n,
/// else by 2 m_i/M less what the others make V fluctuate. Here a grain i of a cell (a layer or a cell
/// of a map) has instead
///
///   (v_i - v_j) (x) (v_i - v_k), the mean over all j != k, weights m_j m_k, of the cell's others.
///
/// Where velocities in a cell have a common mean and are independent, its expectation is the
/// variance of v_i, whatever the masses and variances of i and of the others: j and k differ, so
/// that no fluctuation but that of i is multiplied by itself. (With the mean of all others for both,
/// the expectation has their variance in it; (v_i - V) (x) (v_i - V without i) has the variance
/// of v_i where m var(v) is the same for all grains, and else an error of the order m_i/M.)
///
/// With e = v - V and, over the cell, Q = sum m^2, R = sum m^2 e, P = sum m^2 e (x) e it equals
///
///   [(M^2 - Q) e_i (x) e_i + e_i (x) R + R (x) e_i - P] / [(M - m_i)^2 - Q + m_i^2].
///
/// The sum over equal grains is n/(n - 1) times that about V. A grain needs two others; in a cell of
/// one or two there is no product. What all grains of the cell do together is left out; a
/// difference of mean velocity between them, such as shear, and correlations are not.
template <int D>
class UnbiasedFluctuations {
 public:
  using Product = MotionProduct<D>;

  UnbiasedFluctuations(const Layers& layers, const Grains& grains, const Frame<D>& frame);

  /// Whether the cell holds three mobile grains or more.
  bool has(std::size_t layer) const { return cells_[layer].grains > 2; }
  /// Of a grain of the cell that moves so.
  Product of(std::size_t layer, double mass, const Motion<D>& motion) const;

 private:
  struct CellSums {
    std::size_t grains = 0;
    double mass = 0, squares = 0;                                      // M, Q
    Motion<D> mean = Motion<D>::Zero(), weighted = Motion<D>::Zero();  // V, R
    Product product;                                                   // P
  };
  std::vector<CellSums> cells_;
};

}  // namespace grseg
