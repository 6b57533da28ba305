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
template <int D>
std::uint8_t class_for(std::uint32_t a, std::uint32_t b, const GrainState<D>& grains,
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

template <int D>
PairGeometry<D> pair_geometry(const Horizontal<D>& shift, double reach)
{
  if constexpr (D == 2)
    return {shift[0], reach};
  else
    return {shift[0], shift[1]};
}

}  // namespace

template <int D>
void PairColours::colour(const FoundPairs& found, const CellGrid<D>& grid,
                         const GrainState<D>& grains, int threads)
{
  taken.resize(grains.size());
  class_of.resize(found.size());
  sizes.resize(grid.strips());
  near_sizes.resize(grid.strips());
  for_alternate_strips(threads, sizes.size(), [&](std::size_t s) {
    const auto bodies = grid.bodies_of_strip(s);
    for (auto a = bodies.begin; a < bodies.end; ++a) taken[a] = {};
    if (sizes.size() > 1)
      for (auto f = found.begin[bodies.begin]; f < found.begin[bodies.end]; ++f)
        taken[found.b[f]] = {};
    sizes[s].fill(0);
    const auto colour_them = [&](std::uint32_t a, std::uint32_t first, std::uint32_t end) {
      for (auto f = first; f < end; ++f) {
        class_of[f] = class_for(a, found.b[f], grains, taken);
        if (class_of[f] != no_class) ++sizes[s][class_of[f]];
      }
    };
    for (auto a = bodies.begin; a < bodies.end; ++a) colour_them(a, found.begin[a], found.far[a]);
    near_sizes[s] = sizes[s];
    for (auto a = bodies.begin; a < bodies.end; ++a)
      colour_them(a, found.far[a], found.begin[a + 1]);
  });
}

template <int D>
PairList<D>::PairList(const std::vector<Wall<D>>& walls, const Box& box, double largest_radius,
                      double skin, double margin, int threads)
    : walls_(walls.size()),
      skin_(skin),
      threads_(threads),
      search_(walls, box, 2 * largest_radius + skin, skin, threads),
      completeness_(walls, box, 2 * largest_radius + skin, skin, margin, threads)
{
  length_[0] = box.periodic_x ? box.length_x : 0;
  if constexpr (D == 3) length_[1] = box.periodic_z ? box.length_z : 0;
}

template <int D>
bool PairList<D>::complete(const std::vector<Position<D>>& position, double farthest)
{
  return search_.made_at.size() == position.size() &&
         completeness_.holds(search_.made_at, position, farthest);
}

template <int D>
void PairList<D>::renew(GrainState<D>& grains, const std::vector<Position<D>>& position)
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

template <int D>
auto PairList<D>::state() const -> State
{
  State state;
  state.made_at = search_.made_at;
  state.skin = skin_;
  state.renewals = renewals_;
  state.i = pairs_.i;
  state.j = pairs_.j;
  for (std::size_t k = 0; k < pairs_.memory.size(); ++k) {
    state.impulse_n.push_back(pairs_.memory[k].n);
    state.impulse_t.push_back(pairs_.memory[k].t);
    state.approach.push_back(pairs_.approach_of(k));
  }
  return state;
}

template <int D>
void PairList<D>::restore(GrainState<D>& grains, const State& state)
{
  if (!state.made_at.empty()) renew(grains, state.made_at);
  const auto now = this->state();
  if (now.i != state.i || now.j != state.j)
    throw FormatError(
        "this grseg-sim finds other pairs than the one that wrote the checkpoint; continue with "
        "the program that wrote it");
  for (std::size_t k = 0; k < pairs_.memory.size(); ++k)
    pairs_.set_memory(k, state.impulse_n[k], state.impulse_t[k], state.approach[k]);
  renewals_ = state.renewals;
}

template <int D>
void PairList<D>::lay_out()
{
  pairs_.classes.clear();
  pairs_.strips.assign(1, 0);
  std::uint32_t begin = 0;
  const auto add_class = [&](std::size_t size, std::size_t near, std::int32_t wall, bool alone,
                             bool base) {
    if (size == 0) return;
    pairs_.classes.push_back(
        {begin, begin + whole_blocks(size), begin + whole_blocks(near), wall, alone, base});
    begin = pairs_.classes.back().end;
  };
  constexpr std::size_t palette = PairColours::palette;
  for (std::size_t s = 0; s < strips_.size(); ++s) {
    auto& strip = strips_[s];
    strip.begin = begin;
    for (std::size_t c = 0; c < PairColours::all_classes; ++c) {
      strip.next[c] = begin;
      add_class(colours_.sizes[s][c], colours_.near_sizes[s][c], -1, c % palette == palette - 1,
                c >= PairColours::on_base);
    }
    for (std::size_t w = 0; w < walls_; ++w) {
      const auto size = search_.strips[s].at_wall[w].size();
      add_class(size, size, static_cast<std::int32_t>(w), false, true);
    }
    strip.end = begin;
    pairs_.strips.push_back(static_cast<std::uint32_t>(pairs_.classes.size()));
  }
  pairs_.i.resize(begin + 1);
  pairs_.j.resize(begin + 1);
  pairs_.geometry.resize(begin + 1);
  pairs_.memory.resize(begin + 1);
  if constexpr (D == 3) pairs_.approach.resize(begin + 1);
}

template <int D>
Horizontal<D> PairList<D>::nearest_shift(const Position<D>& difference) const
{
  Horizontal<D> shift{};
  for (std::size_t k = 0; k < shift.size(); ++k) {
    const double apart = difference[static_cast<Eigen::Index>(2 * k)], length = length_[k];
    if (length > 0 && std::abs(apart) > length / 2)
      shift[k] = -length * std::round(apart * (1 / length));
  }
  return shift;
}

/// Writes the pairs of a strip; the last strip also writes the neutral pair.
template <int D>
void PairList<D>::fill_in(std::size_t strip, const GrainState<D>& grains)
{
  auto& s = strips_[strip];
  const auto offset = [](std::size_t body) {
    return static_cast<std::uint32_t>(position_doubles<D> * body);
  };
  const auto nobody = offset(grains.immobile());
  const auto write = [&](std::size_t k, std::uint32_t i, std::uint32_t j,
                         const PairGeometry<D>& geometry) {
    pairs_.i[k] = i;
    pairs_.j[k] = j;
    pairs_.geometry[k] = geometry;
  };
  for (const auto& c : pairs_.classes_of(strip))
    for (auto k = c.end - block_lanes; k < c.end; ++k) write(k, nobody, nobody, {0, not_a_number});

  const auto bodies = search_.grid.bodies_of_strip(strip);
  const auto& found = search_.found;
  const auto& made_at = search_.made_at;
  const auto write_pairs = [&](std::uint32_t a, std::uint32_t begin, std::uint32_t end) {
    const bool first = grains.motion[a].inverse_mass > 0;
    for (auto f = begin; f < end; ++f) {
      const auto c = colours_.class_of[f];
      if (c == PairColours::no_class) continue;
      const auto b = found.b[f];
      const auto shift = nearest_shift(first ? made_at[a] - made_at[b] : made_at[b] - made_at[a]);
      const std::size_t k = number_[f] = s.next[c]++;
      write(k, offset(first ? a : b), offset(first ? b : a),
            pair_geometry<D>(shift, grains.radius[a] + grains.radius[b]));
    }
  };
  for (auto a = bodies.begin; a < bodies.end; ++a) write_pairs(a, found.begin[a], found.far[a]);
  for (auto a = bodies.begin; a < bodies.end; ++a) write_pairs(a, found.far[a], found.begin[a + 1]);
  for (const auto& c : pairs_.classes_of(strip)) {
    if (c.wall < 0) continue;
    auto k = c.begin;
    for (const auto b : search_.strips[strip].at_wall[static_cast<std::size_t>(c.wall)])
      write(k++, offset(b), nobody, pair_geometry<D>({}, grains.radius[b]));
  }
  const bool last = strip + 1 == strips_.size();
  pairs_.clear_memories(s.begin, last ? s.end + 1 : s.end);
  if (last) write(s.end, nobody, nobody, pair_geometry<D>({}, 1));
}

template <int D>
void PairList<D>::forget()
{
  pairs_.clear_memories(0, pairs_.i.size());
}

template <int D>
void PairList<D>::carry_wall_memory(std::uint32_t body, std::int32_t wall, std::uint32_t from)
{
  for (const auto& c : pairs_.classes) {
    if (c.wall != wall) continue;
    const auto first = pairs_.i.begin() + c.begin, last = pairs_.i.begin() + c.end;
    const auto found = std::lower_bound(first, last, position_doubles<D> * body);
    if (found == last || *found != position_doubles<D> * body) continue;
    const auto to = static_cast<std::size_t>(found - pairs_.i.begin());
    const auto& memory = old_pairs_.memory[from];
    pairs_.set_memory(to, memory.n, memory.t, old_pairs_.approach_of(from));
  }
}

template <int D>
void PairList<D>::carry_memories()
{
  const auto& old = old_pairs_;
  if (old.classes.empty() || pairs_.classes.empty()) return;
  const CarryOver<D> task{old, search_.place.data(), search_.found, number_.data(), pairs_};
  for_each_part(threads_, old.classes.size(), [&](std::size_t n) {
    if (old.classes[n].wall < 0) carry_over<D>(task, old.classes[n].begin, old.classes[n].end);
  });
  for (const auto& c : old.classes) {
    if (c.wall < 0) continue;
    for (auto k = c.begin; k < c.end; ++k)
      if (old.memory[k].n != 0 || old.memory[k].t != Turning<D, double>{})
        carry_wall_memory(search_.place[old.i[k] / position_doubles<D>], c.wall, k);
  }
}

template class PairList<2>;
template class PairList<3>;

}  // namespace grseg
