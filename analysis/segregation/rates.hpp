// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "analysis/segregation/flux.hpp"
#include "analysis/segregation/named_numbers.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Segregation time by several definitions, counted from the first moment, in seconds and in strain
/// (numbers named _strain):
///   y_L_start, y_L_end, tau  y_L = end - (end - start) exp(-t/tau), least squares over frames
///   t50, t90      when y_L has covered 50 % and 90 % of the way from start to end of the fit
///   mixing_start, mixing_most, mixing_end  mixing_index in the first window, in the one that is
///                 mixed most and in the last, means over the window's frames
///   t_mixing      middle of the window that is mixed most; the interval reaches from the first to
///                 the last window whose index does not differ significantly
/// `windows` lists the number of moments in each window.
NamedNumbers segregation_times(const std::vector<BedState>& moments,
                               const std::vector<std::size_t>& windows);

/// One layer in one window.
struct RatePoint {
  std::size_t window;
  double bottom, top;  // of the layer, m
  double solid;        // area or volume of grains over V
  double diameter;     // phi_S d_S + phi_L d_L, nominal, m
  double bed;          // height of the bed, m
  SegregationResult layer;
};

/// The points in layers that take part, whatever their windows.
std::vector<RatePoint> filtered(std::vector<RatePoint> points, const RowFilter& filter,
                                LengthUnits units);

/// Segregation velocity, diffusivities and Peclet number of a whole run, over the layers and
/// windows given, by the law of Gray & Chugunov (2006), q_L = S phi_L phi_S - D d phi_L/dy:
///   D_S, D_L        means of the layers' diffusivities weighted by the number of displacements
///   Dhat_S, Dhat_L  the same of D/(|du/dy| d^2)
///   S               q_L + D d phi_L/dy = S phi_L phi_S by least squares weighted with mass, D from
///                   the displacements in each layer
///   Shat            the same with both sides over |du/dy| d
///   D               the mean of that D with weights mass (phi_L phi_S)^2
///   Pe, lambda      S H/D and D/S
///   S_flux, D_flux  both from the law by least squares, without the displacements. The noise of the
///                   flux makes the gradient of its own window larger, which biases them: of equal
///                   grains S_flux is not 0 (docs/studies/segregation.md); closure.hpp is free of it
/// Intervals come from how windows differ from their neighbours in time (error_about_trend), so
/// that what changes as the bed segregates is part of the mean and not of its error.
NamedNumbers segregation_rates(const std::vector<RatePoint>& points);

/// The windows of a run one after the other, and what follows from all of them. Keeps a few numbers
/// per frame and per layer and window.
template <int D>
class SegregationTable {
 public:
  /// Nominal diameters, m.
  SegregationTable(const Layers& layers, double small_diameter, double large_diameter);

  /// The next window.
  void add(const Grains& grains, const SegregationSeries<D>& series,
           const SegregationFlux<D>& flux);

  /// The columns of grseg-segregation from area_S or volume_S on, and the values of the last
  /// window: of a layer, and of the whole bed, which are means over the frames of the window.
  static std::vector<std::string> columns();
  std::size_t layers() const { return results_.size(); }
  std::vector<double> row(std::size_t layer) const;
  std::vector<double> bed_row() const;
  double bed() const { return bed_.bed; }  // height, m

  NamedNumbers summary(const RowFilter& filter) const;

 private:
  Layers layers_;
  double small_diameter_, large_diameter_;
  SegregationSeries<D> series_;
  std::vector<std::size_t> windows_;  // number of moments in each
  std::vector<RatePoint> points_;
  std::vector<SegregationResult> results_;  // of the last window
  BedState bed_;                            // of the last window
};

}  // namespace grseg
