// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_colours.hpp"

#include "sim/contact/parallel.hpp"

#include <bit>

namespace grseg {

void PairColours::colour(const FoundPairs& found, const CellGrid& grid, const GrainState& grains,
                         int threads)
{
  taken_.resize(grains.size());
  class_of_.resize(found.size());
  sizes_.resize(grid.strips());
  for_alternate_strips(threads, sizes_.size(),
                       [&](std::size_t s) { colour_strip(s, found, grid, grains); });
}

std::uint8_t PairColours::class_for(std::uint32_t a, std::uint32_t b, const GrainState& grains)
{
  constexpr std::size_t colours = palette - 1;
  const auto bit = [](int free) { return free < 64 ? std::uint64_t{1} << free : 0; };
  static_assert(colours == 64);
  const bool a_moves = grains.motion[a].inverse_mass > 0;
  const bool b_moves = grains.motion[b].inverse_mass > 0;
  if (a_moves && b_moves) {
    const int free = std::countr_one(taken_[a].among_grains | taken_[b].among_grains);
    taken_[a].among_grains |= bit(free);
    taken_[b].among_grains |= bit(free);
    return static_cast<std::uint8_t>(free);
  }
  if (!a_moves && !b_moves) return no_class;
  auto& taken = taken_[a_moves ? a : b].on_base;
  const int free = std::countr_one(taken);
  taken |= bit(free);
  return static_cast<std::uint8_t>(on_base + static_cast<std::size_t>(free));
}

void PairColours::colour_strip(std::size_t strip, const FoundPairs& found, const CellGrid& grid,
                               const GrainState& grains)
{
  const auto bodies = grid.bodies_of_strip(strip);
  for (auto a = bodies.begin; a < bodies.end; ++a) taken_[a] = {};
  if (sizes_.size() > 1)
    for (auto f = found.begin[bodies.begin]; f < found.begin[bodies.end]; ++f)
      taken_[found.b[f]] = {};
  auto& size = sizes_[strip];
  size.fill(0);
  for (auto a = bodies.begin; a < bodies.end; ++a) {
    for (auto f = found.begin[a]; f < found.begin[a + 1]; ++f) {
      class_of_[f] = class_for(a, found.b[f], grains);
      if (class_of_[f] != no_class) ++size[class_of_[f]];
    }
  }
}

}  // namespace grseg
