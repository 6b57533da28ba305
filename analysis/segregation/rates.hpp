// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/flux.hpp"
#include "analysis/segregation/summary.hpp"

#include <limits>
#include <vector>

namespace grseg {

/// One layer in one window.
struct RatePoint {
  std::size_t window;
  double bottom, top;  // of the layer, m
  double solid;        // area of grains over V
  double diameter;     // mean by composition, m
  double bed;          // height, m
  SegregationFlux::Result layer;
};

/// Which layers take part.
struct RateFilter {
  double lowest = -std::numeric_limits<double>::infinity();  // m
  double highest = std::numeric_limits<double>::infinity();
  double min_solid = 0.5;  // least solid fraction over the median of all points
};
std::vector<RatePoint> filtered(std::vector<RatePoint> points, const RateFilter& filter);

/// Segregation velocity, diffusivities and Peclet number of a whole run, over the layers and
/// windows given:
///   D_S, D_L, Dhat_S, Dhat_L  means weighted by the number of displacements; Dhat = D/(|du/dy|
///   d^2) S, D   q_L + D d phi_L/dy = S phi_L phi_S by least squares weighted with mass, D by the
///          displacements in each layer; and the mean of that D with the weights mass (phi_L
///          phi_S)^2
///   Shat   the same with both sides over |du/dy| d
///   Pe = S H/D, lambda = D/S
///   S_flux, D_flux  both at once from q_L = S phi_L phi_S - D d phi_L/dy, displacements not asked
/// Intervals come from how windows differ from their neighbours in time (error_about_trend), so
/// that what changes as the bed segregates is part of the mean and not of its error.
SegregationSummary segregation_rates(const std::vector<RatePoint>& points);

}  // namespace grseg
