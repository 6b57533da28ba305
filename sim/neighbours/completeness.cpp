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

template <int D>
double squared_size(const Extent<D>& extent)
{
  return extent.isEmpty() ? 0 : extent.diagonal().squaredNorm();
}

template <int D>
Extent<D> velocities_of(const Range& bodies, const std::vector<Motion<D>>& motion)
{
  Extent<D> extent;
  for (auto b = bodies.begin; b < bodies.end; ++b) extent.extend(vector_of(motion[b].v));
  return extent;
}

/// Least component along `direction` of all displacements in `extent`; infinity if it is empty.
template <int D>
double least_along(const Extent<D>& extent, const Vector<D>& direction)
{
  if (extent.isEmpty()) return infinity;
  return extent.min().cwiseProduct(direction).cwiseMin(extent.max().cwiseProduct(direction)).sum();
}

}  // namespace

template <int D>
Completeness<D>::Completeness(const std::vector<Wall<D>>& walls, const Box& box, double cell,
                              double skin, double margin, int threads)
    : walls_(walls),
      periodic_x_(box.periodic_x),
      periodic_z_(box.periodic_z),
      cell_(cell),
      skin_(skin),
      slack_(skin - margin),
      threads_(threads)
{
}

template <int D>
void Completeness<D>::begin(const CellGrid<D>& grid, const GrainState<D>& grains,
                            const std::vector<Position<D>>& made_at)
{
  column_width_ = grid.column_width();
  slice_width_ = grid.slice_width();
  neighbours_moved_ = 0;
  make_groups(grid);
  for_each_part(threads_, walls_.empty() ? 0 : groups_.size(),
                [&](std::size_t group) { find_unlisted(group, grains, made_at); });
}

template <int D>
void Completeness<D>::make_groups(const CellGrid<D>& grid)
{
  bands_ = static_cast<std::size_t>(grid.bands());
  slices_ = static_cast<std::size_t>(grid.slices());
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
    for (std::int32_t slice = 0; slice < grid.slices(); ++slice)
      for (std::size_t g = 0; g + 1 < first_column.size(); ++g)
        groups_.push_back(grid.bodies(first_column[g], first_column[g + 1] - 1, band, slice));
  moved_.resize(groups_.size());
  band_moved_.resize(bands_);
  moved_in_band_.resize(bands_);
  unlisted_nearest_.assign(walls_.size() * groups_.size(), infinity);
}

template <int D>
void Completeness<D>::find_unlisted(std::size_t group, const GrainState<D>& grains,
                                    const std::vector<Position<D>>& made_at)
{
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    auto& nearest = unlisted_nearest_[w * groups_.size() + group];
    for (auto b = groups_[group].begin; b < groups_[group].end; ++b) {
      if (!(grains.motion[b].inverse_mass > 0)) continue;
      const double gap = distance_to<D>(walls_[w], point<D>(made_at[b])) - grains.radius[b];
      if (gap > skin_) nearest = std::min(nearest, gap);
    }
  }
}

template <int D>
bool Completeness<D>::holds(const std::vector<Position<D>>& made_at,
                            const std::vector<Position<D>>& position, double farthest)
{
  allowed_ = std::min(slack_, farthest);
  for_each_part(threads_, bands_, [&](std::size_t band) {
    const auto first = band * per_band();
    measure_displacements<D>(made_at, position, std::span(groups_).subspan(first, per_band()),
                             std::span(moved_).subspan(first));
  });
  for_each_part(threads_, bands_, [&](std::size_t band) { measure_neighbours(band); });
  neighbours_moved_ = *std::max_element(moved_in_band_.begin(), moved_in_band_.end());
  return neighbours_moved_ <= allowed_ && bands_stay_apart() && walls_stay_away();
}

template <int D>
double Completeness<D>::fastest_unlisted(const std::vector<Motion<D>>& motion) const
{
  std::vector<Extent<D>> velocity;
  for (const auto& group : groups_) velocity.push_back(velocities_of<D>(group, motion));
  double squared = 0;
  for (std::size_t band = 0; band < bands_; ++band)
    for (std::size_t g = 0; g < per_band(); ++g)
      if (squared_size<D>(cube_at(moved_, band, g)) > allowed_ * allowed_)
        squared = std::max(squared, squared_size<D>(cube_at(velocity, band, g)));
  if (!bands_stay_apart()) {
    Extent<D> all;
    for (const auto& group : velocity) all.extend(group);
    squared = squared_size<D>(all);
  }
  return std::sqrt(squared);
}

template <int D>
Extent<D> Completeness<D>::cube_at(const std::vector<Extent<D>>& groups, std::size_t band,
                                   std::size_t g) const
{
  const std::size_t across = first_group_.back(), slice = g / across, column = g % across;
  const auto after = [](std::size_t k, std::size_t count, bool ring) {
    return k + 1 < count ? k + 1 : ring ? 0 : k;
  };
  const std::size_t right = after(column, across, periodic_x_),
                    behind = after(slice, slices_, periodic_z_), above = after(band, bands_, false);
  Extent<D> cube;
  for (const auto b : {band, above})
    for (const auto s : {slice, behind})
      for (const auto c : {column, right}) cube.extend(groups[(b * slices_ + s) * across + c]);
  return cube;
}

template <int D>
void Completeness<D>::measure_neighbours(std::size_t band)
{
  band_moved_[band].setEmpty();
  double squared = 0;
  for (std::size_t g = 0; g < per_band(); ++g) {
    band_moved_[band].extend(moved_[band * per_band() + g]);
    squared = std::max(squared, squared_size<D>(cube_at(moved_, band, g)));
  }
  moved_in_band_[band] = std::sqrt(squared);
}

/// True if groups that are not neighbours cannot have met. A whole band or group lies between them.
/// They may come closer than neighbours may, by the height or width of what lies between, less
/// cell_.
template <int D>
bool Completeness<D>::bands_stay_apart() const
{
  const double group_width = least_columns_ * column_width_;
  const bool columns_are_neighbours = first_group_.back() <= (periodic_x_ ? 3 : 2);
  const bool slices_are_neighbours = slices_ <= (periodic_z_ ? 3 : 2);
  Extent<D> below, here;
  double highest = -infinity;  // displacement of bands two or more below, less the height between
  for (const auto& band : band_moved_) {
    highest = std::max(highest - cell_, below.max().y());
    below = here;
    here = band;
    if (here.isEmpty()) continue;
    if (!(highest - here.min().y() <= allowed_)) return false;
    const Vector<D> apart = here.merged(below).sizes();
    if (!columns_are_neighbours && !(apart.x() <= group_width - cell_ + allowed_)) return false;
    if (!slices_are_neighbours && !(apart[D - 1] <= slice_width_ - cell_ + allowed_)) return false;
  }
  return true;
}

template <int D>
bool Completeness<D>::walls_stay_away() const
{
  const double margin = skin_ - slack_;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!(unlisted_nearest_[w * groups_.size() + g] +
                least_along<D>(moved_[g], walls_[w].normal) >
            margin))
        return false;
  return true;
}

template class Completeness<2>;
template class Completeness<3>;

}  // namespace grseg
