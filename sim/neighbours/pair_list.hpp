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

/// Colours of pairs. No mobile body has two pairs of the same colour, so pairs of one colour may be
/// relaxed at the same time. Pairs are coloured in their order, each with the first colour that
/// neither of its mobile bodies has yet (first fit); immobile bodies are ignored. Pairs of two
/// mobile grains and pairs with a boundary grain ("base") are coloured separately.
struct PairColours {
  /// Number of classes: one per colour, and one for pairs that get no colour. Pairs on the base
  /// have as many classes of their own, from class on_base on.
  static constexpr std::size_t palette = 65, on_base = palette, all_classes = 2 * palette;
  static constexpr std::uint8_t no_class = 255;  // class of a pair of two immobile bodies

  template <int D>
  void colour(const FoundPairs& found, const CellGrid<D>& grid, const GrainState<D>& grains,
              int threads);

  struct Taken {
    std::uint64_t among_grains = 0, on_base = 0;  // one bit per colour
  };

  std::vector<Taken> taken;            // per body, colours of its pairs
  std::vector<std::uint8_t> class_of;  // per found pair, its class
  // Per strip and class: number of pairs, and of near pairs (FoundPairs), which are coloured first.
  std::vector<std::array<std::uint32_t, all_classes>> sizes, near_sizes;
};

/// List of pairs that may touch. PairSearch finds the pairs, PairColours sorts them into classes
/// from which blocks for the solver can be built, and Completeness limits the life of a list.
template <int D>
class PairList {
 public:
  /// Creates an empty list. A list includes all pairs with a gap below `skin` when it is made, and
  /// stays valid while it includes all pairs with a gap below `margin`; lengths in m.
  PairList(const std::vector<Wall<D>>& walls, const Box& box, double largest_radius, double skin,
           double margin = 0, int threads = 1);

  /// True while the list includes every pair that may touch at `position` (m, in the order of
  /// GrainState; not wrapped since the list was made, because making it sets
  /// PairGeometry::shift), and no two grains that may touch have moved by more than `farthest`,
  /// m, relative to each other.
  bool complete(const std::vector<Position<D>>& position,
                double farthest = std::numeric_limits<double>::infinity());
  /// Makes a new list for grains at `position`, m, and sorts `grains` along the cells. Pairs that
  /// are also in the old list retain their memories (PairMemory).
  void renew(GrainState<D>& grains, const std::vector<Position<D>>& position);

  const Pairs<D>& pairs() const { return pairs_; }
  Pairs<D>& pairs() { return pairs_; }
  /// Clears all memories, as if no pair had ever touched.
  void forget();
  std::size_t renewals() const { return renewals_; }
  Range bodies_of_strip(std::size_t strip) const { return search_.grid.bodies_of_strip(strip); }
  /// True if only near pairs can touch, by the motion that complete() has found.
  bool only_near() const { return completeness_.keeps_apart_beyond(near_part<D> * skin_); }
  /// See Completeness::fastest_unlisted().
  double fastest_unlisted(const std::vector<Motion<D>>& motion) const
  {
    return completeness_.fastest_unlisted(motion);
  }

  /// Data from which the same list can be restored.
  struct State {
    std::vector<Position<D>> made_at;  // m, order of GrainState; empty before the first renewal
    std::vector<std::uint32_t> i, j;   // as in Pairs, including the neutral pair
    std::vector<double> impulse_n;     // as in PairMemory
    std::vector<Turning<D, double>> impulse_t;
    std::vector<double> approach;
    double skin = 0;  // m, see PairList()
    std::uint64_t renewals = 0;
  };
  State state() const;
  /// Makes the list of `state` again, with the same skin. Throws FormatError if the list made at
  /// the same positions includes other pairs than `state`.
  void restore(GrainState<D>& grains, const State& state);

 private:
  /// Places of the pairs of a strip in pairs_.
  struct Strip {
    std::array<std::uint32_t, PairColours::all_classes> next;  // next free entry of each class
    std::uint32_t begin, end;                                  // entries of the strip in pairs_
  };

  void lay_out();
  void fill_in(std::size_t strip, const GrainState<D>& grains);
  void carry_memories();
  void carry_wall_memory(std::uint32_t body, std::int32_t wall, std::uint32_t from);
  Horizontal<D> nearest_shift(const Position<D>& difference) const;

  std::size_t walls_;       // number of walls
  double skin_;             // m, see PairList()
  Horizontal<D> length_{};  // m, periods of x and z; 0 without periodicity
  int threads_;
  PairSearch<D> search_;
  Completeness<D> completeness_;
  PairColours colours_;
  Pairs<D> pairs_;
  std::size_t renewals_ = 0;

  // Used by renew() only; members so that their memory is reused.
  Pairs<D> old_pairs_;
  std::vector<Strip> strips_;
  std::vector<std::uint32_t> number_;  // per found pair, its entry in pairs_
};

}  // namespace grseg
