// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_search.hpp"

#include "sim/contact/contact_blocks.hpp"
#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

// The contacts of a strip fit into the second-level cache, and each thread has several strips.
constexpr std::size_t grains_per_strip = 3500;
// Two columns are enough that contacts of strips that are not neighbours share no grain.
constexpr std::int32_t least_columns_per_strip = 4;

/// Largest index not above `x`, limited to 0 .. count-1; 0 if x is not a number.
std::int32_t nearest_index(double x, std::int32_t count)
{
  return x > 0 ? static_cast<std::int32_t>(std::min(x, count - 1.0)) : 0;
}

}  // namespace

CellGrid::CellGrid(const Box& box, double cell, int threads)
    : length_(box.periodic_x ? box.length_x : 0),
      inverse_length_(box.periodic_x ? 1 / box.length_x : 0),
      cell_(cell),
      threads_(threads)
{
}

void CellGrid::sort(std::span<const Vec2> position)
{
  lay(position);
  cut_into_strips(position.size());
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(bands_);
  begin_.assign(cells + 1, 0);
  cell_of_.resize(position.size());
  order_.resize(position.size());
  for_ranges(threads_, position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g)
      cell_of_[g] =
          static_cast<std::uint32_t>(cell(column(position[g].x()), band(position[g].y())));
  });
  for (const auto c : cell_of_) ++begin_[c + 1];
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  next_ = begin_;
  for (std::size_t g = 0; g < position.size(); ++g)
    order_[next_[cell_of_[g]]++] = static_cast<std::uint32_t>(g);
}

void CellGrid::lay(std::span<const Vec2> position)
{
  Vec2 low = position.front(), high = low;
  for (const auto& x : position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  bottom_ = low.y();
  left_ = length_ > 0 ? 0 : low.x();
  const double width = length_ > 0 ? length_ : high.x() - low.x();
  // A limit to the number of cells, so that a grain that flies far away costs no memory: grains
  // beyond the grid belong to the last cells.
  const double most = 4.0 * static_cast<double>(position.size()) + 16;
  columns_ = static_cast<std::int32_t>(std::clamp(std::floor(width / cell_), 1.0, most));
  if (length_ > 0 && columns_ < 3) columns_ = 1;
  column_width_ = std::max(width / columns_, std::numeric_limits<double>::min());
  columns_per_metre_ = 1 / column_width_;
  const double height = high.y() - low.y();
  bands_ =
      static_cast<std::int32_t>(std::clamp(std::ceil(height / cell_), 1.0, most / columns_ + 1));
}

void CellGrid::cut_into_strips(std::size_t grains)
{
  auto count =
      std::min(static_cast<std::int32_t>(grains < cut_from ? 1 : grains / grains_per_strip),
               columns_ / least_columns_per_strip);
  if (length_ > 0) count -= count % 2;
  count = std::max(count, 1);
  first_column_.resize(static_cast<std::size_t>(count) + 1);
  base_.resize(static_cast<std::size_t>(columns_));
  width_.resize(static_cast<std::size_t>(columns_));
  first_column_[0] = 0;
  for (std::int32_t s = 0; s < count; ++s) {
    const auto first = static_cast<std::int32_t>(std::int64_t{columns_} * s / count);
    const auto last = static_cast<std::int32_t>(std::int64_t{columns_} * (s + 1) / count);
    first_column_[static_cast<std::size_t>(s) + 1] = last;
    for (auto c = first; c < last; ++c) {
      base_[static_cast<std::size_t>(c)] =
          static_cast<std::size_t>(bands_) * static_cast<std::size_t>(first) +
          static_cast<std::size_t>(c - first);
      width_[static_cast<std::size_t>(c)] = static_cast<std::size_t>(last - first);
    }
  }
}

Range CellGrid::bodies_of_strip(std::size_t strip) const
{
  return {begin_[cell(first_column_[strip], 0)],
          begin_[cell(first_column_[strip + 1] - 1, bands_ - 1) + 1]};
}

double CellGrid::wrapped(double x) const
{
  if (length_ == 0 || (x >= 0 && x < length_)) return x;
  return x - length_ * std::floor(x * inverse_length_);
}

std::int32_t CellGrid::column(double x) const
{
  return nearest_index((wrapped(x) - left_) * columns_per_metre_, columns_);
}

std::int32_t CellGrid::band(double y) const
{
  return nearest_index((y - bottom_) / cell_, bands_);
}

Search CellGrid::search(std::size_t strip, std::int32_t column, std::int32_t band) const
{
  const auto first = first_column_[strip], last = first_column_[strip + 1] - 1;
  const bool above = band + 1 < bands_;
  const auto left = std::max(column - 1, first), right = std::min(column + 1, last);
  Search search;
  search.cell = bodies(column, column, band);
  search.end = bodies(column, right, band).end;
  if (above) search.above = bodies(left, right, band + 1);
  if (columns_ == 1) {
    search.length = length_;  // the nearest image may be on either side
    return search;
  }
  if (column == first && above) {
    const bool wraps = column == 0;
    if (!wraps || length_ > 0) {
      const auto other = wraps ? columns_ - 1 : column - 1;
      search.across_above = bodies(other, other, band + 1);
      search.offset = wraps ? -length_ : 0;
    }
  }
  if (column == last) {
    const bool wraps = column == columns_ - 1;
    if (!wraps || length_ > 0) {
      const auto other = wraps ? 0 : column + 1;
      search.across = bodies(other, other, band);
      if (above) search.across_above = bodies(other, other, band + 1);
      search.offset = wraps ? length_ : 0;
    }
  }
  return search;
}

PairSearch::PairSearch(const std::vector<Wall>& walls, const Box& box, double cell, double skin,
                       int threads)
    : grid(box, cell, threads), walls_(walls), skin_(skin), threads_(threads)
{
}

void PairSearch::find(GrainState& grains, const std::vector<Vec2>& position)
{
  sort_along_cells(grains, position);
  strips.resize(grid.strips());
  for_each_part(threads_, strips.size(), [&](std::size_t s) {
    auto& pairs = strips[s].found;
    pairs.begin.assign(1, 0);
    for (std::int32_t band = 0; band < grid.bands(); ++band)
      for (auto c = grid.first_column(s); c < grid.first_column(s + 1); ++c)
        find_near(discs_, grid.search(s, c, band), skin_, pairs);
    find_wall_pairs(s, grains);
  });
  join_found(grains.size());
}

void PairSearch::sort_along_cells(GrainState& grains, const std::vector<Vec2>& position)
{
  const std::size_t count = grains.size();
  grid.sort(std::span(position).first(count));
  const auto& order = grid.order();
  place.resize(count + 1);
  place[count] = static_cast<std::uint32_t>(count);
  made_at.resize(position.size());
  made_at[count] = position[count];
  for (auto* values : {&discs_.x, &discs_.y, &discs_.radius}) values->resize(count + block_lanes);
  sorted_.resize_like(grains);
  for_ranges(threads_, count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const std::size_t old = order[g];
      place[old] = static_cast<std::uint32_t>(g);
      made_at[g] = position[old];
      sorted_.position[g] = grains.position[old];
      sorted_.motion[g] = grains.motion[old];
      sorted_.radius[g] = grains.radius[old];
      sorted_.image[g] = grains.image[old];
      sorted_.row[g] = grains.row[old];
      discs_.x[g] = grid.wrapped(position[old].x());
      discs_.y[g] = position[old].y();
      discs_.radius[g] = grains.radius[old];
    }
  });
  std::swap(grains, sorted_);
}

void PairSearch::find_wall_pairs(std::size_t strip, const GrainState& grains)
{
  auto& at_wall = strips[strip].at_wall;
  at_wall.resize(walls_.size());
  const auto bodies = grid.bodies_of_strip(strip);
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    at_wall[w].clear();
    for (auto b = bodies.begin; b < bodies.end; ++b) {
      if (!(grains.motion[b].inverse_mass > 0)) continue;
      const double gap = distance_to(walls_[w], made_at[b]) - grains.radius[b];
      if (!(gap > skin_)) at_wall[w].push_back(b);
    }
  }
}

void PairSearch::join_found(std::size_t grains)
{
  std::vector<std::uint32_t> first(strips.size() + 1, 0);
  for (std::size_t s = 0; s < strips.size(); ++s)
    first[s + 1] = first[s] + static_cast<std::uint32_t>(strips[s].found.size());
  found.begin.resize(grains + 1);
  found.begin[grains] = first.back();
  found.b.resize(first.back() + block_lanes);
  for_each_part(threads_, strips.size(), [&](std::size_t s) {
    const auto& own = strips[s].found;
    const auto bodies = grid.bodies_of_strip(s);
    for (auto a = bodies.begin; a < bodies.end; ++a)
      found.begin[a] = first[s] + own.begin[a - bodies.begin];
    std::copy_n(own.b.begin(), own.size(), found.b.begin() + first[s]);
  });
}

}  // namespace grseg
