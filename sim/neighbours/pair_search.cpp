// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_search.hpp"

#include "sim/contact/contact_blocks.hpp"
#include "sim/contact/parallel.hpp"

#include <algorithm>

namespace grseg {

PairSearch::PairSearch(const std::vector<Wall>& walls, const Box& box, double cell, double skin,
                       int threads)
    : walls_(walls), skin_(skin), threads_(threads), grid_(box, cell, threads)
{
}

void PairSearch::find(GrainState& grains, const std::vector<Vec2>& position)
{
  sort_along_cells(grains, position);
  strips_.resize(grid_.strips());
  for_each_part(threads_, strips_.size(), [&](std::size_t s) {
    find_pairs(s);
    find_wall_pairs(s, grains);
  });
  join_found(grains.size());
}

void PairSearch::sort_along_cells(GrainState& grains, const std::vector<Vec2>& position)
{
  const std::size_t count = grains.size();
  grid_.sort(std::span(position).first(count));
  const auto& order = grid_.order();
  place_.resize(count + 1);
  place_[count] = static_cast<std::uint32_t>(count);
  made_at_.resize(position.size());
  made_at_[count] = position[count];
  for (auto* values : {&discs_.x, &discs_.y, &discs_.radius}) values->resize(count + block_lanes);
  sorted_.resize_like(grains);
  for_ranges(threads_, count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const std::size_t old = order[g];
      place_[old] = static_cast<std::uint32_t>(g);
      made_at_[g] = position[old];
      sorted_.position[g] = grains.position[old];
      sorted_.motion[g] = grains.motion[old];
      sorted_.radius[g] = grains.radius[old];
      sorted_.image[g] = grains.image[old];
      sorted_.row[g] = grains.row[old];
      discs_.x[g] = grid_.wrapped(position[old].x());
      discs_.y[g] = position[old].y();
      discs_.radius[g] = grains.radius[old];
    }
  });
  std::swap(grains, sorted_);
}

void PairSearch::find_pairs(std::size_t strip)
{
  auto& found = strips_[strip].found;
  found.begin.assign(1, 0);
  for (std::int32_t band = 0; band < grid_.bands(); ++band)
    for (auto c = grid_.first_column(strip); c < grid_.first_column(strip + 1); ++c)
      find_near(discs_, grid_.search(strip, c, band), skin_, found);
}

void PairSearch::find_wall_pairs(std::size_t strip, const GrainState& grains)
{
  auto& at_wall = strips_[strip].at_wall;
  at_wall.resize(walls_.size());
  const auto bodies = grid_.bodies_of_strip(strip);
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    at_wall[w].clear();
    for (auto b = bodies.begin; b < bodies.end; ++b) {
      if (!(grains.motion[b].inverse_mass > 0)) continue;
      const double gap = distance_to(walls_[w], made_at_[b]) - grains.radius[b];
      if (!(gap > skin_)) at_wall[w].push_back(b);
    }
  }
}

void PairSearch::join_found(std::size_t grains)
{
  std::vector<std::uint32_t> first(strips_.size() + 1, 0);
  for (std::size_t s = 0; s < strips_.size(); ++s)
    first[s + 1] = first[s] + static_cast<std::uint32_t>(strips_[s].found.size());
  found_.begin.resize(grains + 1);
  found_.begin[grains] = first.back();
  found_.b.resize(first.back() + block_lanes);
  for_each_part(threads_, strips_.size(), [&](std::size_t s) {
    const auto& found = strips_[s].found;
    const auto bodies = grid_.bodies_of_strip(s);
    for (auto a = bodies.begin; a < bodies.end; ++a)
      found_.begin[a] = first[s] + found.begin[a - bodies.begin];
    std::copy_n(found.b.begin(), found.size(), found_.b.begin() + first[s]);
  });
}

}  // namespace grseg
