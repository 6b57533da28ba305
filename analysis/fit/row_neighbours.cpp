// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/row_neighbours.hpp"

#include "analysis/frames/coarse_graining.hpp"
#include "formats/cli/provenance.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace grseg {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Variance of the kernel of a table over the squared thickness of its layers; 0 without a kernel.
double variance_of_kernel(const Table& table)
{
  constexpr Choice<double> kernels[] = {// variance over width^2; two are of version 1.0
                                        {"gauss", 1},
                                        {"lucy", 2.0 / 21},
                                        {"heaviside", 1.0 / 3}};
  const auto kernel =
      std::ranges::find(kernels, header_or(table, "assign", ""), &Choice<double>::word);
  if (kernel == std::end(kernels)) return 0;
  const double width = table.header_positive("width") / table.header_positive("layer");
  return kernel->value * width * width;
}

/// The period along an axis of a map, m.
std::optional<double> period_of(const Table& table, char axis)
{
  if (header_or(table, "periodic", "").find(axis) == std::string::npos) return {};
  return table.header_positive(axis == 'x' ? "length" : "length_z");
}

}  // namespace

RowNeighbours::Place RowNeighbours::Direction::place_of(const LayerKey& key) const
{
  return {key.begin, key.end, key.*along, key.*low};
}

std::vector<RowNeighbours::Direction> RowNeighbours::directions_of(const Table& table)
{
  const auto plane = plane_of(table);
  Direction first{&LayerKey::left, &LayerKey::right, &LayerKey::bottom};
  Direction second{&LayerKey::bottom, &LayerKey::top, &LayerKey::left};
  if (!plane) {
    second.radial = has_annuli(table);
    return {second};
  }
  const std::string axes = word_of(*plane, map_planes);
  first.radial = plane == MapPlane::rz;
  first.period = period_of(table, axes[0]);
  second.period = period_of(table, axes[1]);
  return {first, second};
}

RowNeighbours::RowNeighbours(const Table& table, std::vector<LayerKey> keys)
    : keys_(std::move(keys)),
      of_kernel_(variance_of_kernel(table)),
      directions_(directions_of(table))
{
  for (auto& direction : directions_)
    for (std::size_t k = 0; k < keys_.size(); ++k) direction.rows[direction.place_of(keys_[k])] = k;
}

/// True if the upper row begins where the lower one ends, also across the period.
bool RowNeighbours::adjacent(const Direction& direction, std::size_t lower, std::size_t upper) const
{
  const auto &low = keys_[lower], &high = keys_[upper];
  if (low.begin != high.begin || low.end != high.end ||
      low.*direction.along != high.*direction.along)
    return false;
  const double gap = high.*direction.low - low.*direction.high;
  const double slack = 1e-6 * (low.*direction.high - low.*direction.low);
  return std::abs(gap) < slack ||
         (direction.period && std::abs(gap + *direction.period) < slack && lower != upper);
}

std::optional<std::size_t> RowNeighbours::next(const Direction& direction, std::size_t row,
                                               bool above) const
{
  const auto& rows = direction.rows;
  const auto own = rows.find(direction.place_of(keys_[row]));
  auto [begin, end, along, edge] = own->first;
  const auto first = rows.lower_bound({begin, end, along, -infinity});
  const auto last = std::prev(rows.upper_bound({begin, end, along, infinity}));
  const auto found =
      above ? (own == last ? first : std::next(own)) : (own == first ? last : std::prev(own));
  const bool is_next =
      above ? adjacent(direction, row, found->second) : adjacent(direction, found->second, row);
  return is_next ? std::optional(found->second) : std::nullopt;
}

double RowNeighbours::spread(const Direction& direction, std::size_t row,
                             const RowsBeside& beside) const
{
  // Number of a row from the axis, n above: a whole number and a half.
  const auto number = [&](std::size_t k) {
    const double low = keys_[k].*direction.low, high = keys_[k].*direction.high;
    return (low + high) / 2 / (high - low);
  };
  const auto mean = [&](std::optional<std::size_t> k) {
    return direction.radial ? 1 / (12 * number(k.value_or(row))) : 0;
  };
  const double rows = beside.below.has_value() + beside.above.has_value();
  if (!(rows > 0)) return 0;
  const double distance = rows + mean(beside.above) - mean(beside.below);
  const double n = number(row);
  const double of_axis = direction.radial ? 1 / (144 * n * n) : 0;
  return (1.0 / 12 - of_axis + of_kernel_) / (distance * distance);
}

std::vector<RowsBeside> RowNeighbours::beside(std::size_t row, const Usable& usable) const
{
  std::vector<RowsBeside> all;
  for (const auto& direction : directions_) {
    const auto next_usable = [&](bool above) {
      const auto found = next(direction, row, above);
      return found && usable(*found) ? found : std::nullopt;
    };
    RowsBeside beside{next_usable(false), next_usable(true)};
    beside.spread = spread(direction, row, beside);
    all.push_back(beside);
  }
  return all;
}

}  // namespace grseg
