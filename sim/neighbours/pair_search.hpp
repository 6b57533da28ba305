// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"
#include "sim/neighbours/pairs.hpp"

#include <boost/container/static_vector.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// Grid of cells in columns along x, bands across y and, in three dimensions, slices across z; and
/// the order of bodies along the cells. A cell is at least as wide as the largest distance of a
/// listed pair. Wide scenes are cut into strips, which consist of neighbouring columns. Bodies are
/// ordered by strip, then by band, slice and column. The number of strips depends on the grains and
/// the grid, not on the number of threads; it is even if x is periodic, so that no two strips of
/// even index are neighbours.
template <int D>
class CellGrid {
 public:
  /// Number of grains from which on a scene is cut into strips.
  static constexpr std::size_t cut_from = 10000;

  CellGrid(const Box& box, double cell, int threads);

  /// Fits the grid to `position`, m, and determines the order of the bodies.
  void sort(std::span<const Position<D>> position);
  /// For each body in the new order, its index before sort().
  const std::vector<std::uint32_t>& order() const { return order_; }

  std::int32_t columns() const { return columns_; }
  std::int32_t bands() const { return bands_; }
  std::int32_t slices() const { return slices_; }
  double column_width() const { return column_width_; }         // m
  double slice_width() const { return 1 / slices_per_metre_; }  // m
  /// Bodies in the cells (column, band, slice) with first <= column <= last; both columns are of one strip.
  Range bodies(std::int32_t first, std::int32_t last, std::int32_t band, std::int32_t slice) const
  {
    return {begin_[cell(first, band, slice)], begin_[cell(last, band, slice) + 1]};
  }

  std::size_t strips() const { return first_column_.size() - 1; }
  /// First column of a strip; for strip = strips(), the number of columns.
  std::int32_t first_column(std::size_t strip) const { return first_column_[strip]; }
  Range bodies_of_strip(std::size_t strip) const;

  /// Ranges that include the partners of a cell's bodies. Every pair is found from one cell only.
  Search<D> search(std::size_t strip, std::int32_t column, std::int32_t band,
                   std::int32_t slice) const;
  /// Position, m, with x and z moved into [0, period) by whole periods.
  Vector<D> wrapped(const Vector<D>& position) const;

 private:
  void lay(std::span<const Position<D>> position);
  void cut_into_strips(std::size_t grains);
  struct Row {
    std::int32_t band, slice;
    double shift_z = 0;           // m
    Across<D> border{}, signs{};  // Search::Part
  };
  using Rows = boost::container::static_vector<Row, 4>;
  Rows rows_after(std::int32_t band, std::int32_t slice) const;
  std::size_t cell_at(const Vector<D>& position) const;
  std::size_t cell(std::int32_t column, std::int32_t band, std::int32_t slice) const
  {
    const auto c = static_cast<std::size_t>(column);
    return base_[c] + static_cast<std::size_t>(band * slices_ + slice) * width_[c];
  }

  Horizontal<D> length_;  // m, periods of x and z; 0 without periodicity
  double cell_;           // m, least size of a cell
  int threads_;
  std::int32_t columns_ = 1, bands_ = 1, slices_ = 1;
  double left_ = 0, bottom_ = 0, front_ = 0, column_width_ = 1, columns_per_metre_ = 1;
  double slices_per_metre_ = 1;
  std::vector<std::int32_t> first_column_{0, 1};  // per strip; then number of columns
  std::vector<std::size_t> base_, width_;         // per column: lowest cell; columns of its strip
  std::vector<std::uint32_t> begin_;              // per cell, first body; then their number
  std::vector<std::uint32_t> cell_of_, next_, order_;
};

/// Finds all pairs with a gap of at most `skin`, and sorts the bodies along the cells.
template <int D>
struct PairSearch {
  struct Strip {
    FoundPairs found;
    /// Per wall, the mobile bodies with a gap of at most `skin` to it, ascending.
    std::vector<std::vector<std::uint32_t>> at_wall;
  };

  /// All lengths in m; `cell` is d_max + skin.
  PairSearch(const std::vector<Wall<D>>& walls, const Box& box, double cell, double skin,
             int threads);

  /// Finds the pairs of grains at `position`, m, and sorts `grains`. In all results, indices of
  /// bodies are the indices after the sort.
  void find(GrainState<D>& grains, const std::vector<Position<D>>& position);

  CellGrid<D> grid;
  std::vector<Position<D>> made_at;  // m, positions that were passed to find(), sorted
  std::vector<std::uint32_t> place;  // per index of a body before the sort, its new index
  std::vector<Strip> strips;
  FoundPairs found;  // pairs of all strips

 private:
  void sort_along_cells(GrainState<D>& grains, const std::vector<Position<D>>& position);
  void find_wall_pairs(std::size_t strip, const GrainState<D>& grains);
  void join_found(std::size_t grains);

  std::vector<Wall<D>> walls_;
  double skin_;  // m, largest gap of a listed pair
  int threads_;
  // Scratch space; members so that its memory is reused.
  GrainState<D> sorted_;
  Members<D> members_;
};

}  // namespace grseg
