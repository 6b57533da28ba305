// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"
#include "sim/neighbours/pair_search.hpp"
#include "sim/neighbours/pairs.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// Decides for how long a list of pairs still includes every pair that may touch.
///
/// A new list includes all pairs with a gap below `skin`. It includes all pairs with a gap below
/// `margin` as long as no two grains that could meet have moved by more than skin - margin relative
/// to each other. Grains are grouped by their positions when the list was made: bands of height
/// d_max + skin, and their slices across z, are divided along x into groups. Only grains of
/// neighbouring groups can meet, so the relative displacement is bounded for neighbouring groups: a
/// layer that slides as a block, however fast, needs no new list.
template <int D>
class Completeness {
 public:
  /// All lengths in m; `cell` is d_max + skin.
  Completeness(const std::vector<Wall<D>>& walls, const Box& box, double cell, double skin,
               double margin, int threads);

  /// To be called when a list has been made, of bodies at `made_at`, m, sorted by `grid`.
  void begin(const CellGrid<D>& grid, const GrainState<D>& grains,
             const std::vector<Position<D>>& made_at);
  /// True while the list includes every pair that may touch with bodies at `position` (m, not
  /// wrapped since the list was made), and no two bodies that may meet have moved by more than
  /// `farthest`, m, relative to each other.
  bool holds(const std::vector<Position<D>>& made_at, const std::vector<Position<D>>& position,
             double farthest);
  /// True if, at the positions of the last begin() or holds(), pairs of neighbouring groups that
  /// had a gap above `distance`, m, when the list was made cannot touch.
  bool keeps_apart_beyond(double distance) const
  {
    return neighbours_moved_ + (skin_ - slack_) <= distance;
  }
  /// Upper bound of the relative velocity, m/s, of grains that may have met since the list was made
  /// although their pair is not listed, or that have moved farther than allowed, if bodies moved
  /// with `motion`. 0 if the last holds() was true.
  double fastest_unlisted(const std::vector<Motion<D>>& motion) const;

 private:
  void make_groups(const CellGrid<D>& grid);
  void find_unlisted(std::size_t group, const GrainState<D>& grains,
                     const std::vector<Position<D>>& made_at);
  void measure_neighbours(std::size_t band);
  /// Number of groups in a band.
  std::size_t per_band() const { return slices_ * first_group_.back(); }
  /// Common extent of the square of groups (in three dimensions: cube) whose first corner is group
  /// g: g and its next neighbours to the right, above and behind. Any two neighbouring groups are
  /// in one such square or cube.
  Extent<D> cube_at(const std::vector<Extent<D>>& groups, std::size_t band, std::size_t g) const;
  bool bands_stay_apart() const;
  bool walls_stay_away() const;

  std::vector<Wall<D>> walls_;
  bool periodic_x_, periodic_z_;
  double cell_, skin_, slack_;  // m, see above; slack is skin - margin
  int threads_;
  double allowed_ = 0;           // m, smaller one of slack and `farthest` of holds()
  double neighbours_moved_ = 0;  // m, largest relative displacement of neighbouring groups
  double column_width_ = 0;      // m, width of a column of the grid
  double slice_width_ = 0;       // m

  std::size_t bands_ = 0, slices_ = 1;
  std::vector<std::size_t> first_group_;  // per strip, index in a row; then groups per row
  std::int32_t least_columns_ = 1;        // width of the narrowest group, in columns
  std::vector<Range> groups_;             // bodies of each group, band by band, slice by slice
  std::vector<Extent<D>> moved_;          // per group, m, displacements since the list was made
  std::vector<Extent<D>> band_moved_;     // per band, m, displacements
  std::vector<double> moved_in_band_;     // per band, m, relative to neighbouring groups
  std::vector<double>
      unlisted_nearest_;  // per wall and group, m, gap of the nearest unlisted grain
};

}  // namespace grseg
