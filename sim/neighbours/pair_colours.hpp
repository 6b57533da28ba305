// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/cell_grid.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pair_list_lanes.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace grseg {

/// Colours of pairs: no mobile body has two pairs of the same colour, so pairs of a colour may be
/// relaxed at the same time. First fit: a pair takes the first colour that neither of its mobile
/// bodies has yet, in the order of the pairs; immobile bodies take no colour. Pairs of two mobile
/// grains and pairs with a boundary grain ("base") are coloured apart.
class PairColours {
 public:
  /// A class per colour, and one for pairs that are left without; the same again for pairs on the
  /// base, from class on_base on.
  static constexpr std::size_t palette = 65, on_base = palette, all_classes = 2 * palette;
  static constexpr std::uint8_t no_class = 255;  // of two immobile bodies

  void colour(const FoundPairs& found, const CellGrid& grid, const GrainState& grains, int threads);

  /// Class of a found pair.
  std::uint8_t class_of(std::size_t pair) const { return class_of_[pair]; }
  /// Number of a strip's pairs in each class.
  const std::array<std::uint32_t, all_classes>& sizes(std::size_t strip) const
  {
    return sizes_[strip];
  }

 private:
  struct Taken {
    std::uint64_t among_grains = 0, on_base = 0;  // a bit per colour
  };

  /// Of the pair a, b; marks its colour as taken.
  std::uint8_t class_for(std::uint32_t a, std::uint32_t b, const GrainState& grains);
  void colour_strip(std::size_t strip, const FoundPairs& found, const CellGrid& grid,
                    const GrainState& grains);

  std::vector<Taken> taken_;            // per body
  std::vector<std::uint8_t> class_of_;  // per found pair
  std::vector<std::array<std::uint32_t, all_classes>> sizes_;
};

}  // namespace grseg
