// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/run.hpp"

#include "analysis/segregation/times.hpp"

#include <array>
#include <limits>

namespace grseg {
namespace {

using Moment = SegregationSeries::Moment;

struct BedColumn {
  const char* name;
  double Moment::*place;
};
constexpr std::array bed_columns{
    BedColumn{"yL[m]", &Moment::large},   BedColumn{"yS[m]", &Moment::small},
    BedColumn{"height[m]", &Moment::bed}, BedColumn{"shear_rate[1/s]", &Moment::shear_rate},
    BedColumn{"strain", &Moment::strain}, BedColumn{"mixing", &Moment::mixing}};

Moment mean_of_last(const std::vector<Moment>& moments, std::size_t count)
{
  Moment mean;
  for (const auto& [name, place] : bed_columns) {
    for (std::size_t k = moments.size() - count; k < moments.size(); ++k)
      mean.*place += moments[k].*place;
    mean.*place /= static_cast<double>(count);
  }
  return mean;
}

}  // namespace

SegregationRun::SegregationRun(const Layers& layers, double small_diameter, double large_diameter)
    : layers_(layers),
      small_diameter_(small_diameter),
      large_diameter_(large_diameter),
      series_(layers)
{
}

void SegregationRun::add(const Grains& grains, const SegregationSeries& series,
                         const SegregationFlux& flux)
{
  series_.merge(series);
  const auto count = series.moments().size();
  bed_ = mean_of_last(series_.moments(), count);
  results_ = flux.results(grains, bed_.bed);
  for (std::size_t n = 0; n < results_.size(); ++n) {
    const auto& result = results_[n];
    const double phi = result.value.phi_large;
    points_.push_back({windows_.size(), layers_.bottom(n), layers_.top(n),
                       (result.area_small + result.area_large) / layers_.volume(n),
                       (1 - phi) * small_diameter_ + phi * large_diameter_, bed_.bed, result});
  }
  windows_.push_back(count);
}

std::vector<std::string> SegregationRun::columns()
{
  auto names = SegregationFlux::columns();
  for (const auto& [name, place] : bed_columns) names.emplace_back(name);
  return names;
}

std::vector<double> SegregationRun::row(std::size_t layer) const
{
  auto row = SegregationFlux::row(results_[layer]);
  row.insert(row.end(), bed_columns.size(), std::numeric_limits<double>::quiet_NaN());
  return row;
}

std::vector<double> SegregationRun::bed_row() const
{
  std::vector<double> row(SegregationFlux::columns().size(),
                          std::numeric_limits<double>::quiet_NaN());
  for (const auto& [name, place] : bed_columns) row.push_back(bed_.*place);
  return row;
}

SegregationSummary SegregationRun::summary(const RateFilter& filter) const
{
  auto summary = segregation_times(series_.moments(), windows_);
  summary.append(segregation_rates(filtered(points_, filter)));
  return summary;
}

}  // namespace grseg
