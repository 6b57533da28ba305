// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation/flux.hpp"
#include "analysis/segregation/named_numbers.hpp"
#include "analysis/segregation/rates.hpp"
#include "analysis/segregation/series.hpp"

#include <string>
#include <vector>

namespace grseg {

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

  /// The columns of grseg-segregation from area_S or volume_S on, and the values of the last window: of
  /// a layer, and of the whole bed, which are means over the frames of the window.
  static std::vector<std::string> columns();
  std::size_t layers() const { return results_.size(); }
  std::vector<double> row(std::size_t layer) const;
  std::vector<double> bed_row() const;
  double bed() const { return bed_.bed; }  // height, m

  NamedNumbers summary(const RateFilter& filter) const;

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
