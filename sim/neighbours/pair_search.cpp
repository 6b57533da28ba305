// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_search.hpp"

#include "sim/contact/contact_blocks.hpp"
#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

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

template <int D>
CellGrid<D>::CellGrid(const Box& box, double cell, int threads) : cell_(cell), threads_(threads)
{
  length_[0] = box.periodic_x ? box.length_x : 0;
  if constexpr (D == 3) length_[1] = box.periodic_z ? box.length_z : 0;
}

template <int D>
void CellGrid<D>::sort(std::span<const Position<D>> position)
{
  lay(position);
  cut_into_strips(position.size());
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(bands_) *
                     static_cast<std::size_t>(slices_);
  begin_.assign(cells + 1, 0);
  cell_of_.resize(position.size());
  order_.resize(position.size());
  for_ranges(threads_, position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g)
      cell_of_[g] = static_cast<std::uint32_t>(cell_at(wrapped(point<D>(position[g]))));
  });
  for (const auto c : cell_of_) ++begin_[c + 1];
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  next_ = begin_;
  for (std::size_t g = 0; g < position.size(); ++g)
    order_[next_[cell_of_[g]]++] = static_cast<std::uint32_t>(g);
}

template <int D>
void CellGrid<D>::lay(std::span<const Position<D>> position)
{
  Vector<D> low = point<D>(position.front()), high = low;
  for (const auto& x : position) {
    low = low.cwiseMin(point<D>(x));
    high = high.cwiseMax(point<D>(x));
  }
  bottom_ = low.y();
  // A limit to the number of cells, so that a grain that flies far away costs no memory: grains
  // beyond the grid belong to the last cells.
  const double most = 4.0 * static_cast<double>(position.size()) + 16;
  // Returns the number of cells across, the first one's border and the width of a cell.
  const auto divide = [&](double period, double from, double to, double most_cells) {
    const double width = period > 0 ? period : to - from;
    auto count = static_cast<std::int32_t>(std::clamp(std::floor(width / cell_), 1.0, most_cells));
    if (period > 0 && count < 3) count = 1;
    return std::tuple(count, period > 0 ? 0 : from,
                      std::max(width / count, std::numeric_limits<double>::min()));
  };
  std::tie(columns_, left_, column_width_) = divide(length_[0], low.x(), high.x(), most);
  columns_per_metre_ = 1 / column_width_;
  if constexpr (D == 3) {
    double width = 0;
    std::tie(slices_, front_, width) = divide(length_[1], low.z(), high.z(), most / columns_ + 1);
    slices_per_metre_ = 1 / width;
  }
  bands_ = static_cast<std::int32_t>(
      std::clamp(std::ceil((high.y() - low.y()) / cell_), 1.0, most / (columns_ * slices_) + 1));
}

template <int D>
void CellGrid<D>::cut_into_strips(std::size_t grains)
{
  auto count =
      std::min(static_cast<std::int32_t>(grains < cut_from ? 1 : grains / grains_per_strip),
               columns_ / least_columns_per_strip);
  if (length_[0] > 0) count -= count % 2;
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
          static_cast<std::size_t>(bands_ * slices_) * static_cast<std::size_t>(first) +
          static_cast<std::size_t>(c - first);
      width_[static_cast<std::size_t>(c)] = static_cast<std::size_t>(last - first);
    }
  }
}

template <int D>
Range CellGrid<D>::bodies_of_strip(std::size_t strip) const
{
  return {begin_[cell(first_column_[strip], 0, 0)],
          begin_[cell(first_column_[strip + 1] - 1, bands_ - 1, slices_ - 1) + 1]};
}

template <int D>
Vector<D> CellGrid<D>::wrapped(const Vector<D>& position) const
{
  const auto wrap = [](double x, double length) {
    if (length == 0 || (x >= 0 && x < length)) return x;
    return x - length * std::floor(x * (1 / length));
  };
  Vector<D> inside = position;
  inside.x() = wrap(position.x(), length_[0]);
  if constexpr (D == 3) inside.z() = wrap(position.z(), length_[1]);
  return inside;
}

/// `position` is wrapped.
template <int D>
std::size_t CellGrid<D>::cell_at(const Vector<D>& position) const
{
  std::int32_t slice = 0;
  if constexpr (D == 3) slice = nearest_index((position.z() - front_) * slices_per_metre_, slices_);
  return cell(nearest_index((position.x() - left_) * columns_per_metre_, columns_),
              nearest_index((position.y() - bottom_) / cell_, bands_), slice);
}

/// Rows (bodies of a band and slice) that follow the one of a cell and are its neighbours.
/// `shift_z` is added to z of their bodies.
template <int D>
auto CellGrid<D>::rows_after(std::int32_t band, std::int32_t slice) const -> Rows
{
  Rows rows;
  const auto add = [&](std::int32_t up, std::int32_t on) {
    auto other = slice + on;
    double shift = 0;
    if (other < 0 || other >= slices_) {
      if (D == 2 || length_[D - 2] == 0 || slices_ == 1) return;
      shift = other < 0 ? -length_[D - 2] : length_[D - 2];
      other += other < 0 ? slices_ : -slices_;
    }
    if (band + up >= bands_) return;
    Row row{band + up, other, shift};
    row.border[0] = bottom_ + cell_ * (band + 1);
    row.signs[0] = up;
    if constexpr (D == 3) {
      row.border[1] = front_ + (on > 0 ? slice + 1 : slice) / slices_per_metre_;
      row.signs[1] = on;
    }
    rows.push_back(row);
  };
  add(1, 0);
  if constexpr (D == 3) add(0, 1), add(1, -1), add(1, 1);
  return rows;
}

template <int D>
Search<D> CellGrid<D>::search(std::size_t strip, std::int32_t column, std::int32_t band,
                              std::int32_t slice) const
{
  const auto first = first_column_[strip], last = first_column_[strip + 1] - 1;
  const auto left = std::max(column - 1, first), right = std::min(column + 1, last);
  const auto shift = [](double x, [[maybe_unused]] double z) -> Horizontal<D> {
    if constexpr (D == 2)
      return {x};
    else
      return {x, z};
  };
  Search<D> search;
  search.cell = bodies(column, column, band, slice);
  search.end = bodies(column, right, band, slice).end;
  search.left = left_ + column_width_ * column;
  search.right = left_ + column_width_ * (column + 1);
  const auto add = [&](Range all, Range own, const Row& row, double shift_x) {
    search.add({all, own, shift(shift_x, row.shift_z), row.border, row.signs});
  };
  const auto rows = rows_after(band, slice);
  for (const auto& row : rows)
    add(bodies(left, right, row.band, row.slice), bodies(column, column, row.band, row.slice), row,
        0);
  // The nearest image may be on either side.
  search.period = shift(columns_ == 1 ? length_[0] : 0, slices_ == 1 ? length_[D - 2] : 0);
  if (columns_ == 1) return search;
  // Bodies beyond the border of the strip on the left (step -1) or on the right.
  const auto add_beyond = [&](const Row& row, std::int32_t step) {
    const bool wraps = column + step < 0 || column + step >= columns_;
    if (wraps && length_[0] == 0) return;
    const auto other = wraps ? column + step - step * columns_ : column + step;
    const auto all = bodies(other, other, row.band, row.slice);
    const auto near_end = step < 0 ? all.end : all.begin;
    add(all, {near_end, near_end}, row, wraps ? step * length_[0] : 0);
  };
  if (column == last) add_beyond({band, slice}, 1);
  for (const auto& row : rows) {
    if (column == first) add_beyond(row, -1);
    if (column == last) add_beyond(row, 1);
  }
  return search;
}

template <int D>
PairSearch<D>::PairSearch(const std::vector<Wall<D>>& walls, const Box& box, double cell,
                          double skin, int threads)
    : grid(box, cell, threads), walls_(walls), skin_(skin), threads_(threads)
{
  members_.largest_radius = (cell - skin) / 2;
}

template <int D>
void PairSearch<D>::find(GrainState<D>& grains, const std::vector<Position<D>>& position)
{
  sort_along_cells(grains, position);
  strips.resize(grid.strips());
  for_each_part(threads_, strips.size(), [&](std::size_t s) {
    auto& pairs = strips[s].found;
    pairs.begin.assign(1, 0);
    pairs.far.clear();
    for (std::int32_t band = 0; band < grid.bands(); ++band)
      for (std::int32_t slice = 0; slice < grid.slices(); ++slice)
        for (auto c = grid.first_column(s); c < grid.first_column(s + 1); ++c)
          find_near(members_, grid.search(s, c, band, slice), skin_, pairs);
    find_wall_pairs(s, grains);
  });
  join_found(grains.size());
}

template <int D>
void PairSearch<D>::sort_along_cells(GrainState<D>& grains,
                                     const std::vector<Position<D>>& position)
{
  const std::size_t count = grains.size();
  grid.sort(std::span(position).first(count));
  const auto& order = grid.order();
  place.resize(count + 1);
  place[count] = static_cast<std::uint32_t>(count);
  made_at.resize(position.size());
  made_at[count] = position[count];
  for (auto& values : members_.x) values.resize(count + block_lanes);
  members_.radius.resize(count + block_lanes);
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
      const Vector<D> at = grid.wrapped(point<D>(position[old]));
      for (std::size_t k = 0; k < D; ++k) members_.x[k][g] = at[static_cast<Eigen::Index>(k)];
      members_.radius[g] = grains.radius[old];
    }
  });
  std::swap(grains, sorted_);
}

template <int D>
void PairSearch<D>::find_wall_pairs(std::size_t strip, const GrainState<D>& grains)
{
  auto& at_wall = strips[strip].at_wall;
  at_wall.resize(walls_.size());
  const auto bodies = grid.bodies_of_strip(strip);
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    at_wall[w].clear();
    for (auto b = bodies.begin; b < bodies.end; ++b) {
      if (!(grains.motion[b].inverse_mass > 0)) continue;
      const double gap = distance_to<D>(walls_[w], point<D>(made_at[b])) - grains.radius[b];
      if (!(gap > skin_)) at_wall[w].push_back(b);
    }
  }
}

template <int D>
void PairSearch<D>::join_found(std::size_t grains)
{
  std::vector<std::uint32_t> first(strips.size() + 1, 0);
  for (std::size_t s = 0; s < strips.size(); ++s)
    first[s + 1] = first[s] + static_cast<std::uint32_t>(strips[s].found.size());
  found.begin.resize(grains + 1);
  found.far.resize(grains);
  found.begin[grains] = first.back();
  found.b.resize(first.back() + block_lanes);
  for_each_part(threads_, strips.size(), [&](std::size_t s) {
    const auto& own = strips[s].found;
    const auto bodies = grid.bodies_of_strip(s);
    for (auto a = bodies.begin; a < bodies.end; ++a) {
      found.begin[a] = first[s] + own.begin[a - bodies.begin];
      found.far[a] = first[s] + own.far[a - bodies.begin];
    }
    std::copy_n(own.b.begin(), own.size(), found.b.begin() + first[s]);
  });
}

template class CellGrid<2>;
template class CellGrid<3>;
template struct PairSearch<2>;
template struct PairSearch<3>;

}  // namespace grseg
