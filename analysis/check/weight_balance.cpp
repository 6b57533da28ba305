// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/weight_balance.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// By layer: sum over all mobile grains of of(grain) times l (WeightWindow).
template <int D, class What, class Of>
std::vector<What> moments_above(const Grains& grains, const Frame<D>& frame, const Layers& layers,
                                const What& zero, const Of& of)
{
  const std::size_t count = layers.count(grains, frame);
  std::vector<What> whole(count, zero), moment(count, zero);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const double y = frame.position[g].y();
    const std::size_t layer = layers.at(y);
    whole[layer] += of(g);
    moment[layer] += of(g) * (y - layers.bottom(layer));
  }
  What above = zero;
  for (std::size_t n = count; n-- > 0;) {
    moment[n] += layers.thickness() * above;
    above += whole[n];
  }
  return moment;
}

template <int D>
Vector<D> mean_of(const std::vector<Vector<D>>& values)
{
  Vector<D> sum = Vector<D>::Zero();
  for (const auto& value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Stress of one layer in each window, and stress that the momentum balance requires; components
/// (xy, yy, zy), N/m or Pa.
template <int D>
struct Series {
  std::vector<Vector<D>> carried, required;
};

/// Standard error of a mean from the deviations of its `count` terms (whose sum is 0).
template <class Deviation>
double standard_error(std::size_t count, const Deviation& deviation)
{
  double squares = 0;
  for (std::size_t k = 0; k < count; ++k) squares += deviation(k) * deviation(k);
  const auto n = static_cast<double>(count);
  return std::sqrt(squares / (n * (n - 1)));
}

template <int D>
Series<D> series_of(const std::vector<WeightWindow<D>>& windows, std::size_t layer)
{
  Series<D> series;
  for (std::size_t k = 0; k + 1 < windows.size(); ++k) {
    const auto &window = windows[k], &next = windows[k + 1];
    const Vector<D> rate =
        (next.momentum[layer] - window.momentum[layer]) / (next.time - window.time);
    series.carried.push_back(window.stress[layer]);
    series.required.push_back(window.weight[layer] + rate);
  }
  return series;
}

/// Stress ratio of a layer along axis 0 (x) or 2 (z).
template <int D>
LayerBalance::StressRatio ratio_of(const Series<D>& series, int axis)
{
  const Vector<D> carried = mean_of<D>(series.carried), required = mean_of<D>(series.required);
  LayerBalance::StressRatio result;
  result.ratio = -carried[axis] / carried.y();
  result.slope = -required[axis] / required.y();
  // Contribution of one window to the deviation of the quotient -whole[axis]/whole.y().
  const auto change = [&](const Vector<D>& part, double ratio, const Vector<D>& whole) {
    return (-part[axis] - ratio * part.y()) / whole.y();
  };
  result.error = standard_error(series.carried.size(), [&](std::size_t k) {
    return change(series.carried[k], result.ratio, carried) -
           change(series.required[k], result.slope, required);
  });
  return result;
}

template <int D>
LayerBalance balance_of(const Series<D>& series)
{
  const Vector<D> carried = mean_of<D>(series.carried), required = mean_of<D>(series.required);
  LayerBalance balance;
  balance.carried = carried.y() / required.y();
  balance.carried_error = standard_error(series.carried.size(), [&](std::size_t k) {
    return (series.carried[k].y() - balance.carried * series.required[k].y()) / required.y();
  });
  balance.along = ratio_of(series, 0);
  if (D == 3) balance.across = ratio_of(series, D - 1);
  return balance;
}

}  // namespace

template <int D>
WeightSums<D>::WeightSums(const Layers& layers, const Vector<D>& gravity, double bin,
                          std::size_t species)
    : layers_(layers),
      gravity_(gravity),
      species_(species),
      mean_(layers, bin, species),
      contact_(layers, Assignment::branch, {}, {}, species)
{
}

template <int D>
void WeightSums<D>::add_to_mean(const Grains& grains, const Frame<D>& frame)
{
  mean_.add(grains, frame);
  if (!momentum_.empty()) return;
  time_ = frame.time;
  const auto momentum = [&](std::size_t g) -> Vector<D> {
    return grains.mass[g] * frame.velocity[g];
  };
  momentum_ = moments_above(grains, frame, layers_, Vector<D>(Vector<D>::Zero()), momentum);
}

template <int D>
void WeightSums<D>::add(const Grains& grains, const Frame<D>& frame)
{
  if (!kinetic_) {
    mean_.finish();
    kinetic_.emplace(layers_, MeanFlow::profile, mean_, species_);
  }
  kinetic_->add(grains, frame);
  contact_.add(grains, frame);
  ++frames_;
  const auto mass =
      moments_above(grains, frame, layers_, 0.0, [&](std::size_t g) { return grains.mass[g]; });
  mass_above_.resize(std::max(mass_above_.size(), mass.size()));
  for (std::size_t n = 0; n < mass.size(); ++n) mass_above_[n] += mass[n];
}

/// Contact stress plus kinetic stress of all species in a layer, times the layer's volume, N m.
template <int D>
Tensor<D> WeightSums<D>::whole_stress(std::size_t layer) const
{
  const auto sums = contact_.mean(layer).sums;
  Tensor<D> all = Tensor<D>::Zero();
  for (std::size_t s = 0; s < species_; ++s) all += sums.of(OwnSum::inside, s);
  for (std::size_t pair = 0; pair < number_of_pairs(species_); ++pair)
    all += sums.of(PairSum::whole, pair);
  for (std::size_t s = 0; s < species_; ++s) all += sums.of(OwnSum::whole_base, s);
  for (std::size_t s = 0; s < species_; ++s)
    all += kinetic_->mean(layer, static_cast<Species>(s)).about_mean.kinetic;
  return all;
}

template <int D>
WeightWindow<D> WeightSums<D>::window() const
{
  WeightWindow<D> window;
  window.time = time_;
  const std::size_t count = mass_above_.size();
  for (std::size_t n = 0; n < count; ++n) {
    const double volume = layers_.volume(n);
    window.stress.emplace_back(whole_stress(n).col(1) / volume);
    window.weight.emplace_back(-mass_above_[n] / static_cast<double>(frames_) / volume * gravity_);
    window.momentum.emplace_back(Vector<D>::Zero());
    if (n < momentum_.size()) window.momentum.back() = momentum_[n] / volume;
  }
  return window;
}

template <int D>
std::vector<LayerBalance> balance_layers(const std::vector<WeightWindow<D>>& windows,
                                         const Layers& layers, double least_load)
{
  std::vector<LayerBalance> balances;
  if (windows.size() < 3) return balances;
  std::size_t count = windows.front().stress.size();
  for (const auto& window : windows) count = std::min(count, window.stress.size());
  if (count == 0) return balances;
  const auto load = [](const Series<D>& series) { return mean_of<D>(series.required).y(); };
  const double least = least_load * load(series_of(windows, 0));
  for (std::size_t n = 1; n < count; ++n) {
    const auto series = series_of(windows, n);
    if (!(load(series) > 0) || load(series) < least) continue;
    auto balance = balance_of(series);
    balance.y0 = layers.bottom(n);
    balance.y1 = layers.top(n);
    balances.push_back(balance);
  }
  return balances;
}

template class WeightSums<2>;
template class WeightSums<3>;
template std::vector<LayerBalance> balance_layers(const std::vector<WeightWindow<2>>&,
                                                  const Layers&, double);
template std::vector<LayerBalance> balance_layers(const std::vector<WeightWindow<3>>&,
                                                  const Layers&, double);

}  // namespace grseg
