// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/cell_grid.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/neighbours.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// A straight wall: the half-plane behind `point`, of infinite mass. `normal` (unit length) points
/// into the space that is free to grains.
struct Wall {
  Vec2 point;  // m
  Vec2 normal;
};

/// Listed pairs, class by class. In a class no mobile body appears twice, unless its pairs stand
/// alone. Members of a pair lie side by side where they are read for single pairs.
struct Pairs {
  struct Geometry {
    double shift;  ///< m, to add to x_i - x_j for the nearest periodic image
    double reach;  ///< m, distance of the centres (of the centre, at a wall) that touches
  };
  struct Inertia {
    double inverse_reach;  ///< 1/m
    double mass;           ///< kg, effective along the normal
  };
  struct Impulse {
    double n, t;  ///< kg m/s of the last step, 0 for a pair that did not touch
  };
  struct Memory {
    double approach;  ///< m/s, of a pair before it was slowed down short of touching
    double spare;
  };
  struct Class {
    std::uint32_t begin, end;  ///< multiples of 8
    std::int32_t wall;         ///< number of the wall, or -1 for pairs of grains
    bool alone;                ///< without a colour: a body has more pairs than there are colours
    bool on_base;              ///< the partners j do not move
  };

  /// Twice the body's index, that is where its position begins, counted in doubles. i is mobile.
  std::vector<std::uint32_t> i, j;
  std::vector<Geometry> geometry;
  std::vector<Inertia> inertia;
  std::vector<Impulse> impulse;
  std::vector<Memory> memory;
  /// Strip by strip; in a strip grains among grains first, then those on the base, then those at
  /// walls. What fills the last eight of a class up has reach NaN. Behind the last pair stands a
  /// neutral one, of the body that never moves with itself.
  std::vector<Class> classes;
  /// Per strip its first class, and the number of classes. Pairs of strips that are no neighbours
  /// have no mobile body in common.
  std::vector<std::uint32_t> strips{0, 0};

  std::size_t strip_count() const { return strips.size() - 1; }
  std::span<const Class> classes_of(std::size_t strip) const
  {
    return std::span(classes).subspan(strips[strip], strips[strip + 1] - strips[strip]);
  }

  /// Number of entries, the neutral one left out.
  std::size_t size() const { return i.empty() ? 0 : i.size() - 1; }
  bool listed(std::size_t k) const { return geometry[k].reach > 0; }
};

/// Makes the list of pairs that may touch, and says when a new one is needed.
///
/// A list made at some instant holds every pair nearer than `skin`. It stays complete as long as no
/// two grains that could meet have moved by more than that relative to each other, less `margin`.
/// Grains are grouped by where they were when the list was made, in pieces of bands of height d_max
/// + skin across y; only those of neighbouring groups can meet, so relative displacement is bounded
/// group by group: a layer that slides as a block, however fast, renews nothing.
///
/// Pairs get colours, first fit in the order of space, and are sorted by them, so that contacts
/// come out ready for the solver; immobile bodies take no colour.
class PairList {
 public:
  /// Lists pairs nearer than `skin` and promises those nearer than `margin`, in m.
  PairList(const std::vector<Wall>& walls, const Box& box, double largest_radius, double skin,
           double margin = 0, int threads = 1);

  /// Whether the list still holds every pair that may touch at `position` (m, in the order of the
  /// state, not wrapped since the list was made: a pair remembers which periodic image of j it
  /// means).
  bool complete(const std::vector<Vec2>& position);
  /// Makes the list anew for grains at `position`, in m; impulses of pairs that stay are kept.
  /// Sorts `grains` along the cells.
  void renew(GrainState& grains, const std::vector<Vec2>& position);

  const Pairs& pairs() const { return pairs_; }
  std::span<Pairs::Impulse> impulses() { return pairs_.impulse; }
  std::span<Pairs::Memory> memories() { return pairs_.memory; }
  /// As if no pair had ever touched.
  void forget_impulses();
  std::size_t renewals() const { return renewals_; }
  /// Where a list was no longer complete when it was first asked for: by how much, in m, grains can
  /// have moved past each other in the one step since, unseen. Otherwise 0.
  double moved_in_a_step() const;

  /// All that a list must have to be made again as it is.
  struct State {
    std::vector<Vec2> made_at;        // m, as in GrainState; empty before the first renewal
    std::vector<std::uint32_t> i, j;  // as in Pairs, and with the same neutral pair
    std::vector<double> impulse_n, impulse_t, approach;
    std::uint64_t renewals = 0, age = 0;
  };
  State state() const;
  /// Makes the list again. FormatError where one made at the same positions holds other pairs.
  void restore(GrainState& grains, const State& state);

 private:
  /// Colours among grains and a class for pairs that got none; the same for pairs with the base.
  static constexpr std::size_t palette = 65, on_base = palette, all_classes = 2 * palette;
  struct Taken {
    std::uint64_t among_grains = 0, on_base = 0;  // a bit per colour
  };
  /// What a renewal knows of a strip.
  struct Strip {
    FoundPairs found;
    std::array<std::uint32_t, all_classes> size, next;  // pairs of each class; where they go
    std::vector<std::vector<std::uint32_t>> at_wall;    // bodies, per wall
    std::uint32_t begin, end;                           // in pairs_
  };

  void sort_along_cells(GrainState& grains, const std::vector<Vec2>& position);
  void make_groups();
  void find_pairs(std::size_t strip);
  void find_wall_pairs(std::size_t strip, const GrainState& grains);
  void join_found(std::size_t grains);
  void colour_pairs(std::size_t strip, const GrainState& grains);
  std::uint8_t colour(std::uint32_t a, std::uint32_t b, const GrainState& grains);
  void lay_out();
  void fill_in(std::size_t strip, const GrainState& grains);
  void carry_impulses();
  void carry_wall_impulse(std::uint32_t body, std::int32_t wall, std::uint32_t from);
  void measure_neighbours(std::size_t band);
  bool bands_stay_apart() const;
  bool walls_stay_away() const;
  double nearest_shift(double difference) const;

  std::vector<Wall> walls_;
  double length_, inverse_length_;  // 0 and 0 where nothing is periodic
  double skin_, slack_, cell_;      // m; slack is what skin leaves beside margin
  int threads_;
  CellGrid grid_;
  Pairs pairs_;
  std::size_t renewals_ = 0;
  std::uint64_t age_ = 0;        // how often it was asked for since it was made
  double neighbours_moved_ = 0;  // m, most that grains of neighbouring groups have, relatively

  std::vector<std::size_t> first_group_;  // in a band, per strip, and behind the last
  std::size_t bands_ = 0;
  std::int32_t least_columns_ = 1;        // across the narrowest group
  std::vector<Range> groups_;             // of bodies, band by band
  std::vector<Vec2> made_at_;             // m, positions when the list was made
  std::vector<Extent> moved_;             // per group, since the list was made
  std::vector<Extent> band_moved_;        // per band
  std::vector<double> moved_in_band_;     // m, relative to neighbours, per band
  std::vector<double> unlisted_nearest_;  // m, per wall and group, to grains that are not listed

  // For the renewal alone; kept for the memory.
  Pairs old_pairs_;
  GrainState memory_;
  Discs discs_;
  std::vector<std::uint32_t> place_;  // new index of each old body
  std::vector<Strip> strips_;
  FoundPairs found_;  // of all strips
  std::vector<Taken> taken_;
  std::vector<std::uint8_t> class_of_;  // per found pair
  std::vector<std::uint32_t> number_;   // of each found pair in pairs_
};

}  // namespace grseg
