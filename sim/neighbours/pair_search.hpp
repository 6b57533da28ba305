// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"
#include "sim/neighbours/pairs.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// Cells at least as wide as pairs reach, in columns along x and bands across y, and the order of
/// bodies along them. Wide scenes are cut into strips of columns; the order is strip by strip, band
/// by band, column by column. The number of strips follows from the number of grains alone; it is
/// even if x is periodic, so that no two strips of even number are neighbours.
class CellGrid {
 public:
  /// Scenes of fewer grains are one strip.
  static constexpr std::size_t cut_from = 10000;

  CellGrid(const Box& box, double cell, int threads);

  /// Lays the grid over `position`, m, and finds the order of the bodies.
  void sort(std::span<const Vec2> position);
  /// Indices before the sort, in the order after it.
  const std::vector<std::uint32_t>& order() const { return order_; }

  std::int32_t columns() const { return columns_; }
  std::int32_t bands() const { return bands_; }
  double column_width() const { return column_width_; }  // m
  /// Bodies of neighbouring columns of a strip in a band.
  Range bodies(std::int32_t first, std::int32_t last, std::int32_t band) const
  {
    return {begin_[cell(first, band)], begin_[cell(last, band) + 1]};
  }

  std::size_t strips() const { return first_column_.size() - 1; }
  /// First column of a strip; of the one after the last, the number of columns.
  std::int32_t first_column(std::size_t strip) const { return first_column_[strip]; }
  Range bodies_of_strip(std::size_t strip) const;

  /// Where the partners of a cell's bodies are; every pair is found from one of its cells only.
  Search search(std::size_t strip, std::int32_t column, std::int32_t band) const;
  /// x brought into [0, period).
  double wrapped(double x) const;

 private:
  void lay(std::span<const Vec2> position);
  void cut_into_strips(std::size_t grains);
  std::int32_t column(double x) const;
  std::int32_t band(double y) const;
  std::size_t cell(std::int32_t column, std::int32_t band) const
  {
    const auto c = static_cast<std::size_t>(column);
    return base_[c] + static_cast<std::size_t>(band) * width_[c];
  }

  double length_, inverse_length_;  // m; 0 and 0 where nothing is periodic
  double cell_;                     // m
  int threads_;
  std::int32_t columns_ = 1, bands_ = 1;
  double left_ = 0, bottom_ = 0, column_width_ = 1, columns_per_metre_ = 1;
  std::vector<std::int32_t> first_column_{0, 1};  // per strip, and behind the last
  std::vector<std::size_t> base_, width_;         // per column: its lowest cell, its strip's width
  std::vector<std::uint32_t> begin_;              // per cell, and behind the last
  std::vector<std::uint32_t> cell_of_, next_, order_;
};

/// Finds all pairs nearer than `skin`, cell by cell, and sorts the bodies along the cells.
struct PairSearch {
  struct Strip {
    FoundPairs found;
    /// Mobile bodies nearer than `skin` to each wall, ascending.
    std::vector<std::vector<std::uint32_t>> at_wall;
  };

  /// Lengths in m; `cell` is d_max + skin.
  PairSearch(const std::vector<Wall>& walls, const Box& box, double cell, double skin, int threads);

  /// Pairs of grains at `position`, m. Sorts `grains`; indices of bodies are those after the sort.
  void find(GrainState& grains, const std::vector<Vec2>& position);

  CellGrid grid;
  std::vector<Vec2> made_at;         // m, of the sorted bodies, as they were passed to find()
  std::vector<std::uint32_t> place;  // new index of each old body
  std::vector<Strip> strips;
  FoundPairs found;  // of all strips

 private:
  void sort_along_cells(GrainState& grains, const std::vector<Vec2>& position);
  void find_wall_pairs(std::size_t strip, const GrainState& grains);
  void join_found(std::size_t grains);

  std::vector<Wall> walls_;
  double skin_;  // m
  int threads_;
  // Scratch space, kept so that it is not allocated again.
  GrainState sorted_;
  Discs discs_;
};

}  // namespace grseg
