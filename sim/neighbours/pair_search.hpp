// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/cell_grid.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"
#include "sim/neighbours/pairs.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Finds all pairs nearer than `skin`, cell by cell, and sorts the bodies along the cells.
class PairSearch {
 public:
  /// Lengths in m; `cell` is d_max + skin.
  PairSearch(const std::vector<Wall>& walls, const Box& box, double cell, double skin, int threads);

  /// Pairs of grains at `position`, m. Sorts `grains`; indices of bodies are those after the sort.
  void find(GrainState& grains, const std::vector<Vec2>& position);

  const CellGrid& grid() const { return grid_; }
  /// m, of the sorted bodies when they were searched, as they were passed to find().
  const std::vector<Vec2>& made_at() const { return made_at_; }
  const FoundPairs& found() const { return found_; }
  /// Mobile bodies of a strip nearer than `skin` to a wall, ascending.
  const std::vector<std::uint32_t>& at_wall(std::size_t strip, std::size_t wall) const
  {
    return strips_[strip].at_wall[wall];
  }
  /// New index of each old body.
  const std::vector<std::uint32_t>& place() const { return place_; }

 private:
  struct Strip {
    FoundPairs found;
    std::vector<std::vector<std::uint32_t>> at_wall;  // bodies, per wall
  };

  void sort_along_cells(GrainState& grains, const std::vector<Vec2>& position);
  void find_pairs(std::size_t strip);
  void find_wall_pairs(std::size_t strip, const GrainState& grains);
  void join_found(std::size_t grains);

  std::vector<Wall> walls_;
  double skin_;  // m
  int threads_;
  CellGrid grid_;
  std::vector<Vec2> made_at_;
  std::vector<std::uint32_t> place_;
  std::vector<Strip> strips_;
  FoundPairs found_;  // of all strips
  // Scratch space, kept so that it is not allocated again.
  GrainState sorted_;
  Discs discs_;
};

}  // namespace grseg
