// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/segregation/flux.hpp"
#include "analysis/segregation/named_numbers.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Segregation time by several definitions, counted from the first frame, in seconds and in strain
/// (numbers named _strain):
///   y_L_start, y_L_end, tau  y_L = end - (end - start) exp(-t/tau), least squares over frames
///   t50, t90      time at which y_L has covered 50 % and 90 % of the way from start to end
///   mixing_start, mixing_most, mixing_end  mean mixing_index over the frames of the first window,
///                 of the best mixed window and of the last window
///   t_mixing      middle of the best mixed window; the interval extends from the first to the last
///                 window whose index does not differ from it significantly
/// `windows` lists the number of frames in each window.
NamedNumbers segregation_times(const std::vector<BedState>& states,
                               const std::vector<std::size_t>& windows);

/// One layer in one window.
struct RatePoint {
  std::size_t window;
  double bottom, top;  // heights of the layer, m
  double solid;        // solid fraction: area or volume of grains over V of the layer
  double diameter;     // mean nominal diameter phi_S d_S + phi_L d_L, m
  double bed;          // height of the bed, m
  SegregationResult layer;
};

/// The points in layers that pass `filter`; the times of `filter` are not used.
std::vector<RatePoint> filtered(std::vector<RatePoint> points, const RowFilter& filter,
                                LengthUnits units);

/// Segregation velocity, diffusivities and Peclet number of a whole run, over the layers and
/// windows given, by the law of Gray & Chugunov (2006), q_L = S phi_L phi_S - D d phi_L/dy:
///   D_S, D_L        mean diffusivities of the layers, weighted by the number of displacements
///   Dhat_S, Dhat_L  means of D/(|du/dy| d^2) with the same weights
///   S               from q_L + D d phi_L/dy = S phi_L phi_S by least squares weighted with mass,
///                   with LayerSegregation::D of each layer
///   Shat            as S, with both sides divided by |du/dy| d
///   D               mean of the layers' D with weights mass (phi_L phi_S)^2
///   Pe, lambda      S H/D and D/S
///   S_flux, D_flux  both from the law by least squares, without the displacements. Noise of the
///                   flux increases the gradient of its own window, which biases both: for equal
///                   grains S_flux is not 0 (docs/studies/segregation.md). closure.hpp has no bias
/// Intervals come from differences between successive windows (error_about_trend), so that slow
/// changes as the bed segregates are part of the mean and not of its error.
NamedNumbers segregation_rates(const std::vector<RatePoint>& points);

/// Rows of grseg-segregation, window by window, and the numbers of the whole run. Stores a few
/// numbers per frame and per layer and window.
template <int D>
class SegregationTable {
 public:
  /// Nominal diameters, m.
  SegregationTable(const Layers& layers, double small_diameter, double large_diameter);

  /// Adds the next window.
  void add(const Grains& grains, const SegregationSeries<D>& series,
           const SegregationFlux<D>& flux);

  /// Columns of grseg-segregation from area_S or volume_S on. row() and bed_row() return the values
  /// of the last window in these columns, for a layer and for the whole bed (means over frames).
  static std::vector<std::string> columns();
  std::size_t layers() const { return results_.size(); }
  std::vector<double> row(std::size_t layer) const;
  std::vector<double> bed_row() const;
  double bed() const { return bed_.bed; }  // height of the bed in the last window, m

  NamedNumbers summary(const RowFilter& filter) const;

 private:
  Layers layers_;
  double small_diameter_, large_diameter_;
  SegregationSeries<D> series_;
  std::vector<std::size_t> windows_;  // number of frames in each window
  std::vector<RatePoint> points_;
  std::vector<SegregationResult> results_;  // results of the last window, by layer
  BedState bed_;                            // mean state of the bed in the last window
};

}  // namespace grseg
