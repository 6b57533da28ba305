// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "formats/cli/table.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace grseg {

/// Rows next to a row of a table in one direction, in the same window.
struct RowsBeside {
  std::optional<std::size_t> below = {}, above = {};
  /// Second moment of the row's weight about its mean coordinate, divided by the squared distance
  /// between the mean coordinates of `below` and `above`; the row itself takes the place of a
  /// missing one. 0 if both are missing.
  double spread = 0;

  /// Replaces the number of each row by of(number).
  template <class Of>
  void renumber(const Of& of)
  {
    for (auto* row : {&below, &above})
      if (*row) *row = of(**row);
  }
};

/// Part of psi_L - phi_L of `row` that gradients inside it add (FitPoint::within), from phi_of(row)
/// and stress_of(row) of the row and of those beside it. 0 if its stress is not positive.
template <class PhiOf, class StressOf>
double part_within(std::size_t row, const std::vector<RowsBeside>& beside, const PhiOf& phi_of,
                   const StressOf& stress_of)
{
  const double stress = stress_of(row);
  if (!(stress > 0)) return 0;
  double products = 0;
  for (const auto& [below, above, spread] : beside) {
    const auto low = below.value_or(row), high = above.value_or(row);
    products += spread * (phi_of(high) - phi_of(low)) * (stress_of(high) - stress_of(low));
  }
  return products / stress;
}

/// Finds the rows beside each row of a table: below and above a layer, inside and outside an
/// annulus, and in both directions of a map, across a period of the run (header line "periodic").
///
/// A row of thickness h is a mean with an even weight, whose second moment is h^2/12. A kernel adds
/// its variance. Round an axis the weight is r dr. Between r = (n - 1/2) h and (n + 1/2) h its mean
/// is n h + h/(12 n), and its second moment about the mean h^2/12 - h^2/(144 n^2).
class RowNeighbours {
 public:
  using Usable = std::function<bool(std::size_t row)>;

  /// `keys`: the keys of the table's rows.
  RowNeighbours(const Table& table, std::vector<LayerKey> keys);
  /// One entry for each direction. Neighbours that are not `usable` count as missing.
  std::vector<RowsBeside> beside(std::size_t row, const Usable& usable) const;

 private:
  using Edge = double LayerKey::*;
  using Place = std::tuple<double, double, double, double>;  // window, edge along, lower edge
  struct Direction {
    Edge low, high, along;              // edges in this direction, and one in the other
    bool radial = false;                // the coordinate is the distance from an axis
    std::optional<double> period = {};  // m
    std::map<Place, std::size_t> rows = {};

    Place place_of(const LayerKey& key) const;
  };
  static std::vector<Direction> directions_of(const Table& table);
  bool adjacent(const Direction& direction, std::size_t lower, std::size_t upper) const;
  std::optional<std::size_t> next(const Direction& direction, std::size_t row, bool above) const;
  double spread(const Direction& direction, std::size_t row, const RowsBeside& beside) const;

  std::vector<LayerKey> keys_;
  double of_kernel_;  // variance of the kernel over the squared thickness
  std::vector<Direction> directions_;
};

}  // namespace grseg
