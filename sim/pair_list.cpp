// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/pair_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

/// The box that a set of displacements spans.
struct Range {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;

  void add(const Vec2& displacement)
  {
    low = low.cwiseMin(displacement);
    high = high.cwiseMax(displacement);
  }
  void add(const Range& other)
  {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  double squared_diagonal() const { return low.x() > high.x() ? 0 : (high - low).squaredNorm(); }
};

bool before(const PairList::Pair& a, const PairList::Pair& b)
{
  return a.i != b.i ? a.i < b.i : a.j < b.j;
}

}  // namespace

PairList::PairList(const Grains& grains, const std::vector<Wall>& walls, const Box& box,
                   double skin)
    : walls_(walls),
      length_(box.periodic_x ? box.length_x : 0),
      inverse_length_(box.periodic_x ? 1 / box.length_x : 0),
      skin_(skin),
      cell_(2 * *std::max_element(grains.radius.begin(), grains.radius.end()) + skin)
{
}

bool PairList::complete(const std::vector<Vec2>& position) const
{
  if (made_at_.size() != position.size()) return false;
  std::vector<Range> ranges(static_cast<std::size_t>(bands_) + 1);
  Range all;
  for (std::size_t g = 0; g < position.size(); ++g) {
    const Vec2 displacement = position[g] - made_at_[g];
    ranges[static_cast<std::size_t>(band_of_[g])].add(displacement);
    for (const auto& wall : walls_)
      if (!(-displacement.dot(wall.normal) <= skin_)) return false;
  }
  // Bands more than one apart stay apart as long as nothing moves by `skin` across them.
  for (const auto& range : ranges) all.add(range);
  if (!(all.high.y() - all.low.y() <= skin_)) return false;
  for (std::size_t b = 0; b + 1 < ranges.size(); ++b) {
    Range neighbours = ranges[b];
    neighbours.add(ranges[b + 1]);
    if (!(neighbours.squared_diagonal() <= skin_ * skin_)) return false;
  }
  return true;
}

void PairList::renew(const Grains& grains, const std::vector<Vec2>& position)
{
  ++renewals_;
  made_at_ = position;
  sort_into_cells(position);
  const auto old_pairs = std::move(pairs_);
  pairs_.clear();
  find_grain_pairs(grains, position);
  find_wall_pairs(grains, position);
  std::sort(pairs_.begin(), pairs_.end(), before);
  carry_impulses(old_pairs);
}

double PairList::nearest_shift(double difference) const
{
  return -length_ * std::round(difference * inverse_length_);
}

std::int32_t PairList::cell_x(double x) const
{
  double along = x - left_;
  if (length_ > 0) along -= length_ * std::floor(along * inverse_length_);
  return std::clamp(static_cast<std::int32_t>(along / column_width_), 0, columns_ - 1);
}

std::size_t PairList::cell(std::int32_t column, std::int32_t row) const
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

std::int32_t PairList::band(double y) const
{
  return static_cast<std::int32_t>(std::min((y - bottom_) / cell_, bands_ - 1.0));
}

void PairList::sort_into_cells(const std::vector<Vec2>& position)
{
  Range extent;
  for (const auto& x : position) extent.add(x);
  bottom_ = extent.low.y();
  left_ = length_ > 0 ? 0 : extent.low.x();
  const double width = length_ > 0 ? length_ : extent.high.x() - extent.low.x();
  // A grain that flies far away must not cost memory: what lies beyond shares the last cells.
  const double most = 4.0 * static_cast<double>(position.size()) + 16;
  columns_ = static_cast<std::int32_t>(std::clamp(std::floor(width / cell_), 1.0, most));
  if (length_ > 0 && columns_ < 3) columns_ = 1;
  column_width_ = std::max(width / columns_, std::numeric_limits<double>::min());
  const double height = extent.high.y() - extent.low.y();
  bands_ =
      static_cast<std::int32_t>(std::clamp(std::ceil(height / cell_), 1.0, most / columns_ + 1));

  band_of_.resize(position.size());
  cell_begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(bands_) + 1, 0);
  std::vector<std::size_t> cell_of(position.size());
  for (std::size_t g = 0; g < position.size(); ++g) {
    band_of_[g] = band(position[g].y());
    cell_of[g] = cell(cell_x(position[g].x()), band_of_[g]);
    ++cell_begin_[cell_of[g] + 1];
  }
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  auto next = cell_begin_;
  in_cell_.resize(position.size());
  for (std::size_t g = 0; g < position.size(); ++g)
    in_cell_[static_cast<std::size_t>(next[cell_of[g]]++)] = static_cast<std::int32_t>(g);
}

void PairList::find_grain_pairs(const Grains& grains, const std::vector<Vec2>& position)
{
  const auto try_cell = [&](std::int32_t g, std::int32_t column, std::int32_t row) {
    const auto here = static_cast<std::size_t>(g);
    const auto first = cell_begin_[cell(column, row)], last = cell_begin_[cell(column, row) + 1];
    for (auto k = first; k < last; ++k) {
      const auto other = in_cell_[static_cast<std::size_t>(k)];
      const auto there = static_cast<std::size_t>(other);
      if (other <= g || (grains.fixed[here] && grains.fixed[there])) continue;
      Vec2 apart = position[here] - position[there];
      const double shift = nearest_shift(apart.x());
      apart.x() += shift;
      const double reach = grains.radius[here] + grains.radius[there];
      if (apart.squaredNorm() > (reach + skin_) * (reach + skin_)) continue;
      pairs_.push_back(grains.fixed[here] ? Pair{other, g, -shift, reach}
                                          : Pair{g, other, shift, reach});
    }
  };
  for (std::int32_t g = 0; g < static_cast<std::int32_t>(position.size()); ++g) {
    const std::int32_t column = cell_x(position[static_cast<std::size_t>(g)].x());
    const std::int32_t row = band_of_[static_cast<std::size_t>(g)];
    for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row + 1, bands_ - 1); ++r) {
      if (columns_ == 1) {
        try_cell(g, 0, r);
        continue;
      }
      for (std::int32_t c = column - 1; c <= column + 1; ++c) {
        if (length_ > 0)
          try_cell(g, (c + columns_) % columns_, r);
        else if (c >= 0 && c < columns_)
          try_cell(g, c, r);
      }
    }
  }
}

void PairList::find_wall_pairs(const Grains& grains, const std::vector<Vec2>& position)
{
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    for (std::size_t g = 0; g < position.size(); ++g) {
      const double distance = (position[g] - walls_[w].point).dot(walls_[w].normal);
      if (!grains.fixed[g] && distance - grains.radius[g] <= skin_)
        pairs_.push_back(
            {static_cast<std::int32_t>(g), -static_cast<std::int32_t>(w) - 1, 0, grains.radius[g]});
    }
  }
}

void PairList::carry_impulses(const std::vector<Pair>& old_pairs)
{
  const auto old_n = std::move(impulse_n), old_t = std::move(impulse_t);
  impulse_n.assign(pairs_.size(), 0);
  impulse_t.assign(pairs_.size(), 0);
  std::size_t old = 0;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    while (old < old_pairs.size() && before(old_pairs[old], pairs_[k])) ++old;
    if (old == old_pairs.size()) break;
    if (before(pairs_[k], old_pairs[old])) continue;
    impulse_n[k] = old_n[old];
    impulse_t[k] = old_t[old];
  }
}

}  // namespace grseg
