// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/neighbours/completeness.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"
#include "sim/neighbours/pair_search.hpp"
#include "sim/neighbours/pairs.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace grseg {

/// Colours of pairs: no mobile body has two pairs of the same colour, so pairs of a colour may be
/// relaxed at the same time. First fit: a pair takes the first colour that neither of its mobile
/// bodies has yet, in the order of the pairs; immobile bodies take no colour. Pairs of two mobile
/// grains and pairs with a boundary grain ("base") are coloured apart.
struct PairColours {
  /// A class per colour, and one for pairs that are left without; the same again for pairs on the
  /// base, from class on_base on.
  static constexpr std::size_t palette = 65, on_base = palette, all_classes = 2 * palette;
  static constexpr std::uint8_t no_class = 255;  // of two immobile bodies

  void colour(const FoundPairs& found, const CellGrid& grid, const GrainState& grains, int threads);

  struct Taken {
    std::uint64_t among_grains = 0, on_base = 0;  // a bit per colour
  };

  std::vector<Taken> taken;                                   // per body
  std::vector<std::uint8_t> class_of;                         // per found pair
  std::vector<std::array<std::uint32_t, all_classes>> sizes;  // pairs in each class, per strip
};

/// The list of pairs that may touch: PairSearch finds them, PairColours sorts them into classes, so
/// that contacts come out ready for the solver, and Completeness says when a new list is needed.
class PairList {
 public:
  /// Lists pairs nearer than `skin` and guarantees those nearer than `margin`; lengths in m.
  PairList(const std::vector<Wall>& walls, const Box& box, double largest_radius, double skin,
           double margin = 0, int threads = 1);

  /// True while the list holds every pair that may touch at `position` (m, in the order of
  /// GrainState; not wrapped since the list was made, which set the pairs' shifts), and no
  /// two that may touch have moved by more than `farthest`, m, relative to each other.
  bool complete(const std::vector<Vec2>& position,
                double farthest = std::numeric_limits<double>::infinity());
  /// Makes a new list for grains at `position`, m; pairs that stay keep what they remember. Sorts
  /// `grains` along the cells.
  void renew(GrainState& grains, const std::vector<Vec2>& position);

  const Pairs& pairs() const { return pairs_; }
  std::span<Pairs::Memory> memories() { return pairs_.memory; }
  /// As if no pair had ever touched.
  void forget();
  std::size_t renewals() const { return renewals_; }
  Range bodies_of_strip(std::size_t strip) const { return search_.grid.bodies_of_strip(strip); }
  /// See Completeness.
  double fastest_unlisted(const std::vector<Motion>& motion) const
  {
    return completeness_.fastest_unlisted(motion);
  }

  /// Data from which the same list can be made again.
  struct State {
    std::vector<Vec2> made_at;        // m, as in GrainState; empty before the first renewal
    std::vector<std::uint32_t> i, j;  // as in Pairs, and with the same neutral pair
    std::vector<double> impulse_n, impulse_t, approach;
    double skin = 0;  // m
    std::uint64_t renewals = 0;
  };
  State state() const;
  /// Makes the list again, with the same skin. FormatError where one made at the same positions
  /// holds other pairs.
  void restore(GrainState& grains, const State& state);

 private:
  /// Where the pairs of a strip go.
  struct Strip {
    std::array<std::uint32_t, PairColours::all_classes> next;  // free entry of each class
    std::uint32_t begin, end;                                  // in pairs_
  };

  void lay_out();
  void fill_in(std::size_t strip, const GrainState& grains);
  void carry_memories();
  void carry_wall_memory(std::uint32_t body, std::int32_t wall, std::uint32_t from);
  double nearest_shift(double difference) const;

  std::size_t walls_;               // their number
  double skin_;                     // m
  double length_, inverse_length_;  // m; 0 and 0 where nothing is periodic
  int threads_;
  PairSearch search_;
  Completeness completeness_;
  PairColours colours_;
  Pairs pairs_;
  std::size_t renewals_ = 0;

  // For the renewal alone; kept so that they are not allocated again.
  Pairs old_pairs_;
  std::vector<Strip> strips_;
  std::vector<std::uint32_t> number_;  // of each found pair, its entry in pairs_
};

}  // namespace grseg
