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

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::int32_t columns_per_group = 3;
constexpr std::uint8_t no_class = 255;

void add(Extent& extent, const Extent& other)
{
  extent.low = extent.low.cwiseMin(other.low);
  extent.high = extent.high.cwiseMax(other.high);
}

Extent nothing()
{
  return {Vec2::Constant(infinity), Vec2::Constant(-infinity)};
}

bool empty(const Extent& extent)
{
  return extent.low.x() > extent.high.x();
}

/// The least that any displacement within `extent` leads along `direction`; infinity for none.
double least_along(const Extent& extent, const Vec2& direction)
{
  if (empty(extent)) return infinity;
  return std::min(extent.low.x() * direction.x(), extent.high.x() * direction.x()) +
         std::min(extent.low.y() * direction.y(), extent.high.y() * direction.y());
}

std::uint32_t whole_blocks(std::size_t pairs)
{
  return static_cast<std::uint32_t>((pairs + block_lanes - 1) / block_lanes * block_lanes);
}

double distance_to(const Wall& wall, const Vec2& x)
{
  return (x - wall.point).dot(wall.normal);
}

}  // namespace

PairList::PairList(const std::vector<Wall>& walls, const Box& box, double largest_radius,
                   double skin, double margin, int threads)
    : walls_(walls),
      length_(box.periodic_x ? box.length_x : 0),
      inverse_length_(box.periodic_x ? 1 / box.length_x : 0),
      skin_(skin),
      slack_(skin - margin),
      cell_(2 * largest_radius + skin),
      threads_(threads),
      grid_(box, cell_, threads)
{
}

// --- Is the list complete? ---

bool PairList::complete(const std::vector<Vec2>& position)
{
  if (made_at_.size() != position.size()) return false;
  ++age_;
  const std::size_t across = first_group_.back();
  for_each_part(threads_, bands_, [&](std::size_t band) {
    measure_displacements(made_at_, position, std::span(groups_).subspan(band * across, across),
                          std::span(moved_).subspan(band * across));
  });
  for_each_part(threads_, bands_, [&](std::size_t band) { measure_neighbours(band); });
  neighbours_moved_ = *std::max_element(moved_in_band_.begin(), moved_in_band_.end());
  return neighbours_moved_ <= slack_ && bands_stay_apart() && walls_stay_away();
}

double PairList::moved_in_a_step() const
{
  if (age_ != 1) return 0;
  if (neighbours_moved_ > slack_) return neighbours_moved_;
  if (bands_stay_apart()) return 0;
  auto all = nothing();
  for (const auto& band : band_moved_) add(all, band);
  return (all.high - all.low).norm();
}

/// Any two neighbouring groups lie in a square of two by two.
void PairList::measure_neighbours(std::size_t band)
{
  const std::size_t across = first_group_.back();
  const auto* here = &moved_[band * across];
  const auto* above = band + 1 < bands_ ? here + across : here;
  band_moved_[band] = nothing();
  double squared = 0;
  for (std::size_t g = 0; g < across; ++g) {
    const std::size_t next = g + 1 < across ? g + 1 : length_ > 0 ? 0 : g;
    auto square = here[g];
    add(band_moved_[band], square);
    for (const auto& other : {here[next], above[g], above[next]}) add(square, other);
    if (!empty(square)) squared = std::max(squared, (square.high - square.low).squaredNorm());
  }
  moved_in_band_[band] = std::sqrt(squared);
}

/// Groups that are no neighbours are a band or a group apart: they may move by that much more.
bool PairList::bands_stay_apart() const
{
  const double group_width = least_columns_ * grid_.column_width();
  const bool all_are_neighbours = first_group_.back() <= (length_ > 0 ? 3 : 2);
  auto below = nothing(), here = nothing();
  double highest = -infinity;  // two bands or more below, less the height in between
  for (const auto& band : band_moved_) {
    highest = std::max(highest - cell_, below.high.y());
    below = here;
    here = band;
    if (empty(here)) continue;
    if (!(highest - here.low.y() <= slack_)) return false;
    auto both = here;
    add(both, below);
    if (!all_are_neighbours && !(both.high.x() - both.low.x() <= group_width - cell_ + slack_))
      return false;
  }
  return true;
}

bool PairList::walls_stay_away() const
{
  const double margin = skin_ - slack_;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!(unlisted_nearest_[w * groups_.size() + g] + least_along(moved_[g], walls_[w].normal) >
            margin))
        return false;
  return true;
}

// --- A new list ---

void PairList::renew(GrainState& grains, const std::vector<Vec2>& position)
{
  ++renewals_;
  age_ = 0;
  sort_along_cells(grains, position);
  make_groups();
  const std::size_t strips = grid_.strips();
  strips_.resize(strips);
  for_each_part(threads_, strips, [&](std::size_t s) {
    find_pairs(s);
    find_wall_pairs(s, grains);
  });
  join_found(grains.size());
  taken_.resize(grains.size());
  for_alternate_strips(threads_, strips, [&](std::size_t s) { colour_pairs(s, grains); });
  std::swap(pairs_, old_pairs_);
  lay_out();
  for_each_part(threads_, strips, [&](std::size_t s) { fill_in(s, grains); });
  carry_impulses();
}

PairList::State PairList::state() const
{
  State state;
  state.made_at = made_at_;
  state.renewals = renewals_;
  state.age = age_;
  state.i = pairs_.i;
  state.j = pairs_.j;
  for (const auto& impulse : pairs_.impulse) {
    state.impulse_n.push_back(impulse.n);
    state.impulse_t.push_back(impulse.t);
  }
  for (const auto& memory : pairs_.memory) state.approach.push_back(memory.approach);
  return state;
}

void PairList::restore(GrainState& grains, const State& state)
{
  if (!state.made_at.empty()) renew(grains, state.made_at);
  const auto now = this->state();
  if (now.i != state.i || now.j != state.j)
    throw FormatError(
        "this grseg-sim finds other pairs than the one that wrote the checkpoint; go on with the "
        "program that wrote it");
  for (std::size_t k = 0; k < pairs_.impulse.size(); ++k) {
    pairs_.impulse[k] = {state.impulse_n[k], state.impulse_t[k]};
    pairs_.memory[k] = {state.approach[k], 0};
  }
  renewals_ = state.renewals;
  age_ = state.age;
}

void PairList::sort_along_cells(GrainState& grains, const std::vector<Vec2>& position)
{
  const std::size_t count = grains.size();
  grid_.sort(std::span(position).first(count));
  const auto& order = grid_.order();
  place_.resize(count + 1);
  place_[count] = static_cast<std::uint32_t>(count);
  made_at_.resize(position.size());
  made_at_[count] = position[count];
  for (auto* values : {&discs_.x, &discs_.y, &discs_.radius}) values->resize(count + block_lanes);
  memory_.resize_like(grains);
  for_ranges(threads_, count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const std::size_t old = order[g];
      place_[old] = static_cast<std::uint32_t>(g);
      made_at_[g] = position[old];
      memory_.position[g] = grains.position[old];
      memory_.motion[g] = grains.motion[old];
      memory_.radius[g] = grains.radius[old];
      memory_.image[g] = grains.image[old];
      memory_.row[g] = grains.row[old];
      discs_.x[g] = grid_.wrapped(position[old].x());
      discs_.y[g] = position[old].y();
      discs_.radius[g] = grains.radius[old];
    }
  });
  std::swap(grains, memory_);
}

void PairList::make_groups()
{
  bands_ = static_cast<std::size_t>(grid_.bands());
  first_group_.assign(1, 0);
  std::vector<std::int32_t> first_column;
  least_columns_ = grid_.columns();
  for (std::size_t s = 0; s < grid_.strips(); ++s) {
    const auto begin = grid_.first_column(s), columns = grid_.first_column(s + 1) - begin;
    const auto count = std::max(columns / columns_per_group, 1);
    for (std::int32_t g = 0; g < count; ++g) first_column.push_back(begin + g * columns / count);
    first_group_.push_back(first_column.size());
    least_columns_ = std::min(least_columns_, columns / count);
  }
  first_column.push_back(grid_.columns());
  groups_.clear();
  for (std::int32_t band = 0; band < grid_.bands(); ++band)
    for (std::size_t g = 0; g + 1 < first_column.size(); ++g)
      groups_.push_back(grid_.bodies(first_column[g], first_column[g + 1] - 1, band));
  moved_.resize(groups_.size());
  band_moved_.resize(bands_);
  moved_in_band_.resize(bands_);
  unlisted_nearest_.assign(walls_.size() * groups_.size(), infinity);
}

void PairList::find_pairs(std::size_t strip)
{
  auto& found = strips_[strip].found;
  found.begin.assign(1, 0);
  for (std::int32_t band = 0; band < grid_.bands(); ++band)
    for (auto c = grid_.first_column(strip); c < grid_.first_column(strip + 1); ++c)
      find_near(discs_, grid_.search(strip, c, band), skin_, found);
}

void PairList::find_wall_pairs(std::size_t strip, const GrainState& grains)
{
  auto& at_wall = strips_[strip].at_wall;
  at_wall.resize(walls_.size());
  const std::size_t across = first_group_.back();
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    at_wall[w].clear();
    for (std::size_t band = 0; band < bands_; ++band) {
      for (auto g = first_group_[strip]; g < first_group_[strip + 1]; ++g) {
        const auto& group = groups_[band * across + g];
        auto& nearest = unlisted_nearest_[w * groups_.size() + band * across + g];
        for (auto b = group.begin; b < group.end; ++b) {
          if (!(grains.motion[b].inverse_mass > 0)) continue;
          const double gap = distance_to(walls_[w], made_at_[b]) - grains.radius[b];
          if (gap > skin_)
            nearest = std::min(nearest, gap);
          else
            at_wall[w].push_back(b);
        }
      }
    }
  }
}

void PairList::join_found(std::size_t grains)
{
  std::vector<std::uint32_t> first(strips_.size() + 1, 0);
  for (std::size_t s = 0; s < strips_.size(); ++s)
    first[s + 1] = first[s] + static_cast<std::uint32_t>(strips_[s].found.size());
  found_.begin.resize(grains + 1);
  found_.begin[grains] = first.back();
  found_.b.resize(first.back() + block_lanes);
  class_of_.resize(first.back());
  number_.resize(first.back());
  for_each_part(threads_, strips_.size(), [&](std::size_t s) {
    const auto& found = strips_[s].found;
    const auto bodies = grid_.bodies_of_strip(s);
    for (auto a = bodies.begin; a < bodies.end; ++a)
      found_.begin[a] = first[s] + found.begin[a - bodies.begin];
    std::copy_n(found.b.begin(), found.size(), found_.b.begin() + first[s]);
  });
}

std::uint8_t PairList::colour(std::uint32_t a, std::uint32_t b, const GrainState& grains)
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

void PairList::colour_pairs(std::size_t strip, const GrainState& grains)
{
  const auto bodies = grid_.bodies_of_strip(strip);
  for (auto a = bodies.begin; a < bodies.end; ++a) taken_[a] = {};
  if (strips_.size() > 1)
    for (auto f = found_.begin[bodies.begin]; f < found_.begin[bodies.end]; ++f)
      taken_[found_.b[f]] = {};
  auto& size = strips_[strip].size;
  size.fill(0);
  for (auto a = bodies.begin; a < bodies.end; ++a) {
    for (auto f = found_.begin[a]; f < found_.begin[a + 1]; ++f) {
      class_of_[f] = colour(a, found_.b[f], grains);
      if (class_of_[f] != no_class) ++size[class_of_[f]];
    }
  }
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
  for (auto& strip : strips_) {
    strip.begin = begin;
    for (std::size_t c = 0; c < all_classes; ++c) {
      strip.next[c] = begin;
      add_class(strip.size[c], -1, c % palette == palette - 1, c >= on_base);
    }
    for (std::size_t w = 0; w < walls_.size(); ++w)
      add_class(strip.at_wall[w].size(), static_cast<std::int32_t>(w), false, true);
    strip.end = begin;
    pairs_.strips.push_back(static_cast<std::uint32_t>(pairs_.classes.size()));
  }
  pairs_.i.resize(begin + 1);
  pairs_.j.resize(begin + 1);
  pairs_.geometry.resize(begin + 1);
  pairs_.inertia.resize(begin + 1);
  pairs_.impulse.resize(begin + 1);
  pairs_.memory.resize(begin + 1);
}

double PairList::nearest_shift(double difference) const
{
  return std::abs(difference) <= length_ / 2 ? 0
                                             : -length_ * std::round(difference * inverse_length_);
}

/// Writes the pairs of a strip, behind the last one the neutral pair.
void PairList::fill_in(std::size_t strip, const GrainState& grains)
{
  auto& s = strips_[strip];
  const auto nobody = static_cast<std::uint32_t>(2 * grains.still());
  const auto write = [&](std::size_t k, std::uint32_t i, std::uint32_t j,
                         const Pairs::Geometry& geometry, double inverse_mass) {
    pairs_.i[k] = i;
    pairs_.j[k] = j;
    pairs_.geometry[k] = geometry;
    pairs_.inertia[k] = {geometry.reach, inverse_mass};  // inverted below
  };
  for (const auto& c : pairs_.classes_of(strip))
    for (auto k = c.end - block_lanes; k < c.end; ++k)
      write(k, nobody, nobody, {0, not_a_number}, 1);

  const auto bodies = grid_.bodies_of_strip(strip);
  for (auto a = bodies.begin; a < bodies.end; ++a) {
    const double w_a = grains.motion[a].inverse_mass;
    for (auto f = found_.begin[a]; f < found_.begin[a + 1]; ++f) {
      if (class_of_[f] == no_class) continue;
      const auto b = found_.b[f];
      const double shift = nearest_shift(made_at_[a].x() - made_at_[b].x());
      const bool first = w_a > 0;
      const std::size_t k = number_[f] = s.next[class_of_[f]]++;
      write(k, 2 * (first ? a : b), 2 * (first ? b : a),
            {first ? shift : -shift, grains.radius[a] + grains.radius[b]},
            w_a + grains.motion[b].inverse_mass);
    }
  }
  for (const auto& c : pairs_.classes_of(strip)) {
    if (c.wall < 0) continue;
    auto k = c.begin;
    for (const auto b : s.at_wall[static_cast<std::size_t>(c.wall)])
      write(k++, 2 * b, nobody, {0, grains.radius[b]}, grains.motion[b].inverse_mass);
  }
  std::fill(pairs_.impulse.begin() + s.begin, pairs_.impulse.begin() + s.end, Pairs::Impulse{});
  std::fill(pairs_.memory.begin() + s.begin, pairs_.memory.begin() + s.end, Pairs::Memory{});
  if (s.end > s.begin)
    invert({&pairs_.inertia[s.begin].inverse_reach, 2 * std::size_t{s.end - s.begin}});
  if (strip + 1 < strips_.size()) return;
  write(s.end, nobody, nobody, {0, 1}, 0);
  pairs_.impulse[s.end] = {};
  pairs_.memory[s.end] = {};
}

void PairList::forget_impulses()
{
  pairs_.impulse.assign(pairs_.i.size(), {0, 0});
  pairs_.memory.assign(pairs_.i.size(), {0, 0});
}

void PairList::carry_wall_impulse(std::uint32_t body, std::int32_t wall, std::uint32_t from)
{
  for (const auto& c : pairs_.classes) {
    if (c.wall != wall) continue;
    const auto first = pairs_.i.begin() + c.begin, last = pairs_.i.begin() + c.end;
    const auto found = std::lower_bound(first, last, 2 * body);
    if (found == last || *found != 2 * body) continue;
    const auto to = static_cast<std::size_t>(found - pairs_.i.begin());
    pairs_.impulse[to] = old_pairs_.impulse[from];
    pairs_.memory[to] = old_pairs_.memory[from];
  }
}

void PairList::carry_impulses()
{
  const auto& old = old_pairs_;
  if (old.classes.empty() || pairs_.classes.empty()) return;
  const Carry task{old.i.data(),
                   old.j.data(),
                   place_.data(),
                   &found_,
                   number_.data(),
                   &old.impulse[0].n,
                   &old.memory[0].approach,
                   &pairs_.impulse[0].n,
                   &pairs_.memory[0].approach};
  for_each_part(threads_, old.classes.size(), [&](std::size_t n) {
    if (old.classes[n].wall < 0) carry_over(task, old.classes[n].begin, old.classes[n].end);
  });
  for (const auto& c : old.classes) {
    if (c.wall < 0) continue;
    for (auto k = c.begin; k < c.end; ++k)
      if (old.impulse[k].n != 0 || old.impulse[k].t != 0)
        carry_wall_impulse(place_[old.i[k] / 2], c.wall, k);
  }
}

}  // namespace grseg
