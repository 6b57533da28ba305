// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_list.hpp"

#include "formats/core/errors.hpp"
#include "sim/contact/contact_blocks.hpp"
#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::uint32_t whole_blocks(std::size_t pairs)
{
  return static_cast<std::uint32_t>((pairs + block_lanes - 1) / block_lanes * block_lanes);
}

/// Returns the class of the pair a, b and marks its colour as taken by both bodies.
std::uint8_t class_for(std::uint32_t a, std::uint32_t b, const GrainState& grains,
                       std::vector<PairColours::Taken>& taken)
{
  static_assert(PairColours::palette == 65);
  const auto bit = [](int free) { return free < 64 ? std::uint64_t{1} << free : 0; };
  const bool a_moves = grains.motion[a].inverse_mass > 0;
  const bool b_moves = grains.motion[b].inverse_mass > 0;
  if (a_moves && b_moves) {
    const int free = std::countr_one(taken[a].among_grains | taken[b].among_grains);
    taken[a].among_grains |= bit(free);
    taken[b].among_grains |= bit(free);
    return static_cast<std::uint8_t>(free);
  }
  if (!a_moves && !b_moves) return PairColours::no_class;
  auto& on_base = taken[a_moves ? a : b].on_base;
  const int free = std::countr_one(on_base);
  on_base |= bit(free);
  return static_cast<std::uint8_t>(PairColours::on_base + static_cast<std::size_t>(free));
}

}  // namespace

void PairColours::colour(const FoundPairs& found, const CellGrid& grid, const GrainState& grains,
                         int threads)
{
  taken.resize(grains.size());
  class_of.resize(found.size());
  sizes.resize(grid.strips());
  for_alternate_strips(threads, sizes.size(), [&](std::size_t s) {
    const auto bodies = grid.bodies_of_strip(s);
    for (auto a = bodies.begin; a < bodies.end; ++a) taken[a] = {};
    if (sizes.size() > 1)
      for (auto f = found.begin[bodies.begin]; f < found.begin[bodies.end]; ++f)
        taken[found.b[f]] = {};
    sizes[s].fill(0);
    for (auto a = bodies.begin; a < bodies.end; ++a) {
      for (auto f = found.begin[a]; f < found.begin[a + 1]; ++f) {
        class_of[f] = class_for(a, found.b[f], grains, taken);
        if (class_of[f] != no_class) ++sizes[s][class_of[f]];
      }
    }
  });
}

PairList::PairList(const std::vector<Wall>& walls, const Box& box, double largest_radius,
                   double skin, double margin, int threads)
    : walls_(walls.size()),
      skin_(skin),
      length_(box.periodic_x ? box.length_x : 0),
      inverse_length_(box.periodic_x ? 1 / box.length_x : 0),
      threads_(threads),
      search_(walls, box, 2 * largest_radius + skin, skin, threads),
      completeness_(walls, box, 2 * largest_radius + skin, skin, margin, threads)
{
}

bool PairList::complete(const std::vector<Vec2>& position, double farthest)
{
  return search_.made_at.size() == position.size() &&
         completeness_.holds(search_.made_at, position, farthest);
}

void PairList::renew(GrainState& grains, const std::vector<Vec2>& position)
{
  ++renewals_;
  search_.find(grains, position);
  completeness_.begin(search_.grid, grains, search_.made_at);
  colours_.colour(search_.found, search_.grid, grains, threads_);
  std::swap(pairs_, old_pairs_);
  strips_.resize(search_.grid.strips());
  number_.resize(search_.found.size());
  lay_out();
  for_each_part(threads_, strips_.size(), [&](std::size_t s) { fill_in(s, grains); });
  carry_memories();
}

PairList::State PairList::state() const
{
  State state;
  state.made_at = search_.made_at;
  state.skin = skin_;
  state.renewals = renewals_;
  state.i = pairs_.i;
  state.j = pairs_.j;
  for (const auto& memory : pairs_.memory) {
    state.impulse_n.push_back(memory.n);
    state.impulse_t.push_back(memory.t);
    state.approach.push_back(memory.approach);
  }
  return state;
}

void PairList::restore(GrainState& grains, const State& state)
{
  if (!state.made_at.empty()) renew(grains, state.made_at);
  const auto now = this->state();
  if (now.i != state.i || now.j != state.j)
    throw FormatError(
        "this grseg-sim finds other pairs than the one that wrote the checkpoint; continue with "
        "the program that wrote it");
  for (std::size_t k = 0; k < pairs_.memory.size(); ++k)
    pairs_.memory[k] = {state.impulse_n[k], state.impulse_t[k], state.approach[k], 0};
  renewals_ = state.renewals;
}

void PairList::lay_out()
{
  pairs_.classes.clear();
  pairs_.strips.assign(1, 0);
  std::uint32_t begin = 0;
  const auto add_class = [&](std::size_t size, std::int32_t wall, bool alone, bool base) {
    if (size == 0) return;
    pairs_.classes.push_back({begin, begin + whole_blocks(size), wall, alone, base});
    begin = pairs_.classes.back().end;
  };
  constexpr std::size_t palette = PairColours::palette;
  for (std::size_t s = 0; s < strips_.size(); ++s) {
    auto& strip = strips_[s];
    strip.begin = begin;
    for (std::size_t c = 0; c < PairColours::all_classes; ++c) {
      strip.next[c] = begin;
      add_class(colours_.sizes[s][c], -1, c % palette == palette - 1, c >= PairColours::on_base);
    }
    for (std::size_t w = 0; w < walls_; ++w)
      add_class(search_.strips[s].at_wall[w].size(), static_cast<std::int32_t>(w), false, true);
    strip.end = begin;
    pairs_.strips.push_back(static_cast<std::uint32_t>(pairs_.classes.size()));
  }
  pairs_.i.resize(begin + 1);
  pairs_.j.resize(begin + 1);
  pairs_.geometry.resize(begin + 1);
  pairs_.memory.resize(begin + 1);
}

double PairList::nearest_shift(double difference) const
{
  return std::abs(difference) <= length_ / 2 ? 0
                                             : -length_ * std::round(difference * inverse_length_);
}

/// Writes the pairs of a strip; the last strip also writes the neutral pair.
void PairList::fill_in(std::size_t strip, const GrainState& grains)
{
  auto& s = strips_[strip];
  const auto nobody = static_cast<std::uint32_t>(2 * grains.immobile());
  const auto write = [&](std::size_t k, std::uint32_t i, std::uint32_t j,
                         const Pairs::Geometry& geometry) {
    pairs_.i[k] = i;
    pairs_.j[k] = j;
    pairs_.geometry[k] = geometry;
  };
  for (const auto& c : pairs_.classes_of(strip))
    for (auto k = c.end - block_lanes; k < c.end; ++k) write(k, nobody, nobody, {0, not_a_number});

  const auto bodies = search_.grid.bodies_of_strip(strip);
  const auto& found = search_.found;
  const auto& made_at = search_.made_at;
  for (auto a = bodies.begin; a < bodies.end; ++a) {
    const bool first = grains.motion[a].inverse_mass > 0;
    for (auto f = found.begin[a]; f < found.begin[a + 1]; ++f) {
      const auto c = colours_.class_of[f];
      if (c == PairColours::no_class) continue;
      const auto b = found.b[f];
      const double shift = nearest_shift(made_at[a].x() - made_at[b].x());
      const std::size_t k = number_[f] = s.next[c]++;
      write(k, 2 * (first ? a : b), 2 * (first ? b : a),
            {first ? shift : -shift, grains.radius[a] + grains.radius[b]});
    }
  }
  for (const auto& c : pairs_.classes_of(strip)) {
    if (c.wall < 0) continue;
    auto k = c.begin;
    for (const auto b : search_.strips[strip].at_wall[static_cast<std::size_t>(c.wall)])
      write(k++, 2 * b, nobody, {0, grains.radius[b]});
  }
  std::fill(pairs_.memory.begin() + s.begin, pairs_.memory.begin() + s.end, Pairs::Memory{});
  if (strip + 1 < strips_.size()) return;
  write(s.end, nobody, nobody, {0, 1});
  pairs_.memory[s.end] = {};
}

void PairList::forget()
{
  pairs_.memory.assign(pairs_.i.size(), {});
}

void PairList::carry_wall_memory(std::uint32_t body, std::int32_t wall, std::uint32_t from)
{
  for (const auto& c : pairs_.classes) {
    if (c.wall != wall) continue;
    const auto first = pairs_.i.begin() + c.begin, last = pairs_.i.begin() + c.end;
    const auto found = std::lower_bound(first, last, 2 * body);
    if (found == last || *found != 2 * body) continue;
    const auto to = static_cast<std::size_t>(found - pairs_.i.begin());
    pairs_.memory[to] = old_pairs_.memory[from];
  }
}

void PairList::carry_memories()
{
  const auto& old = old_pairs_;
  if (old.classes.empty() || pairs_.classes.empty()) return;
  const CarryOver task{old.i.data(),   old.j.data(),     search_.place.data(), &search_.found,
                       number_.data(), &old.memory[0].n, &pairs_.memory[0].n};
  for_each_part(threads_, old.classes.size(), [&](std::size_t n) {
    if (old.classes[n].wall < 0) carry_over(task, old.classes[n].begin, old.classes[n].end);
  });
  for (const auto& c : old.classes) {
    if (c.wall < 0) continue;
    for (auto k = c.begin; k < c.end; ++k)
      if (old.memory[k].n != 0 || old.memory[k].t != 0)
        carry_wall_memory(search_.place[old.i[k] / 2], c.wall, k);
  }
}

}  // namespace grseg
