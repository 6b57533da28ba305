// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/frame.hpp"

#include <cstdint>
#include <vector>

namespace grseg {

/// A straight wall: the half-plane behind `point`, of infinite mass. `normal` (unit length) points
/// into the space that is free to grains.
struct Wall {
  Vec2 point;  // m
  Vec2 normal;
};

/// The pairs that may touch until the list is renewed, and what the solver remembers of them.
///
/// A list made at some instant holds every pair nearer than `skin`. It stays complete as long as no
/// two grains that could meet have moved by more than `skin` relative to each other. Grains that
/// can meet lie in the same or in neighbouring bands of height d_max + skin across y, so relative
/// displacement is bounded band by band: a layer that slides as a block, however fast, renews
/// nothing.
class PairList {
 public:
  struct Pair {
    std::int32_t i, j;  ///< rows of Grains, i mobile; j < 0 is wall -j-1
    double shift;       ///< m, to add to x_i - x_j for the nearest periodic image
    double reach;       ///< m, distance of the centres (of the centre, at a wall) that touches
  };

  PairList(const Grains& grains, const std::vector<Wall>& walls, const Box& box, double skin);

  /// Whether the list still holds every pair that may touch at `position` (m, not wrapped since
  /// the list was made, since a pair remembers which periodic image of j it means).
  bool complete(const std::vector<Vec2>& position) const;
  /// Makes the list anew; impulses of pairs that stay are kept.
  void renew(const Grains& grains, const std::vector<Vec2>& position);

  std::size_t size() const { return pairs_.size(); }
  const Pair& operator[](std::size_t k) const { return pairs_[k]; }
  std::size_t renewals() const { return renewals_; }

  /// Impulses (kg m/s) of the last step, 0 for pairs that did not touch.
  std::vector<double> impulse_n, impulse_t;

 private:
  void sort_into_cells(const std::vector<Vec2>& position);
  void find_grain_pairs(const Grains& grains, const std::vector<Vec2>& position);
  void find_wall_pairs(const Grains& grains, const std::vector<Vec2>& position);
  void carry_impulses(const std::vector<Pair>& old_pairs);
  double nearest_shift(double difference) const;
  std::int32_t cell_x(double x) const;
  std::int32_t band(double y) const;
  std::size_t cell(std::int32_t column, std::int32_t row) const;

  std::vector<Wall> walls_;
  double length_, inverse_length_;  // 0 and 0 where nothing is periodic
  double skin_, cell_;              // m
  std::vector<Pair> pairs_;
  std::vector<Vec2> made_at_;          // positions when the list was made
  std::vector<std::int32_t> band_of_;  // per grain, when the list was made
  std::vector<std::int32_t> cell_begin_, in_cell_;
  std::int32_t columns_ = 1, bands_ = 1;
  double left_ = 0, bottom_ = 0, column_width_ = 1;
  std::size_t renewals_ = 0;
};

}  // namespace grseg
