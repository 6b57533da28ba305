// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"
#include "sim/neighbours/pair_search.hpp"
#include "sim/neighbours/pairs.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Tells how long a list of pairs still holds every pair that may touch.
///
/// A list that was made with all pairs nearer than `skin` holds all nearer than `margin` as long as
/// no two grains that could meet have moved by more than skin - margin relative to each other.
/// Grains are grouped by where they were when the list was made, in pieces of bands of height
/// d_max + skin across y. Only grains of neighbouring groups can meet, so relative displacement is
/// bounded group by group: a layer that slides as a block, however fast, needs no new list.
class Completeness {
 public:
  /// Lengths in m; `cell` is d_max + skin.
  Completeness(const std::vector<Wall>& walls, const Box& box, double cell, double skin,
               double margin, int threads);

  /// For a list that was just made, of bodies at `made_at`, m, sorted by `grid`.
  void begin(const CellGrid& grid, const GrainState& grains, const std::vector<Vec2>& made_at);
  /// True while that list is complete with bodies at `position` (m, not wrapped since), and no two
  /// that may meet have moved by more than `farthest`, m, relative to each other.
  bool holds(const std::vector<Vec2>& made_at, const std::vector<Vec2>& position, double farthest);
  /// Upper bound of the relative velocity, m/s, of grains that may have met since the list was made
  /// without being listed, or have moved by more than allowed, if bodies moved with `motion`. 0
  /// where the last holds() was true.
  double fastest_unlisted(const std::vector<Motion>& motion) const;

 private:
  void make_groups(const CellGrid& grid);
  void find_unlisted(std::size_t group, const GrainState& grains, const std::vector<Vec2>& made_at);
  void measure_neighbours(std::size_t band);
  /// Extent of a group and its neighbours to the right and above: any two neighbouring groups lie
  /// in such a square.
  Extent square_at(const std::vector<Extent>& groups, std::size_t band, std::size_t g) const;
  bool bands_stay_apart() const;
  bool walls_stay_away() const;

  std::vector<Wall> walls_;
  bool periodic_;
  double cell_, skin_, slack_;  // m; slack is skin - margin
  int threads_;
  double allowed_ = 0;           // m, slack or what holds() was asked for
  double neighbours_moved_ = 0;  // m, largest relative displacement in neighbouring groups
  double column_width_ = 0;      // m, of the grid

  std::size_t bands_ = 0;
  std::vector<std::size_t> first_group_;  // in a band, per strip, and behind the last
  std::int32_t least_columns_ = 1;        // across the narrowest group
  std::vector<Range> groups_;             // of bodies, band by band
  std::vector<Extent> moved_;             // per group, since the list was made
  std::vector<Extent> band_moved_;        // per band
  std::vector<double> moved_in_band_;     // m, relative to neighbours, per band
  std::vector<double>
      unlisted_nearest_;  // m, per wall and group, gap of the nearest unlisted grain
};

}  // namespace grseg
