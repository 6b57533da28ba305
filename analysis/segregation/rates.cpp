// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/rates.hpp"

#include "analysis/frames/sums.hpp"
#include "analysis/statistics/correlated_windows.hpp"
#include "analysis/statistics/exponential_approach.hpp"
#include "analysis/statistics/least_squares.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace grseg {
namespace {

/// The exponential approach of y_L, fitted against time or against strain.
void add_approach(const std::vector<BedState>& states, bool against_time, NamedNumbers& summary)
{
  const auto x = numbers_of(states, against_time ? &BedState::time : &BedState::strain);
  const auto y = numbers_of(states, &BedState::large);
  auto fit = fit_approach(x, y);
  const double surface = numbers_of(states, &BedState::bed).maxCoeff();
  if (fit.trouble.empty() && !(fit.end.value > 0 && fit.end.value < surface)) {
    fit = {};
    fit.trouble = "would end outside the bed";
  }
  const std::string unit = against_time ? "[s]" : "_strain", kind = against_time ? "" : "_strain";
  add_all(summary.numbers, {{"y_L_start" + kind + "[m]", fit.start},
                            {"y_L_end" + kind + "[m]", fit.end},
                            {"tau" + unit, fit.scale}});
  for (const auto& [name, part] : {std::pair{"t50", 0.5}, {"t90", 0.9}}) {
    const auto when = time_to(part, fit, x, y);
    summary.numbers.emplace_back(fmt::format("{}{}", name, unit), when);
    if (fit.trouble.empty() && std::isnan(when.value))
      summary.remarks.push_back(
          fmt::format("{}{}: the run ends before y_L has covered {:g} % of the way to {:.4g} m",
                      name, unit, 100 * part, fit.end.value));
  }
  if (!fit.trouble.empty())
    summary.remarks.push_back(
        fmt::format("no exponential approach fits y_L over {}: it {}; try a longer run or another "
                    "--begin",
                    against_time ? "time" : "strain", fit.trouble));
}

/// Means over the frames of one window; `error` is the standard error of `mixing`.
struct WindowMean {
  double time, strain, mixing, error;
};

std::vector<WindowMean> window_means(const std::vector<BedState>& states,
                                     const std::vector<std::size_t>& windows)
{
  std::vector<WindowMean> means;
  auto first = states.begin();
  for (const auto count : windows) {
    const std::vector<BedState> own(first, first + static_cast<std::ptrdiff_t>(count));
    first += static_cast<std::ptrdiff_t>(count);
    const auto mixing = numbers_of(own, &BedState::mixing);
    const Eigen::VectorXd excess = mixing.array() - mixing.mean();
    const auto frames = static_cast<double>(mixing.size());
    const double error = standard_error(excess / frames, 1).error;
    // The error is NaN if all frames depend on each other; then they count as one value.
    means.push_back({numbers_of(own, &BedState::time).mean(),
                     numbers_of(own, &BedState::strain).mean(), mixing.mean(),
                     std::isnan(error) ? std::sqrt(excess.squaredNorm() / frames) : error});
  }
  return means;
}

Estimate about(const WindowMean& mean)
{
  return {mean.mixing, mean.mixing - 1.96 * mean.error, mean.mixing + 1.96 * mean.error};
}

void add_mixing(const std::vector<BedState>& states, const std::vector<std::size_t>& windows,
                NamedNumbers& summary)
{
  const auto means = window_means(states, windows);
  const auto most = std::ranges::max_element(
      means, [](const auto& a, const auto& b) { return a.mixing < b.mixing; });
  Estimate time, strain;
  if (most + 1 != means.end() && most != means.begin()) {
    const auto alike = [&](const WindowMean& mean) {
      return most->mixing - mean.mixing <= 1.96 * std::hypot(most->error, mean.error);
    };
    const auto first = std::ranges::find_if(means, alike);
    const auto last = std::find_if(means.rbegin(), means.rend(), alike);
    const auto from = [&](double x, double WindowMean::*place, double origin) {
      return Estimate{x - origin, (*first).*place - origin, (*last).*place - origin};
    };
    time = from(most->time, &WindowMean::time, states.front().time);
    strain = from(most->strain, &WindowMean::strain, states.front().strain);
  } else {
    summary.remarks.push_back(fmt::format(
        "t_mixing: the mixing index is largest in the {} window, so its time is unknown",
        means.size() == 1       ? "only"
        : most == means.begin() ? "first"
                                : "last"));
  }
  if (most->mixing > 1)
    summary.remarks.emplace_back(
        "mixing_most: above 1 the layers differ less than those of a random mixture; by how much has "
        "no meaning");
  add_all(summary.numbers, {{"mixing_start", about(means.front())},
                            {"mixing_most", about(*most)},
                            {"mixing_end", about(means.back())},
                            {"t_mixing[s]", time},
                            {"t_mixing_strain", strain}});
}

}  // namespace

NamedNumbers segregation_times(const std::vector<BedState>& states,
                               const std::vector<std::size_t>& windows)
{
  NamedNumbers summary;
  add_approach(states, true, summary);
  add_approach(states, false, summary);
  add_mixing(states, windows, summary);
  return summary;
}

namespace {

/// A term weight (y - x . coefficients)^2 of the sum that a regression minimises.
struct Equation {
  double weight;
  Eigen::VectorXd x;
  double y;
};

/// Weighted least squares over the points, with the influence of each window on the coefficients.
class Regression {
 public:
  template <class MakeEquation>
  Regression(const std::vector<RatePoint>& points, Eigen::Index unknowns, const MakeEquation& make)
      : value(Eigen::VectorXd::Constant(unknowns, no_number))
  {
    std::vector<std::pair<std::size_t, Equation>> equations;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    std::map<std::size_t, Eigen::Index> rows;  // row of `influence` for each window in use
    for (const auto& point : points) {
      const Equation e = make(point);
      if (!(e.weight > 0) || !e.x.allFinite() || !std::isfinite(e.y)) continue;
      matrix += e.weight * e.x * e.x.transpose();
      right += e.weight * e.x * e.y;
      rows.emplace(point.window, static_cast<Eigen::Index>(rows.size()));
      equations.emplace_back(point.window, e);
    }
    const LeastSquares normal(matrix);
    influence = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), unknowns);
    if (rows.empty() || normal.rank() < unknowns) return;
    value = normal.solve(right);
    for (const auto& [window, e] : equations)
      influence.row(rows[window]) += e.weight * (e.y - e.x.dot(value)) * normal.solve(e.x);
  }

  Estimate estimate(Eigen::Index unknown = 0) const
  {
    return error_about_trend(influence.col(unknown)).around(value[unknown]);
  }

  Eigen::VectorXd value;
  Eigen::MatrixXd influence;  // a row per window, a column per coefficient
};

/// The product phi_L phi_S.
double both(const RatePoint& point)
{
  const double phi = point.layer.value.phi_large;
  return phi * (1 - phi);
}

/// Mean of a quantity over the points, weighted by the number of displacements of a species.
Regression mean(const std::vector<RatePoint>& points, std::size_t species,
                double LayerSegregation::*place)
{
  return {points, 1, [&](const RatePoint& point) -> Equation {
            return {point.layer.displacements[species], Eigen::VectorXd{{1.0}},
                    point.layer.value.*place};
          }};
}

/// Part of the flux due to segregation, S phi_L phi_S = q_L + D d phi_L/dy, m/s.
double advected(const LayerSegregation& layer)
{
  return layer.q_large + layer.D * layer.gradient;
}

/// The quotient a/b of the first coefficients, times `factor`, with its interval.
Estimate quotient(const Regression& a, const Regression& b, double factor)
{
  const double value = factor * a.value[0] / b.value[0];
  if (a.influence.rows() != b.influence.rows()) return {value};
  const Eigen::VectorXd influence =
      value * (a.influence.col(0) / a.value[0] - b.influence.col(0) / b.value[0]);
  return error_about_trend(influence).around(value);
}

}  // namespace

std::vector<RatePoint> filtered(std::vector<RatePoint> points, const RowFilter& filter,
                                LengthUnits units)
{
  const RowFilter of_layers{.heights = filter.heights, .min_solid = filter.min_solid};
  const auto range = of_layers.range(
      units, listed(points, [](const RatePoint& point) {
        return LayerSolid{{.bottom = point.bottom, .top = point.top, .frames = 1}, point.solid};
      }));
  std::erase_if(points, [&](const RatePoint& point) {
    return !range.heights.holds(point.bottom, point.top) || !(point.solid >= range.least_solid);
  });
  return points;
}

NamedNumbers segregation_rates(const std::vector<RatePoint>& points)
{
  using Values = LayerSegregation;
  const Regression velocity(points, 1, [](const RatePoint& p) -> Equation {
    return {p.layer.mass, Eigen::VectorXd{{both(p)}}, advected(p.layer.value)};
  });
  const Regression scaled(points, 1, [](const RatePoint& p) -> Equation {
    const double unit = std::abs(p.layer.flow.du_dy) * p.diameter;
    return {p.layer.mass, Eigen::VectorXd{{both(p)}}, advected(p.layer.value) / unit};
  });
  // A point without a known gradient is used for neither S nor D.
  const Regression diffusivity(points, 1, [](const RatePoint& p) -> Equation {
    const double weight = std::isfinite(advected(p.layer.value)) ? p.layer.mass : 0;
    return {weight * both(p) * both(p), Eigen::VectorXd{{1.0}}, p.layer.value.D};
  });
  const Regression flux(points, 2, [](const RatePoint& p) -> Equation {
    return {p.layer.mass, Eigen::VectorXd{{both(p), -p.layer.value.gradient}},
            p.layer.value.q_large};
  });
  double bed = 0;
  for (const auto& point : points) bed += point.bed / static_cast<double>(points.size());

  NamedNumbers summary;
  summary.numbers = {{"D_S[m^2/s]", mean(points, 0, &Values::D_small).estimate()},
                     {"D_L[m^2/s]", mean(points, 1, &Values::D_large).estimate()},
                     {"Dhat_S", mean(points, 0, &Values::Dhat_small).estimate()},
                     {"Dhat_L", mean(points, 1, &Values::Dhat_large).estimate()},
                     {"S[m/s]", velocity.estimate()},
                     {"Shat", scaled.estimate()},
                     {"D[m^2/s]", diffusivity.estimate()},
                     {"Pe", quotient(velocity, diffusivity, bed)},
                     {"lambda[m]", quotient(diffusivity, velocity, 1)},
                     {"S_flux[m/s]", flux.estimate(0)},
                     {"D_flux[m^2/s]", flux.estimate(1)}};
  for (const auto& [name, estimate] : summary.numbers)
    if (!std::isfinite(estimate.low))
      summary.remarks.push_back(name + ": too few windows with both species for " +
                                (std::isfinite(estimate.value) ? "an interval" : "a value"));
  return summary;
}

namespace {

struct BedColumn {
  const char* column;
  double BedState::*place;
};
constexpr std::array bed_columns{
    BedColumn{"yL[m]", &BedState::large},   BedColumn{"yS[m]", &BedState::small},
    BedColumn{"height[m]", &BedState::bed}, BedColumn{"shear_rate[1/s]", &BedState::shear_rate},
    BedColumn{"strain", &BedState::strain}, BedColumn{"mixing", &BedState::mixing}};

BedState mean_of_last(const std::vector<BedState>& states, std::size_t count)
{
  BedState mean;
  for (const auto& [column, place] : bed_columns) {
    for (std::size_t k = states.size() - count; k < states.size(); ++k)
      mean.*place += states[k].*place;
    mean.*place /= static_cast<double>(count);
  }
  return mean;
}

std::vector<Cell> cells(const BedState& bed)
{
  return listed(bed_columns, [&](const BedColumn& own) {
    return Cell{own.column, bed.*own.place};
  });
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
  const auto count = series.states().size();
  bed_ = mean_of_last(series_.states(), count);
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
  auto names = columns_of(SegregationResult{}.cells(D));
  return add_all(names, columns_of(cells(BedState{})));
}

template <int D>
std::vector<double> SegregationTable<D>::row(std::size_t layer) const
{
  auto row = values_of(results_[layer].cells(D));
  row.resize(row.size() + bed_columns.size(), no_number);
  return row;
}

template <int D>
std::vector<double> SegregationTable<D>::bed_row() const
{
  std::vector<double> row(SegregationResult{}.cells(D).size(), no_number);
  return add_all(row, values_of(cells(bed_)));
}

template <int D>
NamedNumbers SegregationTable<D>::summary(const RowFilter& filter) const
{
  auto summary = segregation_times(series_.states(), windows_);
  const auto rates =
      segregation_rates(filtered(points_, filter, {small_diameter_, large_diameter_}));
  add_all(summary.numbers, rates.numbers);
  add_all(summary.remarks, rates.remarks);
  return summary;
}

template class SegregationTable<2>;
template class SegregationTable<3>;

}  // namespace grseg
