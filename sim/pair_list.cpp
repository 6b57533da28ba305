// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/pair_list.hpp"

#include "formats/errors.hpp"
#include "sim/contact_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t cells_per_group = 3;

/// Classes while pairs are coloured: colours among grains and those left over, then the same for
/// pairs with the base.
constexpr std::size_t colours = ContactBlocks::colours;
constexpr std::size_t palette = colours + 1;

constexpr Pairs::Geometry no_geometry{0, std::numeric_limits<double>::quiet_NaN()};
constexpr Pairs::Geometry neutral_geometry{0, 1};

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

/// The first of `values` in a new order; `memory` is for the old ones.
template <class T>
void sort_as(const std::vector<std::uint32_t>& order, std::vector<T>& values,
             std::vector<T>& memory)
{
  memory.resize(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) memory[k] = values[order[k]];
  for (std::size_t k = order.size(); k < values.size(); ++k) memory[k] = values[k];
  std::swap(values, memory);
}

double distance_to(const Wall& wall, const Vec2& x)
{
  return (x - wall.point).dot(wall.normal);
}

}  // namespace

PairList::PairList(const std::vector<Wall>& walls, const Box& box, double largest_radius,
                   double skin, double margin)
    : walls_(walls),
      length_(box.periodic_x ? box.length_x : 0),
      inverse_length_(box.periodic_x ? 1 / box.length_x : 0),
      skin_(skin),
      slack_(skin - margin),
      cell_(2 * largest_radius + skin)
{
}

// --- Is the list complete? ---

bool PairList::complete(const std::vector<Vec2>& position)
{
  if (made_at_.size() != position.size()) return false;
  measure_displacements(made_at_, position, groups_, moved_);
  return grains_stay_apart() && bands_stay_apart() && walls_stay_away();
}

/// Any two neighbouring groups lie in a square of two by two.
bool PairList::grains_stay_apart() const
{
  const auto across = static_cast<std::size_t>(group_columns_);
  const auto bands = static_cast<std::size_t>(bands_);
  const auto pair = [&](std::size_t band, std::size_t g) {
    auto both = moved_[band * across + g];
    const std::size_t next = g + 1 < across ? g + 1 : length_ > 0 ? 0 : g;
    add(both, moved_[band * across + next]);
    return both;
  };
  for (std::size_t g = 0; g < across; ++g) {
    auto below = nothing();
    for (std::size_t band = 0; band < bands; ++band) {
      const auto here = pair(band, g);
      auto square = here;
      add(square, below);
      below = here;
      if (!empty(square) && !((square.high - square.low).squaredNorm() <= slack_ * slack_))
        return false;
    }
  }
  return true;
}

/// Groups that are no neighbours are a band or a group apart: they may move by that much more.
bool PairList::bands_stay_apart() const
{
  const auto across = static_cast<std::size_t>(group_columns_);
  const double group_width = least_columns_ * column_width_;
  const bool all_are_neighbours = group_columns_ <= (length_ > 0 ? 3 : 2);
  auto below = nothing(), here = nothing();
  double highest = -infinity;  // two bands or more below, less the height in between
  for (std::int32_t band = 0; band < bands_; ++band) {
    highest = std::max(highest - cell_, below.high.y());
    below = here;
    here = nothing();
    for (std::size_t g = 0; g < across; ++g)
      add(here, moved_[static_cast<std::size_t>(band) * across + g]);
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
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!(unlisted_nearest_[w * groups_.size() + g] + least_along(moved_[g], walls_[w].normal) >
            skin_ - slack_))
        return false;
  return true;
}

// --- A new list ---

void PairList::renew(GrainState& grains, const std::vector<Vec2>& position)
{
  ++renewals_;
  lay_grid(std::span(position).first(grains.size()));
  sort_into_cells(grains, position);
  make_groups();
  find_pairs(grains);
  colour_pairs(grains);
  std::swap(pairs_, old_pairs_);
  lay_out_classes();
  fill_in(grains);
  find_wall_pairs(grains);
  carry_impulses();
}

PairList::State PairList::state() const
{
  State state;
  state.made_at = made_at_;
  state.renewals = renewals_;
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
}

std::int32_t PairList::column(double x) const
{
  double along = x - left_;
  if (length_ > 0) along -= length_ * std::floor(along * inverse_length_);
  return static_cast<std::int32_t>(std::clamp(along / column_width_, 0.0, columns_ - 1.0));
}

std::int32_t PairList::band(double y) const
{
  return static_cast<std::int32_t>(std::clamp((y - bottom_) / cell_, 0.0, bands_ - 1.0));
}

std::size_t PairList::cell(std::int32_t column, std::int32_t band) const
{
  return static_cast<std::size_t>(band) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

void PairList::lay_grid(std::span<const Vec2> position)
{
  auto extent = nothing();
  for (const auto& x : position) add(extent, {x, x});
  bottom_ = extent.low.y();
  left_ = length_ > 0 ? 0 : extent.low.x();
  const double width = length_ > 0 ? length_ : extent.high.x() - extent.low.x();
  // A grain that flies far away must not cost memory: what lies beyond shares the last cells.
  const double most = 4.0 * static_cast<double>(position.size()) + 16;
  columns_ = static_cast<std::int32_t>(std::clamp(std::floor(width / cell_), 1.0, most));
  if (length_ > 0 && columns_ < 3) columns_ = 1;
  column_width_ = std::max(width / columns_, std::numeric_limits<double>::min());
  const double height = extent.high.y() - extent.low.y();
  bands_ =
      static_cast<std::int32_t>(std::clamp(std::ceil(height / cell_), 1.0, most / columns_ + 1));
}

void PairList::sort_into_cells(GrainState& grains, const std::vector<Vec2>& position)
{
  const std::size_t count = grains.size();
  cell_begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(bands_) + 1, 0);
  cell_of_.resize(count);
  for (std::size_t g = 0; g < count; ++g) {
    cell_of_[g] = static_cast<std::uint32_t>(cell(column(position[g].x()), band(position[g].y())));
    ++cell_begin_[cell_of_[g] + 1];
  }
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  auto next = cell_begin_;
  order_.resize(count);
  place_.resize(count + 1);
  for (std::size_t g = 0; g < count; ++g) {
    place_[g] = next[cell_of_[g]]++;
    order_[place_[g]] = static_cast<std::uint32_t>(g);
  }
  place_[count] = static_cast<std::uint32_t>(count);

  made_at_ = position;
  sort_as(order_, made_at_, memory_.position);
  sort_as(order_, grains.position, memory_.position);
  sort_as(order_, grains.motion, memory_.motion);
  sort_as(order_, grains.radius, memory_.radius);
  sort_as(order_, grains.image, memory_.image);
  sort_as(order_, grains.row, memory_.row);
  discs_.x.resize(count + block_lanes);
  discs_.y.resize(count + block_lanes);
  discs_.radius.resize(count + block_lanes);
  discs_.inverse_mass.resize(count + block_lanes);
  for (std::size_t g = 0; g < count; ++g) {
    discs_.x[g] = made_at_[g].x();
    discs_.y[g] = made_at_[g].y();
    discs_.radius[g] = grains.radius[g];
    discs_.inverse_mass[g] = grains.motion[g].inverse_mass;
  }
}

void PairList::make_groups()
{
  group_columns_ = std::max(columns_ / cells_per_group, 1);
  least_columns_ = columns_ / group_columns_;
  groups_.clear();
  for (std::int32_t band = 0; band < bands_; ++band) {
    for (std::int32_t g = 0; g < group_columns_; ++g) {
      const auto first = cell(g * columns_ / group_columns_, band);
      const auto last = cell((g + 1) * columns_ / group_columns_ - 1, band);
      groups_.push_back({cell_begin_[first], cell_begin_[last + 1]});
    }
  }
  moved_.resize(groups_.size());
}

void PairList::find_pairs(const GrainState& grains)
{
  found_.begin.assign(1, 0);
  found_.begin.reserve(grains.size() + 1);
  const auto cells = [&](std::int32_t first, std::int32_t last, std::int32_t band) {
    return Range{cell_begin_[cell(first, band)], cell_begin_[cell(last, band) + 1]};
  };
  for (std::int32_t band = 0; band < bands_; ++band) {
    for (std::int32_t c = 0; c < columns_; ++c) {
      Search search{cells(c, c, band), 0, {}, skin_, length_};
      const bool wraps = length_ > 0 && columns_ > 1;
      const std::int32_t left = std::max(c - 1, 0), right = std::min(c + 1, columns_ - 1);
      search.end = cells(c, right, band).end;
      if (wraps && c == columns_ - 1) search.elsewhere[0] = cells(0, 0, band);
      if (band + 1 < bands_) {
        search.elsewhere[1] = cells(left, right, band + 1);
        if (wraps && c == 0) search.elsewhere[2] = cells(columns_ - 1, columns_ - 1, band + 1);
        if (wraps && c == columns_ - 1) search.elsewhere[2] = cells(0, 0, band + 1);
      }
      find_near(discs_, search, found_);
    }
  }
}

void PairList::colour_pairs(const GrainState& grains)
{
  taken_.assign(grains.size(), {});
  class_of_.resize(found_.size());
  const auto first_free = [](std::uint64_t taken) {
    return static_cast<std::size_t>(std::countr_one(taken));
  };
  const auto bit = [](std::size_t colour) {
    return colour < colours ? std::uint64_t{1} << colour : 0;
  };
  for (std::size_t a = 0; a < grains.size(); ++a) {
    const bool a_moves = grains.motion[a].inverse_mass > 0;
    for (auto f = found_.begin[a]; f < found_.begin[a + 1]; ++f) {
      const std::size_t b = found_.b[f];
      if (a_moves && grains.motion[b].inverse_mass > 0) {
        const auto colour = first_free(taken_[a].among_grains | taken_[b].among_grains);
        taken_[a].among_grains |= bit(colour);
        taken_[b].among_grains |= bit(colour);
        class_of_[f] = static_cast<std::uint8_t>(colour);
      } else {
        auto& taken = taken_[a_moves ? a : b].on_base;
        const auto colour = first_free(taken);
        taken |= bit(colour);
        class_of_[f] = static_cast<std::uint8_t>(palette + colour);
      }
    }
  }
}

void PairList::lay_out_classes()
{
  std::array<std::uint32_t, 2 * palette> size{}, next{};
  for (std::size_t f = 0; f < found_.size(); ++f) ++size[class_of_[f]];
  std::uint32_t begin = 0;
  pairs_.classes.clear();
  for (std::size_t c = 0; c < size.size(); ++c) {
    if (size[c] == 0) continue;
    next[c] = begin;
    const std::uint32_t end = begin + (size[c] + block_lanes - 1) / block_lanes * block_lanes;
    pairs_.classes.push_back({begin, end, -1, c % palette == colours, c >= palette});
    begin = end;
  }
  position_of_.resize(found_.size());
  for (std::size_t f = 0; f < found_.size(); ++f) position_of_[f] = next[class_of_[f]]++;
}

double PairList::nearest_shift(double difference) const
{
  return std::abs(difference) <= length_ / 2 ? 0
                                             : -length_ * std::round(difference * inverse_length_);
}

void PairList::fill_in(const GrainState& grains)
{
  const std::size_t size = pairs_.classes.empty() ? 0 : pairs_.classes.back().end;
  const auto nobody = static_cast<std::uint32_t>(2 * grains.still());
  pairs_.i.assign(size, nobody);
  pairs_.j.assign(size, nobody);
  pairs_.geometry.assign(size, no_geometry);
  pairs_.inertia.assign(size, {1, 0});
  for (std::size_t a = 0; a < grains.size(); ++a) {
    const double w_a = grains.motion[a].inverse_mass;
    for (auto f = found_.begin[a]; f < found_.begin[a + 1]; ++f) {
      const std::size_t b = found_.b[f], k = position_of_[f];
      const double reach = grains.radius[a] + grains.radius[b];
      pairs_.i[k] = static_cast<std::uint32_t>(2 * (w_a > 0 ? a : b));
      pairs_.j[k] = static_cast<std::uint32_t>(2 * (w_a > 0 ? b : a));
      const double shift = nearest_shift(made_at_[a].x() - made_at_[b].x());
      pairs_.geometry[k] = {w_a > 0 ? shift : -shift, reach};
      pairs_.inertia[k] = {1 / reach, 1 / (w_a + grains.motion[b].inverse_mass)};
    }
  }
}

void PairList::find_wall_pairs(const GrainState& grains)
{
  const auto nobody = static_cast<std::uint32_t>(2 * grains.still());
  unlisted_nearest_.assign(walls_.size() * groups_.size(), infinity);
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const auto begin = static_cast<std::uint32_t>(pairs_.i.size());
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      for (auto g = groups_[group].begin; g < groups_[group].end; ++g) {
        if (!(grains.motion[g].inverse_mass > 0)) continue;
        const double gap = distance_to(walls_[w], made_at_[g]) - grains.radius[g];
        auto& nearest = unlisted_nearest_[w * groups_.size() + group];
        if (gap > skin_) {
          nearest = std::min(nearest, gap);
          continue;
        }
        pairs_.i.push_back(2 * g);
        pairs_.j.push_back(nobody);
        pairs_.geometry.push_back({0, grains.radius[g]});
        pairs_.inertia.push_back({1 / grains.radius[g], 1 / grains.motion[g].inverse_mass});
      }
    }
    while (pairs_.i.size() % block_lanes != 0) {
      pairs_.i.push_back(nobody);
      pairs_.j.push_back(nobody);
      pairs_.geometry.push_back(no_geometry);
      pairs_.inertia.push_back({1, 0});
    }
    const auto end = static_cast<std::uint32_t>(pairs_.i.size());
    if (end > begin)
      pairs_.classes.push_back({begin, end, static_cast<std::int32_t>(w), false, true});
  }
  pairs_.i.push_back(nobody);
  pairs_.j.push_back(nobody);
  pairs_.geometry.push_back(neutral_geometry);
  pairs_.inertia.push_back({1, 0});
}

void PairList::forget_impulses()
{
  pairs_.impulse.assign(pairs_.i.size(), {0, 0});
  pairs_.memory.assign(pairs_.i.size(), {0, 0});
}

void PairList::carry(std::size_t from, std::size_t to)
{
  pairs_.impulse[to] = old_pairs_.impulse[from];
  pairs_.memory[to] = old_pairs_.memory[from];
}

void PairList::carry_wall_impulse(std::uint32_t body, std::int32_t wall, std::uint32_t from)
{
  for (const auto& c : pairs_.classes) {
    if (c.wall != wall) continue;
    const auto first = pairs_.i.begin() + c.begin, last = pairs_.i.begin() + c.end;
    const auto found = std::lower_bound(first, last, 2 * body);
    if (found != last && *found == 2 * body)
      carry(from, static_cast<std::size_t>(found - pairs_.i.begin()));
  }
}

void PairList::carry_impulses()
{
  const auto& old = old_pairs_;
  forget_impulses();
  const auto still = static_cast<std::uint32_t>(place_.size() - 1);
  for (const auto& c : old.classes) {
    for (auto k = c.begin; k < c.end; ++k) {
      if (old.impulse[k].n == 0 && old.impulse[k].t == 0) continue;
      const auto i = place_[old.i[k] / 2], j = place_[old.j[k] / 2];
      if (j == still) {
        carry_wall_impulse(i, c.wall, k);
        continue;
      }
      const auto a = std::min(i, j), b = std::max(i, j);
      for (auto f = found_.begin[a]; f < found_.begin[a + 1]; ++f)
        if (found_.b[f] == b) carry(k, position_of_[f]);
    }
  }
}

}  // namespace grseg
