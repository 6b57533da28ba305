// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/cells_inside.hpp"

#include "analysis/frames/sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace grseg {
namespace {

constexpr double most_steps = 1e6;

/// Cells of one axis: they begin at `low` and have one side.
struct Axis {
  double low, side;
  long cells;
  bool periodic, at_axis;

  Axis(const std::vector<LayerSolid>& rows, double LayerKey::*begin, double LayerKey::*end,
       bool is_periodic, bool is_at_axis)
      : periodic(is_periodic), at_axis(is_at_axis)
  {
    const auto edge = [&](const auto& row, auto of) { return row.key.*of; };
    low = edge(rows.front(), begin);
    double high = low;
    for (const auto& row : rows) {
      low = std::min(low, edge(row, begin));
      high = std::max(high, edge(row, end));
    }
    side = edge(rows.front(), end) - edge(rows.front(), begin);
    cells = std::lround(std::clamp((high - low) / side, 1.0, most_steps));
  }
  long wrapped(long cell) const { return periodic ? (cell % cells + cells) % cells : cell; }
  long at(double edge) const { return std::lround((edge - low) / side); }
  /// Number of steps from a cell to the farthest one whose gap from it is less than `margin`.
  long reach(double margin) const
  {
    return std::lround(std::clamp(std::ceil(margin / side - 1e-9), 0.0, most_steps));
  }
};

/// Cells with at least half the median solid fraction.
class FilledCells {
 public:
  FilledCells(const std::vector<LayerSolid>& rows, const OpenEnds& ends)
      : x_(rows, &LayerKey::left, &LayerKey::right, ends.periodic[0], ends.at_axis),
        y_(rows, &LayerKey::bottom, &LayerKey::top, ends.periodic[1], false)
  {
    struct Mean {
      double solid = 0, frames = 0;
    };
    std::map<Place, Mean> means;
    for (const auto& row : rows) {
      auto& mean = means[{x_.at(row.key.left), y_.at(row.key.bottom)}];
      mean.solid += row.key.frames * row.solid;
      mean.frames += row.key.frames;
    }
    const double half = median_solid(rows) / 2;
    for (const auto& [place, mean] : means)
      if (mean.solid >= half * mean.frames && mean.solid > 0) filled_.insert(place);
  }

  bool all_near(const LayerKey& key, double margin) const
  {
    const long i = x_.at(key.left), j = y_.at(key.bottom);
    const long reach_x = x_.reach(margin), reach_y = y_.reach(margin);
    for (long dy = -reach_y; dy <= reach_y; ++dy)
      for (long dx = -reach_x; dx <= reach_x; ++dx)
        if (!is_filled(i + dx, j + dy)) return false;
    return true;
  }

 private:
  using Place = std::pair<long, long>;

  bool is_filled(long i, long j) const
  {
    return filled_.contains({x_.wrapped(x_.at_axis ? std::max(i, 0L) : i), y_.wrapped(j)});
  }

  Axis x_, y_;
  std::set<Place> filled_;
};

}  // namespace

std::vector<bool> cells_inside(const std::vector<LayerSolid>& rows, const OpenEnds& ends,
                               double margin)
{
  if (rows.empty()) return {};
  const FilledCells cells(rows, ends);
  return listed(rows, [&](const LayerSolid& row) { return cells.all_near(row.key, margin); });
}

HeightRange annuli_inside(const std::vector<LayerSolid>& annuli, double margin)
{
  const double half = median_solid(annuli) / 2;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  HeightRange range{infinity, -infinity};
  double inner = 0;  // solid fraction of the next annulus inside
  for (const auto& mean : mean_layers(annuli)) {
    const auto& [bottom, top] = std::pair(mean.key.bottom, mean.key.top);
    if (mean.solid >= half) range.lowest = std::min(range.lowest, bottom > 0 ? bottom + margin : 0);
    if (mean.solid > 0) {
      const double filled = std::min(1.0, mean.solid / inner);
      range.highest = bottom + filled * (top - bottom) - margin;
    }
    inner = mean.solid;
  }
  return range;
}

}  // namespace grseg
