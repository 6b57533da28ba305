// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/force_distribution.hpp"

#include "analysis/frames/contacts.hpp"

#include <fmt/format.h>

#include <limits>

namespace grseg {
namespace {

/// Calls use(layer, type, f_n) for every contact that bears a force. `by_layer` grows to the layers
/// of the frame.
template <int D, class Sums, class Use>
void for_each_loaded_contact(const Grains& grains, const Frame<D>& frame, const Layers& layers,
                             std::vector<Sums>& by_layer, const Use& use)
{
  const auto& list = frame.contacts;
  const std::size_t count = layers.count(grains, frame);
  by_layer.resize(std::max(by_layer.size(), count));
  for (std::size_t k = 0; k < list.size(); ++k)
    if (bears_force(list, k))
      use(layer_of_contact(layers, grains, frame, k, count),
          static_cast<std::size_t>(pair_type(grains, frame, k)), force_parts(list, k).f_n);
}

/// One bin of the histogram of f_n/<f_n>.
struct Bin {
  double lower = 0, upper = 0;
  std::array<double, pair_types> number{};   // contacts per frame
  std::array<double, pair_types> density{};  // share of contacts in the bin over its width
  std::array<double, pair_types> tail{};     // share of contacts at or above `lower`
};

std::vector<Cell> cells(const Bin& bin)
{
  std::vector<Cell> cells{{"x0", bin.lower}, {"x1", bin.upper}};
  const auto by_type = [&](const char* name, const std::array<double, pair_types>& values) {
    for (std::size_t type = 0; type < pair_types; ++type)
      cells.push_back({fmt::format("{}_{}", name, pair_type_names[type]), values[type]});
  };
  by_type("n", bin.number);
  by_type("P", bin.density);
  by_type("tail", bin.tail);
  return cells;
}

}  // namespace

template <int D>
void MeanNormalForce<D>::add(const Grains& grains, const Frame<D>& frame)
{
  for_each_loaded_contact(grains, frame, layers_, sums_,
                          [&](std::size_t layer, std::size_t type, double f_n) {
                            sums_[layer][type] += {1, f_n};
                          });
}

template <int D>
void MeanNormalForce<D>::merge(const MeanNormalForce& others)
{
  accumulate(sums_, others.sums_);
}

template <int D>
double MeanNormalForce<D>::of(std::size_t layer, PairType type) const
{
  const auto& sum = sums_[layer][static_cast<std::size_t>(type)];
  return ratio(sum.force, sum.contacts);
}

template <int D>
double MeanNormalForce<D>::of_layer(std::size_t layer) const
{
  Sum between_grains, with_base;
  for (const auto type : {PairType::SS, PairType::LS, PairType::LL})
    between_grains += sums_[layer][static_cast<std::size_t>(type)];
  for (const auto type : {PairType::Sb, PairType::Lb})
    with_base += sums_[layer][static_cast<std::size_t>(type)];
  const auto& used = between_grains.contacts > 0 ? between_grains : with_base;
  return ratio(used.force, used.contacts);
}

template <int D>
double ForceDistribution<D>::edge(std::size_t bin) const
{
  return bin == bins ? std::numeric_limits<double>::infinity() : static_cast<double>(bin) * width_;
}

template <int D>
std::size_t ForceDistribution<D>::bin_of(double x) const
{
  if (!(x > 0)) return 0;
  if (x >= edge(bins - 1)) return bins - 1;
  auto bin = static_cast<std::size_t>(x / width_);
  // Rounding may move the quotient across an edge.
  if (x < edge(bin)) --bin;
  if (x >= edge(bin + 1)) ++bin;
  return bin;
}

template <int D>
void ForceDistribution<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  for_each_loaded_contact(
      grains, frame, layers_, counts_, [&](std::size_t layer, std::size_t type, double f_n) {
        const double unit = unit_ == ForceUnit::type ? mean_.of(layer, static_cast<PairType>(type))
                                                     : mean_.of_layer(layer);
        counts_[layer][bin_of(f_n / std::max(unit, 0.0))][type] += 1;
      });
}

template <int D>
void ForceDistribution<D>::merge(const ForceDistribution& others)
{
  frames_ += others.frames_;
  accumulate(counts_, others.counts_);
}

template <int D>
std::vector<std::string> ForceDistribution<D>::columns()
{
  return columns_of(cells(Bin{}));
}

template <int D>
std::vector<std::vector<double>> ForceDistribution<D>::rows(const Counts& counts) const
{
  std::array<double, pair_types> total{}, below{};
  for (const auto& bin : counts) accumulate(total, bin);
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < bins; ++k) {
    Bin bin{.lower = edge(k), .upper = edge(k + 1)};
    for (std::size_t type = 0; type < pair_types; ++type) {
      bin.number[type] = counts[k][type] / static_cast<double>(frames_);
      bin.density[type] = counts[k][type] / total[type] / (bin.upper - bin.lower);
      bin.tail[type] = (total[type] - below[type]) / total[type];
    }
    accumulate(below, counts[k]);
    rows.push_back(values_of(cells(bin)));
  }
  return rows;
}

template <int D>
std::vector<std::vector<double>> ForceDistribution<D>::bed_rows() const
{
  Counts all{};
  for (const auto& counts : counts_) accumulate(all, counts);
  return rows(all);
}

template class MeanNormalForce<2>;
template class MeanNormalForce<3>;
template class ForceDistribution<2>;
template class ForceDistribution<3>;

}  // namespace grseg
