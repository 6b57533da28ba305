// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/simulation.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Contact as in a file: i < j unless j is a boundary grain; j of a wall is -1 minus its number.
struct NamedContact {
  std::int32_t i, j;
  bool turned;  // true if i and j are exchanged relative to Pairs
  const ContactBlock* block;
  const BlockOrigin* origin;
  std::size_t lane;

  bool operator<(const NamedContact& other) const
  {
    return i != other.i ? i < other.i : j < other.j;
  }
};

std::int32_t name_of_wall(const Pairs& pairs, std::size_t pair)
{
  for (const auto& c : pairs.classes)
    if (c.begin <= pair && pair < c.end) return -c.wall - 1;
  return -1;
}

/// Moves x into [0, length), m, and adds the number of subtracted periods to `image`.
void wrap(double length, double& x, std::int32_t& image)
{
  double periods = std::floor(x / length);
  x -= periods * length;
  if (x >= length) {  // round-off for a tiny negative x
    x = 0;
    ++periods;
  }
  image += static_cast<std::int32_t>(periods);
}

}  // namespace

void Simulation::write_contacts(ContactList<2>& list) const
{
  const auto& pairs = pairs_.pairs();
  const auto row_of = [&](std::uint32_t twice) { return state_.row[twice / 2]; };
  std::vector<NamedContact> names;
  for (const auto& strip : contacts_) {
    for (std::size_t slot = 0; slot < strip.size * block_lanes; ++slot) {
      const auto& block = strip.blocks[slot / block_lanes];
      const auto& origin = strip.origins[slot / block_lanes];
      const std::size_t lane = slot % block_lanes;
      const std::size_t k = origin.entry(lane);
      if (k == pairs.size()) continue;
      const bool at_wall = pairs.j[k] / 2 == state_.immobile();
      const std::int32_t i = row_of(pairs.i[k]),
                         j = at_wall ? name_of_wall(pairs, k) : row_of(pairs.j[k]);
      const bool turned = !at_wall && j < i && !world_.grains.fixed[static_cast<std::size_t>(j)];
      names.push_back({turned ? j : i, turned ? i : j, turned, &block, &origin, lane});
    }
  }
  std::sort(names.begin(), names.end());
  list.clear();
  list.reserve(names.size());
  for (const auto& [i, j, turned, block, origin, lane] : names) {
    const double sign = turned ? -1 : 1, gap = origin->gap[lane];
    const Vec2 normal{sign * block->nx[lane], sign * block->ny[lane]};
    const Vec2 tangent{-normal.y(), normal.x()};
    list.i.push_back(i);
    list.j.push_back(j);
    list.force.push_back((block->impulse_n[lane] * normal + block->impulse_t[lane] * tangent) /
                         world_.step);
    list.branch.push_back((pairs.geometry[origin->entry(lane)].reach + gap) * normal);
    list.gap.push_back(gap);
  }
}

void Simulation::write_frame(double middle, Frame<2>& frame) const
{
  const std::size_t count = state_.size();
  frame.step = steps_done_;
  frame.time = middle;
  frame.position.resize(count);
  frame.image.resize(count);
  frame.velocity.resize(count);
  frame.angular_velocity.resize(count);
  frame.force.resize(count);
  for (std::size_t g = 0; g < count; ++g) {
    const auto body = body_of_[g];
    frame.position[g] = state_.position[body];
    frame.image[g] = {state_.image[body], 0};
    if (world_.box.periodic_x) wrap(world_.box.length_x, frame.position[g].x(), frame.image[g][0]);
    frame.velocity[g] = velocity(g);
    frame.angular_velocity[g] = angular_velocity(g);
    const Vec2 change = frame.velocity[g] - Vec2(before_[g].vx, before_[g].vy);
    frame.force[g] = world_.grains.mass[g] * change / world_.step;
  }
  write_contacts(frame.contacts);
}

}  // namespace grseg
