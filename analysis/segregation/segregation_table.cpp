// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/segregation_table.hpp"

#include "analysis/frames/sums.hpp"
#include "analysis/segregation/rates.hpp"

#include <array>

namespace grseg {
namespace {

using Moment = BedState;

struct BedColumn {
  const char* column;
  double Moment::*place;
};
constexpr std::array bed_columns{
    BedColumn{"yL[m]", &Moment::large},   BedColumn{"yS[m]", &Moment::small},
    BedColumn{"height[m]", &Moment::bed}, BedColumn{"shear_rate[1/s]", &Moment::shear_rate},
    BedColumn{"strain", &Moment::strain}, BedColumn{"mixing", &Moment::mixing}};

Moment mean_of_last(const std::vector<Moment>& moments, std::size_t count)
{
  Moment mean;
  for (const auto& [column, place] : bed_columns) {
    for (std::size_t k = moments.size() - count; k < moments.size(); ++k)
      mean.*place += moments[k].*place;
    mean.*place /= static_cast<double>(count);
  }
  return mean;
}

std::vector<Cell> cells(const Moment& bed)
{
  std::vector<Cell> cells;
  cells.reserve(bed_columns.size());
  for (const auto& [column, place] : bed_columns) cells.push_back({column, bed.*place});
  return cells;
}

/// NaN in every column.
std::vector<Cell> without_values(std::vector<Cell> cells)
{
  for (auto& cell : cells) cell.value = no_number;
  return cells;
}

std::vector<Cell> together(std::vector<Cell> first, const std::vector<Cell>& then)
{
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

}  // namespace

template <int D>
SegregationTable<D>::SegregationTable(const Layers& layers, double small_diameter,
                                      double large_diameter)
    : layers_(layers),
      small_diameter_(small_diameter),
      large_diameter_(large_diameter),
      series_(layers)
{
}

template <int D>
void SegregationTable<D>::add(const Grains& grains, const SegregationSeries<D>& series,
                              const SegregationFlux<D>& flux)
{
  series_.merge(series);
  const auto count = series.moments().size();
  bed_ = mean_of_last(series_.moments(), count);
  results_ = flux.results(grains, bed_.bed);
  for (std::size_t n = 0; n < results_.size(); ++n) {
    const auto& result = results_[n];
    const double phi = result.value.phi_large;
    points_.push_back({windows_.size(), layers_.bottom(n), layers_.top(n),
                       (result.content_small + result.content_large) / layers_.volume(n),
                       (1 - phi) * small_diameter_ + phi * large_diameter_, bed_.bed, result});
  }
  windows_.push_back(count);
}

template <int D>
std::vector<std::string> SegregationTable<D>::columns()
{
  return columns_of(together(SegregationResult{}.cells(D), cells(Moment{})));
}

template <int D>
std::vector<double> SegregationTable<D>::row(std::size_t layer) const
{
  return values_of(together(results_[layer].cells(D), without_values(cells(bed_))));
}

template <int D>
std::vector<double> SegregationTable<D>::bed_row() const
{
  return values_of(together(without_values(SegregationResult{}.cells(D)), cells(bed_)));
}

template <int D>
NamedNumbers SegregationTable<D>::summary(const RateFilter& filter) const
{
  auto summary = segregation_times(series_.moments(), windows_);
  summary.append(segregation_rates(filtered(points_, filter, {small_diameter_, large_diameter_})));
  return summary;
}

template class SegregationTable<2>;
template class SegregationTable<3>;

}  // namespace grseg
