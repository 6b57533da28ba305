// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/completeness.hpp"

#include "sim/contact/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t columns_per_group = 3;

double squared_size(const Extent& extent)
{
  return extent.isEmpty() ? 0 : extent.diagonal().squaredNorm();
}

Extent velocities_of(const Range& bodies, const std::vector<Motion>& motion)
{
  Extent extent;
  for (auto b = bodies.begin; b < bodies.end; ++b) extent.extend(Vec2(motion[b].vx, motion[b].vy));
  return extent;
}

/// Least component along `direction` of all displacements in `extent`; infinity if it is empty.
double least_along(const Extent& extent, const Vec2& direction)
{
  if (extent.isEmpty()) return infinity;
  return extent.min().cwiseProduct(direction).cwiseMin(extent.max().cwiseProduct(direction)).sum();
}

}  // namespace

Completeness::Completeness(const std::vector<Wall>& walls, const Box& box, double cell, double skin,
                           double margin, int threads)
    : walls_(walls),
      periodic_(box.periodic_x),
      cell_(cell),
      skin_(skin),
      slack_(skin - margin),
      threads_(threads)
{
}

void Completeness::begin(const CellGrid& grid, const GrainState& grains,
                         const std::vector<Vec2>& made_at)
{
  column_width_ = grid.column_width();
  make_groups(grid);
  for_each_part(threads_, walls_.empty() ? 0 : groups_.size(),
                [&](std::size_t group) { find_unlisted(group, grains, made_at); });
}

void Completeness::make_groups(const CellGrid& grid)
{
  bands_ = static_cast<std::size_t>(grid.bands());
  first_group_.assign(1, 0);
  std::vector<std::int32_t> first_column;
  least_columns_ = grid.columns();
  for (std::size_t s = 0; s < grid.strips(); ++s) {
    const auto begin = grid.first_column(s), columns = grid.first_column(s + 1) - begin;
    const auto count = std::max(columns / columns_per_group, 1);
    for (std::int32_t g = 0; g < count; ++g) first_column.push_back(begin + g * columns / count);
    first_group_.push_back(first_column.size());
    least_columns_ = std::min(least_columns_, columns / count);
  }
  first_column.push_back(grid.columns());
  groups_.clear();
  for (std::int32_t band = 0; band < grid.bands(); ++band)
    for (std::size_t g = 0; g + 1 < first_column.size(); ++g)
      groups_.push_back(grid.bodies(first_column[g], first_column[g + 1] - 1, band));
  moved_.resize(groups_.size());
  band_moved_.resize(bands_);
  moved_in_band_.resize(bands_);
  unlisted_nearest_.assign(walls_.size() * groups_.size(), infinity);
}

void Completeness::find_unlisted(std::size_t group, const GrainState& grains,
                                 const std::vector<Vec2>& made_at)
{
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    auto& nearest = unlisted_nearest_[w * groups_.size() + group];
    for (auto b = groups_[group].begin; b < groups_[group].end; ++b) {
      if (!(grains.motion[b].inverse_mass > 0)) continue;
      const double gap = distance_to(walls_[w], made_at[b]) - grains.radius[b];
      if (gap > skin_) nearest = std::min(nearest, gap);
    }
  }
}

bool Completeness::holds(const std::vector<Vec2>& made_at, const std::vector<Vec2>& position,
                         double farthest)
{
  allowed_ = std::min(slack_, farthest);
  const std::size_t across = first_group_.back();
  for_each_part(threads_, bands_, [&](std::size_t band) {
    measure_displacements(made_at, position, std::span(groups_).subspan(band * across, across),
                          std::span(moved_).subspan(band * across));
  });
  for_each_part(threads_, bands_, [&](std::size_t band) { measure_neighbours(band); });
  neighbours_moved_ = *std::max_element(moved_in_band_.begin(), moved_in_band_.end());
  return neighbours_moved_ <= allowed_ && bands_stay_apart() && walls_stay_away();
}

double Completeness::fastest_unlisted(const std::vector<Motion>& motion) const
{
  std::vector<Extent> velocity;
  for (const auto& group : groups_) velocity.push_back(velocities_of(group, motion));
  const std::size_t across = first_group_.back();
  double squared = 0;
  for (std::size_t band = 0; band < bands_; ++band)
    for (std::size_t g = 0; g < across; ++g)
      if (squared_size(square_at(moved_, band, g)) > allowed_ * allowed_)
        squared = std::max(squared, squared_size(square_at(velocity, band, g)));
  if (!bands_stay_apart()) {
    Extent all;
    for (const auto& group : velocity) all.extend(group);
    squared = squared_size(all);
  }
  return std::sqrt(squared);
}

Extent Completeness::square_at(const std::vector<Extent>& groups, std::size_t band,
                               std::size_t g) const
{
  const std::size_t across = first_group_.back();
  const auto* here = &groups[band * across];
  const auto* above = band + 1 < bands_ ? here + across : here;
  const std::size_t next = g + 1 < across ? g + 1 : periodic_ ? 0 : g;
  auto square = here[g];
  for (const auto& other : {here[next], above[g], above[next]}) square.extend(other);
  return square;
}

void Completeness::measure_neighbours(std::size_t band)
{
  const std::size_t across = first_group_.back();
  band_moved_[band].setEmpty();
  double squared = 0;
  for (std::size_t g = 0; g < across; ++g) {
    band_moved_[band].extend(moved_[band * across + g]);
    squared = std::max(squared, squared_size(square_at(moved_, band, g)));
  }
  moved_in_band_[band] = std::sqrt(squared);
}

/// True if groups that are not neighbours cannot have met. Between them lies a whole band or a
/// whole group, so their displacement may be larger by its height or width.
bool Completeness::bands_stay_apart() const
{
  const double group_width = least_columns_ * column_width_;
  const bool all_are_neighbours = first_group_.back() <= (periodic_ ? 3 : 2);
  Extent below, here;
  double highest = -infinity;  // displacement of bands two or more below, less the height between
  for (const auto& band : band_moved_) {
    highest = std::max(highest - cell_, below.max().y());
    below = here;
    here = band;
    if (here.isEmpty()) continue;
    if (!(highest - here.min().y() <= allowed_)) return false;
    const auto both = here.merged(below);
    if (!all_are_neighbours && !(both.sizes().x() <= group_width - cell_ + allowed_)) return false;
  }
  return true;
}

bool Completeness::walls_stay_away() const
{
  const double margin = skin_ - slack_;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!(unlisted_nearest_[w * groups_.size() + g] + least_along(moved_[g], walls_[w].normal) >
            margin))
        return false;
  return true;
}

}  // namespace grseg
